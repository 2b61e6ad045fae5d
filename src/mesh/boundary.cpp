#include <algorithm>

#include "stages.hpp"

namespace slipscale::mesh_stages {
namespace {

/// The edge as the cell sees it, if both are here.
std::optional<BoundaryEdge> local_edge(const NumberedSide& side, const Nodes& nodes, const Cells& cells) {
  const auto found = std::ranges::lower_bound(cells.number, side.cell);
  if (found == cells.number.end() || *found != side.cell) return std::nullopt;
  const auto cell = static_cast<int>(found - cells.number.begin());
  const int first = cells.first[cell], count = cells.corner_count(cell);
  for (int k = 0; k < count; ++k) {
    const int a = first + k, b = first + (k + 1) % count;
    const std::array<int, 2> ends{cells.corner_nodes[a], cells.corner_nodes[b]};
    if (nodes.number[ends[0]] != side.from || nodes.number[ends[1]] != side.to) continue;
    const Vector2 &p = cells.corners[a], &q = cells.corners[b];
    BoundaryEdge edge{ends, {p, q}, {q[1] - p[1], p[0] - q[0]}};
    if (side.from > side.to) {
      std::swap(edge.nodes[0], edge.nodes[1]);
      std::swap(edge.ends[0], edge.ends[1]);
    }
    return edge;
  }
  throw LibraryError("an edge is not among the edges of the cell beside it");
}

}  // namespace

void fill_boundary(const std::vector<NumberedSide>& sides, const Nodes& nodes, const Cells& cells,
                   Boundary& boundary) {
  for (const NumberedSide& side : sides)
    if (const auto edge = local_edge(side, nodes, cells);
        edge && (edge->nodes[0] < nodes.owned || edge->nodes[1] < nodes.owned))
      boundary.edges.push_back(*edge);
  std::ranges::sort(boundary.edges, {}, [&](const BoundaryEdge& edge) {
    return std::pair(nodes.number[edge.nodes[0]], nodes.number[edge.nodes[1]]);
  });
  for (const auto& edge : boundary.edges)
    for (int node : edge.nodes)
      if (node < nodes.owned) boundary.nodes.push_back(node);
  std::ranges::sort(boundary.nodes);
  boundary.nodes.erase(std::ranges::unique(boundary.nodes).begin(), boundary.nodes.end());
}

}  // namespace slipscale::mesh_stages
