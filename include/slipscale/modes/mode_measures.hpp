#pragma once

#include <vector>

#include "slipscale/modes/modes_basis.hpp"
#include "slipscale/modes/steady_sliding.hpp"

namespace slipscale {

/// What a mode does, for a shape that is scaled so that its energy, kinetic and strain, the mean over a
/// period, is 1 J/m.
struct ModeMeasures {
  double near_contact = 0;  ///< part of the strain energy within a tenth of the height of the surface
  std::vector<double> friction_work;  ///< [regions] of friction on the body, over a period, J/m
  Columns shape;                      ///< [free, 2] real and imaginary part of u, m
  Eigen::VectorXcd normal;            ///< [closed] λ, N/m, damping included
  Eigen::VectorXcd tangential;        ///< [closed] of friction along +x, N/m
};

/// How the tributary length of each closed node divides among the regions of the cells above it, [closed,
/// regions], 1; and the measures of modes.
class ModeMeasurement {
 public:
  ModeMeasurement(const SlidingOperator& body, const Boundary& contact);

  /// Collective.
  ModeMeasures measure(const ModesBasis& basis, const SlidingLaw& law, const SlidingMode& mode) const;

 private:
  double near_contact_energy(const Columns& shape) const;

  const SlidingOperator& body_;
  Eigen::MatrixXd shares_;
};

}  // namespace slipscale
