#pragma once

#include <functional>
#include <string>
#include <vector>

#include "slipscale/base/options.hpp"
#include "slipscale/homogenize/homogenised.hpp"
#include "slipscale/mesh/read.hpp"

namespace slipscale {

/// What the user wants of `homogenize`.
struct HomogenisationChoice {
  MeshSource source;
  std::vector<CellBoundary> boundaries;  ///< the first gives the result
  bool estimate_error = true;            ///< by a uniform refinement
  std::string folder;
};

Schema homogenisation_schema();

/// The phases' coefficients of friction, by region; empty where none is given. Throws UserError for some
/// without the others.
std::vector<double> read_coefficients(const Options& options, const std::vector<std::string>& regions);
HomogenisationChoice read_homogenisation(const Options& options);

/// The mesh of the first boundary condition: a torus for periodic ones, the same block with its sides open
/// for the others. Throws UserError as `read_mesh` does. Collective.
Mesh homogenisation_mesh(MPI_Comm comm, const HomogenisationChoice& choice);

/// Solves under each boundary condition on its mesh, the first on `mesh`, and on the refined ones where an
/// error bar is wanted. `after_first` is called when the first is solved and PETSc has read its options.
/// Throws UserError as `solve_cell` does, and when the mesh file changes meanwhile. Collective.
Homogenised homogenise(MPI_Comm comm, const HomogenisationChoice& choice, const Mesh& mesh,
                       const std::vector<Material>& materials,
                       const std::function<void(const CellSolution&)>& after_first);

}  // namespace slipscale
