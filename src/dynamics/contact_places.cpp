#include "slipscale/dynamics/contact_places.hpp"

#include <algorithm>
#include <cmath>

#include "slipscale/mesh/boundary_cells.hpp"

namespace slipscale {

std::vector<ContactPlace> contact_places(const Mesh& mesh, const Boundary& boundary) {
  struct Share {
    int region;
    double length;
  };
  std::vector<std::vector<Share>> shares(static_cast<std::size_t>(mesh.nodes.size()));
  const auto cells = boundary_cells(mesh, boundary);
  for (std::size_t e = 0; e < cells.size(); ++e)
    for (const int end : boundary.edges[e].nodes)
      shares[end].push_back({mesh.cells.region[cells[e]],
                             std::hypot(boundary.edges[e].outward[0], boundary.edges[e].outward[1])});
  std::vector<ContactPlace> places(shares.size());
  for (std::size_t i = 0; i < shares.size(); ++i) {
    auto& own = shares[i];
    if (own.empty()) continue;
    std::ranges::sort(own, {}, &Share::region);
    places[i].place = mesh.nodes.position[i];
    places[i].region = {own.front().region, own.back().region};
    if (own.size() > 1) places[i].second = own.back().length / (own.front().length + own.back().length);
  }
  return places;
}

}  // namespace slipscale
