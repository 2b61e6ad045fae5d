#pragma once

#include "slipscale/homogenize/cell_problem.hpp"
#include "slipscale/mesh/outer_boundary.hpp"

namespace slipscale {

/// Throws UserError when the mesh does not fit the boundary condition: periodic needs a torus, the others an
/// open boundary. (That it is a body of one part whose sides match is seen when it is read.) Collective.
void refuse_unfit(MPI_Comm comm, const Mesh& mesh, CellBoundary boundary,
                  const std::vector<OuterEdge>& outer);

/// The sentences, to be thrown on every rank: a torus whose sides are open, and a mesh without an outside.
[[noreturn]] void refuse_unpaired(const Mesh& mesh);
[[noreturn]] void refuse_closed(const Mesh& mesh, CellBoundary boundary);

}  // namespace slipscale
