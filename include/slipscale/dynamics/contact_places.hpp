#pragma once

#include <vector>

#include "slipscale/contact/law.hpp"
#include "slipscale/mesh/mesh.hpp"

namespace slipscale {

/// Where the nodes of the boundary lie, and the regions of the edges that meet in each, by local node. The
/// lower region first, so that the mean does not depend on the order of edges.
std::vector<ContactPlace> contact_places(const Mesh& mesh, const Boundary& boundary);

}  // namespace slipscale
