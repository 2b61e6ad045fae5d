#pragma once

#include <vector>

#include "slipscale/mesh/mesh.hpp"

namespace slipscale {

/// The cell beside each edge of an outer boundary, by local number, [edges]. Every cell around an owned node
/// is local, so each edge has its own.
std::vector<int> boundary_cells(const Mesh& mesh, const Boundary& boundary);

}  // namespace slipscale
