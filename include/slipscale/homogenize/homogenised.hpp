#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "slipscale/homogenize/cell_problem.hpp"
#include "slipscale/homogenize/effective.hpp"

namespace slipscale {

/// All that a run of `homogenize` finds.
struct Homogenised {
  std::vector<Phase> phases;  ///< by region, and the holes last where there are any
  std::vector<CellSolution>
      solutions;  ///< one for each boundary condition asked for; the first is the result
  std::vector<Eigen::Matrix3d> refined;  ///< C_eff on the once refined mesh, one for each solution; or empty
  std::vector<Eigen::Matrix3d> phase_means;  ///< ⟨A⟩ over each of `phases`, of the first solution; or empty
  std::vector<double> coefficients;          ///< of friction, by region; or empty
  PetscInt cells = 0, nodes = 0;
  std::uint64_t mesh_checksum = 0;  ///< Mesh::checksum
  int ranks = 1;
  double memory = 0;   ///< of all ranks, bytes
  double seconds = 0;  ///< in all, mesh reading included
};

/// The effective material: C of the first solution, its symmetric part, and the mean density.
Material effective_material(const Homogenised& found);

/// Size of the difference of C_eff from the mean stress and from the energy, over that of C_eff. Zero, by
/// Hill and Mandel.
double hill_mandel_residual(const CellSolution& solution);

/// Largest |⟨A⟩ − I|.
double mean_localisation_defect(const CellSolution& solution);

/// `two_phase_identity` of the first solution; absent where there are not two elastic phases or no means.
std::optional<double> two_phase_residual(const Homogenised& found);

/// Richardson's estimate for one of the solutions; absent without refined mesh.
std::optional<Richardson> discretisation_error(const Homogenised& found, std::size_t solution);

/// The coefficient of the effective material's face, and the mean of those of its phases; of phases that show
/// as much of themselves on the face as they fill of the cell. Absent where theirs are not known.
struct FrictionOfPhases {
  double effective = 0, mean = 0;
};
std::optional<FrictionOfPhases> friction_of_phases(const Homogenised& found);

/// What makes the stiffness doubtful, a sentence each without stop: bounds that it violates, elements that
/// lock. They stand in effective.yaml, and who reads it hears of them.
std::vector<std::string> doubts(const Homogenised& found);

/// The report for the screen: moduli in GPa, bounds with a check mark, residuals, error bars, costs.
std::string describe(const Homogenised& found);

/// effective.yaml: `stiffness` [c11, c22, c12, c66, c16, c26] in Pa and `density`, which `slide` reads with
/// -material_file, `doubt` where there is any, and everything else of the report nested under `homogenize`,
/// with the options `effective` under `homogenize: options:`.
std::string effective_yaml(const Homogenised& found, const std::map<std::string, std::string>& effective);

}  // namespace slipscale
