#pragma once

#include <petscsnes.h>

#include <span>
#include <vector>

#include "slipscale/base/petsc.hpp"
#include "slipscale/homogenize/cell_problem.hpp"

namespace slipscale {

using OwnedSNES = Owned<SNES, SNESDestroy>;
using OwnedMatNullSpace = Owned<MatNullSpace, MatNullSpaceDestroy>;

/// The discrete equations of one cell: internal forces of u + E·x against external ones, with some
/// components held. Numbers its unknowns as the mesh its nodes: two for each.
class CellSystem {
 public:
  CellSystem(MPI_Comm comm, const Mesh& mesh, const std::vector<Material>& materials);

  /// Component `axis` of an owned node keeps the value it starts with.
  void hold(int node, int axis) { held_[2 * static_cast<std::size_t>(node) + axis] = 1; }

  /// Homogeneous strain that is added to that of the unknown displacement, Voigt.
  void set_strain(const Eigen::Vector3d& strain) { strain_ = strain; }
  Vector2* external_force() { return external_.data(); }  ///< [owned nodes], N/m

  OwnedVec vector() const;  ///< of zeros, with ghosts
  OwnedMat matrix() const;  ///< allocated, without values

  /// out = internal − external forces of `u`; at held components 0, which keeps them.
  PetscErrorCode residual(Vec u, Vec out);
  /// Stiffness; at held components a diagonal.
  PetscErrorCode jacobian(Mat matrix) const;

  /// Rigid motions as near null space: multigrid coarsens well with them.
  OwnedMatNullSpace rigid_motions() const;

  /// Displacement of a corner of a local cell, homogeneous part included, m; from the last `load`.
  void load(Vec u);
  Vector2 displacement(int corner) const;  ///< index into Mesh::cells.corners

  const Mesh& mesh() const { return mesh_; }

 private:
  MPI_Comm comm_;
  const Mesh& mesh_;
  const std::vector<Material>& materials_;
  PetscInt offset_ = 0;            ///< number of this rank's first node in PETSc's numbering
  std::vector<PetscInt> index_;    ///< PETSc's number of each local node
  std::vector<char> held_;         ///< [owned nodes, 2]
  std::vector<Vector2> external_;  ///< [owned nodes]
  Eigen::Vector3d strain_ = Eigen::Vector3d::Zero();
  OwnedVec local_;               ///< u with ghosts
  std::vector<Vector2> loaded_;  ///< [all local nodes], m
  double scale_ = 0;             ///< of the diagonal at held components, Pa
};

}  // namespace slipscale
