#pragma once

#include "slipscale/mesh/inclusions.hpp"

namespace slipscale {

/// Of each cell of a region, how far it is moved, by whole periods, to lie beside the others of its part, m:
/// from cell to cell across the edges that they share, from the lowest cell of each part on, which stays. A
/// part may so be wider than half a period; one that goes round the torus is cut open somewhere. `part`
/// [cells]: the same number for all cells that hang together across edges.
std::vector<Vector2> side_by_side(const RegionCells& cells, const std::vector<int>& part);

}  // namespace slipscale
