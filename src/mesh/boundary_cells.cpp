#include "slipscale/mesh/boundary_cells.hpp"

#include <algorithm>
#include <stdexcept>

namespace slipscale {

std::vector<int> boundary_cells(const Mesh& mesh, const Boundary& boundary) {
  std::vector<std::array<int, 3>> edges;  // ends ascending, and which edge it is
  for (std::size_t e = 0; e < boundary.edges.size(); ++e) {
    const auto& ends = boundary.edges[e].nodes;
    edges.push_back({std::min(ends[0], ends[1]), std::max(ends[0], ends[1]), static_cast<int>(e)});
  }
  std::ranges::sort(edges);
  std::vector<int> beside(boundary.edges.size(), -1);
  for (int cell = 0; cell < mesh.cells.size(); ++cell) {
    const auto nodes = mesh.cells.nodes_of(cell);
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const int a = nodes[k], b = nodes[(k + 1) % nodes.size()];
      const std::array<int, 3> wanted{std::min(a, b), std::max(a, b), 0};
      const auto found = std::ranges::lower_bound(edges, wanted);
      if (found != edges.end() && (*found)[0] == wanted[0] && (*found)[1] == wanted[1])
        beside[(*found)[2]] = cell;
    }
  }
  if (std::ranges::find(beside, -1) != beside.end())
    throw std::logic_error("an edge of boundary '" + boundary.name + "' has no cell on this rank");
  return beside;
}

}  // namespace slipscale
