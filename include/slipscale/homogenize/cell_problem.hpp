#pragma once

#include <array>
#include <string>
#include <vector>

#include "slipscale/base/options.hpp"
#include "slipscale/mesh/mesh.hpp"
#include "slipscale/solid/material.hpp"

namespace slipscale {

/// A *cell* is a unit cell here, the piece of the microstructure that is homogenised; the triangles and
/// quadrilaterals of its mesh are *elements*.

/// What the cell's outer boundary does under a macroscopic strain E or stress Σ.
enum class CellBoundary {
  periodic,  ///< the displacement is E·x plus a periodic fluctuation, on a torus
  kubc,      ///< u = E·x on the boundary (kinematic uniform): stiffest
  subc       ///< t = Σ·n on the boundary (static uniform): softest
};

/// The unit load cases in Voigt order: xx, yy, and the engineering shear xy.
inline constexpr int load_cases = 3;

/// What one load case cost.
struct CaseCost {
  PetscInt newton_steps = 0, iterations = 0;
  double seconds = 0;
  std::string converged;  ///< PETSc's name of the reason
};

/// Holes of a cell, all together. Their edges are free under every boundary condition.
struct CellHoles {
  int count = 0;
  double area = 0;                                         ///< m²
  Eigen::Matrix3d localisation = Eigen::Matrix3d::Zero();  ///< ⟨A⟩ over them, from their edges
};

/// The cell under the three load cases of one kind of boundary condition.
struct CellSolution {
  CellBoundary boundary = CellBoundary::periodic;
  /// Strain of each local element per unit macroscopic strain, averaged over it: column k belongs to load
  /// case k. The localisation tensor A: ε = A:E, [local elements].
  std::vector<Eigen::Matrix3d> localisation;
  Eigen::Matrix3d stiffness = Eigen::Matrix3d::Zero();  ///< C_eff from the mean stress, Pa
  /// C_eff from the energy, ⟨(A)ᵀ:C:A⟩ over the Gauss points, Pa. Hill and Mandel: equal to `stiffness`.
  Eigen::Matrix3d energy_stiffness = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d mean_localisation = Eigen::Matrix3d::Zero();  ///< ⟨A⟩, holes included: I
  double area = 0;                                              ///< of the cell, holes included, m²
  CellHoles holes;
  std::vector<std::string> locking;  ///< regions that are nearly incompressible and have triangles
  std::vector<std::string> notes;    ///< on options of PETSc's that this solver does not read
  std::array<CaseCost, load_cases> cost;
  double set_up_seconds = 0;  ///< matrix and preconditioner
  std::string solver;         ///< "cg + gamg", say
  PetscInt unknowns = 0;      ///< degrees of freedom of the whole cell
};

/// Solves the cell by SNES/KSP under the options prefix `cell_`. One Jacobian serves the three cases. Throws
/// UserError when the mesh does not fit the boundary condition (periodic needs a torus whose sides match, the
/// others need a boundary), when it falls into parts, when PETSc does not take the solver that is asked for,
/// when the solver does not converge, and when a cell with holes bears no load. Collective.
CellSolution solve_cell(MPI_Comm comm, const Mesh& mesh, const std::vector<Material>& materials,
                        CellBoundary boundary);

/// ⟨A⟩ over each region of the mesh, [regions]. Collective.
std::vector<Eigen::Matrix3d> phase_means(MPI_Comm comm, const Mesh& mesh, const CellSolution& solution);

const char* name(CellBoundary boundary);

}  // namespace slipscale
