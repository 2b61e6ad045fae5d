#pragma once

#include "cell_outline.hpp"
#include "cell_system.hpp"

namespace slipscale {

/// Averages over a cell under its load cases. With holes they are those over the whole of it: a hole bears no
/// stress, and its strain follows from the displacement of its edge.
class CellMeans {
 public:
  CellMeans(MPI_Comm comm, const CellSystem& system, const CellOutline& outline);

  /// Takes the system as loaded with the solution of load case `k`.
  void add(int k);

  /// Fills in the tensors and the areas. Collective.
  void finish(CellSolution& solution);

 private:
  MPI_Comm comm_;
  const CellSystem& system_;
  const CellOutline& outline_;
  std::vector<Eigen::Matrix3d> localisation_;                        ///< [local elements]
  std::vector<Eigen::Matrix<double, 8, load_cases>> displacements_;  ///< likewise, m
  Eigen::Matrix3d stress_ = Eigen::Matrix3d::Zero(), strain_ = Eigen::Matrix3d::Zero(),
                  hole_strain_ = Eigen::Matrix3d::Zero();  ///< integrals, m² times stress or strain
};

/// What was found per unit stress becomes per unit strain.
void per_unit_strain(CellSolution& solution);

}  // namespace slipscale
