#pragma once

#include <Eigen/Dense>
#include <array>
#include <span>
#include <string>
#include <vector>

#include "slipscale/base/parallel.hpp"
#include "slipscale/base/plane_tensor.hpp"
#include "slipscale/relocalize/strain_recovery.hpp"
#include "slipscale/relocalize/tiling.hpp"

namespace slipscale {

/// What `homogenize` finds of a microstructure.
struct LocalisationTensors {
  PlaneGrid grid;
  std::vector<Eigen::Matrix3d> localisation;            ///< A of each cell, ε = A:E, [cells]
  std::vector<Eigen::Matrix3d> stiffness;               ///< C of each region, Pa
  Eigen::Matrix3d effective = Eigen::Matrix3d::Zero();  ///< C_eff, Pa
  std::string boundary;                                 ///< periodic, kubc or subc
  double hole_area = 0;                                 ///< of all holes of the homogenised cell, m²
  std::string mesh_checksum;                            ///< of its mesh file; empty in files that do not say
};

/// The symmetric root S of a covariance, S Sᵀ, laid out like it.
struct CovarianceRoot {
  PlaneCovariance entries{};
};
/// What rounding makes negative among the eigenvalues counts as 0.
CovarianceRoot square_root(const PlaneCovariance& covariance);
/// Whether it has no eigenvalue below zero, but for rounding.
bool is_covariance(const PlaneCovariance& covariance);

/// Local strain ε = A:E and stress σ = C:A:E at fixed places from a homogeneous run's strain E, frame by
/// frame: one 3×3 product for each place, no allocation. Each place is computed by itself, so that places may
/// be shared out among ranks in any way: the same bits.
///
/// Spans hold one entry for each place, except where cells of the macro mesh are meant.
class Relocalisation {
 public:
  /// The tensors are copied, once for each micro cell and not for each place.
  Relocalisation(const LocalisationTensors& tensors, const PlaneGrid& macro, Recovery recovery,
                 std::span<const Site> sites);

  std::size_t places() const { return micro_cell_.size(); }

  /// E at the places from E of the macro cells; likewise C_eff:E, the macroscopic stress.
  void macroscopic(std::span<const PlaneTensor> macro_cells, std::span<PlaneTensor> at_places) {
    recovery_(macro_cells, at_places);
  }
  /// Roots of the covariance of E at the places from its covariance in the macro cells. Recovery weights some
  /// cells negatively; recovered roots still make covariances, recovered covariances do not (a variance of
  /// less than zero). That of the recovered strain would need the covariances between cells.
  void macroscopic_roots(std::span<const PlaneCovariance> macro_cells, std::span<CovarianceRoot> at_places);

  /// From E at the places; the same for means over time. In place (the same span twice) is allowed.
  void strain(std::span<const PlaneTensor> macroscopic, std::span<PlaneTensor> local) const;
  void stress(std::span<const PlaneTensor> macroscopic, std::span<PlaneTensor> local) const;

  /// A cov Aᵀ and (C A) cov (C A)ᵀ, from the roots of the covariance of E at the places.
  void strain_covariance(std::span<const CovarianceRoot> macroscopic, std::span<PlaneCovariance> local) const;
  void stress_covariance(std::span<const CovarianceRoot> macroscopic, std::span<PlaneCovariance> local) const;

 private:
  StrainRecovery recovery_;
  std::vector<PlaneCovariance> macro_roots_, roots_;           ///< [macro cells] and [places], of statistics
  std::vector<int> micro_cell_;                                ///< [places]
  std::vector<Eigen::Matrix3d> localisation_, concentration_;  ///< A and C:A (Pa), [micro cells]
};

/// T cov Tᵀ: the covariance of T:E from the root of that of E. Its variances are sums of squares.
PlaneCovariance transformed(const CovarianceRoot& root, const Eigen::Matrix3d& t);

/// √ of the variances, 0 where rounding makes one negative.
PlaneTensor deviation(const PlaneCovariance& covariance);

}  // namespace slipscale
