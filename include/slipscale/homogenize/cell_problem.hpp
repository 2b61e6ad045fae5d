#pragma once

#include <array>
#include <string>
#include <vector>

#include "slipscale/base/options.hpp"
#include "slipscale/mesh/mesh.hpp"
#include "slipscale/solid/material.hpp"

namespace slipscale {

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

/// The cell under the three load cases of one kind of boundary condition.
struct CellSolution {
  CellBoundary boundary = CellBoundary::periodic;
  /// Strain of each local cell per unit macroscopic strain, averaged over the cell: column k belongs to load
  /// case k. The localisation tensor A: ε = A:E, [local cells].
  std::vector<Eigen::Matrix3d> localisation;
  Eigen::Matrix3d stiffness = Eigen::Matrix3d::Zero();  ///< C_eff from the mean stress, Pa
  /// C_eff from the energy, ⟨(A)ᵀ:C:A⟩ over the Gauss points, Pa. Hill and Mandel: equal to `stiffness`.
  Eigen::Matrix3d energy_stiffness = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d mean_localisation = Eigen::Matrix3d::Zero();  ///< ⟨A⟩, which is I
  std::array<CaseCost, load_cases> cost;
  double set_up_seconds = 0;  ///< matrix and preconditioner
  std::string solver;         ///< "cg + gamg", say
  PetscInt unknowns = 0;      ///< degrees of freedom of the whole cell
};

/// Solves the cell by SNES/KSP under the options prefix `cell_`. One Jacobian serves the three cases. Throws
/// UserError when the mesh does not fit the boundary condition (periodic needs a torus whose sides match, the
/// others need a boundary), when it falls into parts or has holes, when PETSc does not take the solver that
/// is asked for, and when the solver does not converge. Collective.
CellSolution solve_cell(MPI_Comm comm, const Mesh& mesh, const std::vector<Material>& materials,
                        CellBoundary boundary);

/// ⟨A⟩ over each region of the mesh, [regions]. Collective.
std::vector<Eigen::Matrix3d> phase_means(MPI_Comm comm, const Mesh& mesh, const CellSolution& solution);

const char* name(CellBoundary boundary);

}  // namespace slipscale
