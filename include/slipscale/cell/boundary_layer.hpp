#pragma once

#include <mpi.h>

#include <Eigen/Dense>
#include <memory>
#include <span>
#include <vector>

#include "slipscale/cell/relocalization.hpp"

namespace slipscale {

/// Points of a grid that lie in one place, as the copies of a tiled cell leave them, joined: the number of
/// the joint of each point, [points], in the order of first appearance.
std::vector<int> joined_points(const PlaneGrid& grid);

/// Puts relocalised stress back into equilibrium in a strip at the contact surface.
///
/// The tensors of a cell know nothing of a surface: next to it C:A:E is off by a layer about one cell thick,
/// because its traction is not the homogeneous run's. The corrector w solves, on the microstructure's mesh,
///
///     ∫ ε(φ) : C : ε(w) dA = −∫ ε(φ) : (C:A:E − C_eff:E) dA    for every φ,   w = 0 on the inner edge,
///
/// and C:ε(w) is added to the stress. As C_eff:E balances tractions and inertia of the run, so does the sum:
/// displacement at the inner edge and traction below are those of the homogeneous run, with the fluctuation
/// that the tensors give. Linear, so means over time may be corrected as well (their deviations may not).
/// Boundary-layer correctors: Dumontet, RAIRO Modél. Math. Anal. Numér. 20 (1986) 265.
///
/// The strip's stiffness is factorised once (MUMPS, Cholesky; options prefix `relocalize_`); each correction
/// is one pair of triangular solves. Sides of the strip carry the run's tractions too.
class BoundaryLayer {
 public:
  /// `grid` is the whole mesh on every rank, `mine` this rank's cells of it, `stiffness` C by region [Pa],
  /// `depth` [m] that of the strip above the lowest point. Throws UserError when the strip holds no cell or
  /// the whole of the mesh. Collective.
  BoundaryLayer(MPI_Comm comm, const PlaneGrid& grid, std::span<const Eigen::Matrix3d> stiffness,
                RankShare mine, double depth);
  ~BoundaryLayer();

  /// `macroscopic`: C_eff:E at this rank's cells [Pa]; corrects their strain and stress in place. Collective.
  void correct(std::span<const PlaneTensor> macroscopic, std::span<PlaneTensor> strain,
               std::span<PlaneTensor> stress);

  long unknowns() const;
  long cells() const;  ///< of the strip, all ranks

 private:
  struct Strip;
  std::unique_ptr<Strip> strip_;
};

}  // namespace slipscale
