#pragma once

#include <petscsnes.h>

#include <vector>

#include "slipscale/base/petsc.hpp"
#include "slipscale/homogenize/cell_problem.hpp"
#include "slipscale/mesh/plane_grid.hpp"
#include "slipscale/solid/element.hpp"

namespace slipscale {

using OwnedSNES = Owned<SNES, SNESDestroy>;
using OwnedMatNullSpace = Owned<MatNullSpace, MatNullSpaceDestroy>;

/// Corners of a local element of the mesh seen from the first one, m.
CellCorners seen_corners(const Mesh& mesh, int element);

/// The discrete equations of one unit cell: internal forces of u + E·x against external ones, with some
/// components held. Numbers its unknowns as the mesh its nodes: two for each.
///
/// An element sees its corners, and their displacements, from its first one: rigid motions load nothing, so
/// that nothing depends on where the unit cell lies, and no digits cancel that need not.
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
  /// Norm of what cancels in the last residual, |K||u|, over all ranks, N/m: times the rounding unit it is
  /// what the residual of the exact solution may come to. Collective.
  PetscErrorCode cancelling_forces(PetscReal* size) const;

  /// Rigid motions as near null space: multigrid coarsens well with them.
  OwnedMatNullSpace rigid_motions() const;

  /// Keeps a solution, for the members below.
  void load(Vec u);
  const Vector2& unknown(int node) const { return loaded_[node]; }  ///< u of a local node, m
  const Eigen::Vector3d& strain() const { return strain_; }
  /// Displacements of an element's corners less that of the first one, E·x included, [2 corners], m.
  using Displacements = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor, 8, 1>;
  Displacements displacements(int element) const;

  CellCorners corners(int element) const { return seen_corners(mesh_, element); }
  /// By B-bar where the material would lock.
  ElementStiffness stiffness(int element) const;

  const Mesh& mesh() const { return mesh_; }
  bool is_nearly_incompressible() const;  ///< one of the phases, at least
  const Material& material(int element) const { return materials_[mesh_.cells.region[element]]; }

 private:
  /// E·x at a corner seen from the first one, m.
  Vector2 homogeneous(const Vector2& corner) const;
  void add_to_residual(int element, const PetscScalar* u, PetscScalar* force);

  MPI_Comm comm_;
  const Mesh& mesh_;
  const std::vector<Material>& materials_;
  PetscInt offset_ = 0;            ///< number of this rank's first node in PETSc's numbering
  std::vector<PetscInt> index_;    ///< PETSc's number of each local node
  std::vector<char> held_;         ///< [owned nodes, 2]
  std::vector<char> locks_;        ///< [regions]
  std::vector<Vector2> external_;  ///< [owned nodes]
  Eigen::Vector3d strain_ = Eigen::Vector3d::Zero();
  OwnedVec local_;                  ///< u with ghosts
  std::vector<Vector2> loaded_;     ///< [all local nodes], m
  std::vector<double> cancelling_;  ///< [owned nodes, 2] of the last residual, N/m
  double scale_ = 0;                ///< of the diagonal at held components, Pa
};

}  // namespace slipscale
