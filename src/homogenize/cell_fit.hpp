#pragma once

#include "slipscale/homogenize/cell_problem.hpp"
#include "slipscale/mesh/outer_boundary.hpp"

namespace slipscale {

/// Throws UserError when the mesh does not fit the boundary condition: periodic needs a torus without holes
/// whose sides match, the others an outer boundary and no holes, all of them a body of one part. Collective.
void refuse_unfit(MPI_Comm comm, const Mesh& mesh, CellBoundary boundary,
                  const std::vector<OuterEdge>& outer);

}  // namespace slipscale
