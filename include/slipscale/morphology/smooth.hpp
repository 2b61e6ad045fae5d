#pragma once

#include <vector>

#include "slipscale/morphology/composite_mesh.hpp"

namespace slipscale {

/// Moves single nodes of cells with an angle worse than `target` [radian] to where the worst angle around
/// them is best; interfaces and sides stay as they are. Returns the nodes that moved.
std::vector<int> smooth(CompositeMesh& mesh, double target);

}  // namespace slipscale
