#include "slipscale/mesh/outer_boundary.hpp"

#include <algorithm>

namespace slipscale {

std::vector<OuterEdge> outer_edges(const Mesh& mesh) {
  struct Seen {
    std::array<int, 2> nodes;  // ascending
    int cell, corner;
  };
  std::vector<Seen> seen;
  for (int cell = 0; cell < mesh.cells.size(); ++cell) {
    const int first = mesh.cells.first[cell], count = mesh.cells.corner_count(cell);
    for (int i = 0; i < count; ++i) {
      const int a = mesh.cells.corner_nodes[first + i], b = mesh.cells.corner_nodes[first + (i + 1) % count];
      if (a < mesh.nodes.owned || b < mesh.nodes.owned)
        seen.push_back({{std::min(a, b), std::max(a, b)}, cell, i});
    }
  }
  std::ranges::sort(seen, {}, &Seen::nodes);
  std::vector<OuterEdge> outer;
  for (std::size_t k = 0; k < seen.size(); ++k) {
    const bool shared = (k > 0 && seen[k - 1].nodes == seen[k].nodes) ||
                        (k + 1 < seen.size() && seen[k + 1].nodes == seen[k].nodes);
    if (shared) continue;
    const int first = mesh.cells.first[seen[k].cell], count = mesh.cells.corner_count(seen[k].cell);
    const int i = first + seen[k].corner, j = first + (seen[k].corner + 1) % count;
    const Vector2 &x = mesh.cells.corners[i], &y = mesh.cells.corners[j];
    outer.push_back({{mesh.cells.corner_nodes[i], mesh.cells.corner_nodes[j]}, {y[1] - x[1], x[0] - y[0]}});
  }
  return outer;
}

}  // namespace slipscale
