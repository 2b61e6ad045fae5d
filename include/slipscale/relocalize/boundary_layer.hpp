#pragma once

#include <mpi.h>

#include <Eigen/Dense>
#include <memory>
#include <span>
#include <vector>

#include "slipscale/relocalize/relocalisation.hpp"

namespace slipscale {

/// Points of a grid that lie in one place, as the copies of a tiled cell leave them, joined: the number of
/// the joint of each point, [points], in the order of first appearance.
std::vector<int> joined_points(const PlaneGrid& grid);

/// Replaces relocalised stress next to the contact by that of a strip of the microstructure that rubs on the
/// rigid surface as the homogeneous run does.
///
/// The tensors of a cell know nothing of a surface: next to it C:A:E is off by a layer about one cell thick.
/// There the displacement is that of the homogeneous run plus a corrector w, on the microstructure's mesh:
///
///     ∫ ε(φ) : C : ε(w) dA = −∫ ε(φ) : (C − C_eff) : E dA + ∫ φ_x (τ − τ_hom) dx    for every φ,
///     w = 0 on the inner edge;   w_y = 0, p ≥ 0, τ = (τ_hom / p_hom) p where the run's contact is closed
///     (τ = τ_hom where that exceeds p_hom).
///
/// As C_eff:E balances the run's tractions and inertia, so does the sum. The surface is rigid: it prescribes
/// the displacement of closed nodes, and stiff inclusions bear more of the pressure p, which is found, with
/// the friction that belongs to it; nodes that it would have to pull are opened and bear nothing. (With the
/// run's smooth traction prescribed instead, the error next to the contact doubles.) What the inner edge
/// disturbs decays within a cell: the upper half of the strip is thrown away. Sides count as free of contact,
/// a seam too. Linear while the same nodes are closed, so means over time may be corrected as well; their
/// deviations may not. Boundary-layer correctors: Dumontet, RAIRO Modél. Math. Anal. Numér. 20 (1986) 265.
///
/// The strip's stiffness, all contact nodes free, is factorised once (MUMPS, Cholesky). What holds closed
/// nodes is found from their compliance, for which each node is solved for once, when it first closes; a
/// correction then takes two pairs of triangular solves, however often pressure and friction are iterated.
class BoundaryLayer {
 public:
  /// `grid` is the whole mesh on every rank, `mine` this rank's cells of it, `stiffness` C by region [Pa],
  /// `depth` [m] that of the strip above the lowest point. Throws UserError when the strip holds no cell or
  /// the whole of the mesh.
  BoundaryLayer(MPI_Comm comm, const PlaneGrid& grid, std::span<const Eigen::Matrix3d> stiffness,
                RankShare mine, double depth);
  ~BoundaryLayer();

  /// At this rank's cells: E and C_eff:E [Pa] of the homogeneous run, and relocalised strain and stress,
  /// which are replaced in the lower half of the strip. Throws UserError when the solver or the friction does
  /// not converge. Collective.
  void correct(std::span<const PlaneTensor> macroscopic_strain,
               std::span<const PlaneTensor> macroscopic_stress, std::span<PlaneTensor> strain,
               std::span<PlaneTensor> stress);

  long unknowns() const;       ///< 0 before the first correction
  long cells() const;          ///< of the strip, all ranks
  int factorisations() const;  ///< so far

 private:
  struct Layer;
  std::unique_ptr<Layer> layer_;
};

}  // namespace slipscale
