#pragma once

#include <mpi.h>

#include <vector>

#include "slipscale/homogenize/cell_problem.hpp"
#include "slipscale/mesh/outer_boundary.hpp"

namespace slipscale {

/// Where the solid of a unit cell ends: on the outside, which bears the boundary condition, and around holes,
/// whose edges are free.
struct CellOutline {
  std::vector<OuterEdge> outside, holes;  ///< this rank's edges
  int hole_count = 0;                     ///< of the whole unit cell
  double hole_area = 0;                   ///< m², likewise
};

/// Throws UserError when the mesh does not fit the boundary condition: periodic needs a torus that no pore
/// goes around, the others an outside. Collective.
CellOutline cell_outline(MPI_Comm comm, const Mesh& mesh, CellBoundary boundary);

}  // namespace slipscale
