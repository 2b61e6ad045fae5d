#pragma once

#include <array>
#include <vector>

#include "slipscale/dynamics/sliding_body.hpp"

namespace slipscale {

/// Stress, strain and damping work of the local cells at the last observed step, in arrays that are kept from
/// one time to the next.
class CellValues {
 public:
  explicit CellValues(const SlidingBody& body);

  /// `damping`: only where the body keeps it, see SlidingBody::keeps_cell_damping. Collective with it.
  void make(bool stress, bool strain, bool damping);

  // What the last `make` was asked for, else what an earlier one left:
  const std::vector<std::array<double, 3>>& stress() const { return stress_; }  ///< xx, yy, xy, Pa
  const std::vector<std::array<double, 3>>& strain() const { return strain_; }  ///< xx, yy, 2 xy
  const std::vector<double>& damping() const { return damping_; }               ///< J/m³

 private:
  void make_strain();

  const SlidingBody& body_;
  const std::vector<Eigen::Matrix3d> compliance_;  ///< [regions], 1/Pa
  std::vector<std::array<double, 3>> stress_, strain_;
  std::vector<double> damping_;
};

/// σ_zz/(σ_xx + σ_yy) of each local cell, NaN where its stiffness does not tell. Throws UserError there if
/// `needed`, which von Mises' stress makes it. Collective.
std::vector<double> transverse_of_cells(const Model& model, bool needed);

}  // namespace slipscale
