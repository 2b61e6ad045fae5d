#include "slipscale/mesh/outer_boundary.hpp"

#include <algorithm>
#include <limits>

namespace slipscale {
namespace {

/// A side of a cell, counter-clockwise from this corner.
struct Side {
  std::array<int, 2> nodes;  ///< ascending
  int cell, corner;
};

/// Some successive nodes, and the cells among which all those are that have sides with a lower node there.
struct Stretch {
  int begin = 0, end = 0;
  int first_cell = std::numeric_limits<int>::max(), last_cell = -1;
};

std::vector<Stretch> stretches(const Mesh& mesh, int nodes) {
  std::vector<Stretch> all;
  for (int begin = 0; begin < mesh.nodes.owned; begin += nodes)
    all.push_back({begin, std::min(begin + nodes, mesh.nodes.owned)});
  for (int cell = 0; cell < mesh.cells.size(); ++cell)
    for (const int node : mesh.cells.nodes_of(cell)) {
      if (node >= mesh.nodes.owned) continue;
      Stretch& stretch = all[node / nodes];
      stretch.first_cell = std::min(stretch.first_cell, cell);
      stretch.last_cell = std::max(stretch.last_cell, cell);
    }
  return all;
}

/// All sides whose lower node is in the stretch, so that they have an owned node.
void find_sides(const Mesh& mesh, const Stretch& stretch, std::vector<Side>& sides) {
  sides.clear();
  for (int cell = stretch.first_cell; cell <= stretch.last_cell; ++cell) {
    const auto nodes = mesh.cells.nodes_of(cell);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const auto [low, high] = std::minmax(nodes[i], nodes[(i + 1) % nodes.size()]);
      if (low >= stretch.begin && low < stretch.end)
        sides.push_back({{low, high}, cell, static_cast<int>(i)});
    }
  }
}

OuterEdge edge_of(const Mesh& mesh, const Side& side) {
  const int first = mesh.cells.first[side.cell], count = mesh.cells.corner_count(side.cell);
  const int i = first + side.corner, j = first + (side.corner + 1) % count;
  const Vector2 &x = mesh.cells.corners[i], &y = mesh.cells.corners[j];
  return {{mesh.cells.corner_nodes[i], mesh.cells.corner_nodes[j]}, {y[1] - x[1], x[0] - y[0]}};
}

}  // namespace

/// In several goes, so that the list of all sides is never there: it would be as large as the mesh.
std::vector<OuterEdge> outer_edges(const Mesh& mesh) {
  std::vector<OuterEdge> outer;
  std::vector<Side> sides;
  for (const Stretch& stretch : stretches(mesh, std::max(1 << 14, mesh.nodes.owned / 16))) {
    find_sides(mesh, stretch, sides);
    std::ranges::sort(sides, {}, &Side::nodes);
    for (std::size_t k = 0; k < sides.size(); ++k) {
      const bool shared = (k > 0 && sides[k - 1].nodes == sides[k].nodes) ||
                          (k + 1 < sides.size() && sides[k + 1].nodes == sides[k].nodes);
      if (!shared) outer.push_back(edge_of(mesh, sides[k]));
    }
  }
  return outer;
}

}  // namespace slipscale
