#include "slipscale/mesh/outer_boundary.hpp"

#include <algorithm>

namespace slipscale {
namespace {

/// A side of a cell, counter-clockwise from this corner.
struct Side {
  std::array<int, 2> nodes;  ///< ascending
  int cell, corner;
};

/// All sides whose lower node is in [begin, end), those with an owned node.
void find_sides(const Mesh& mesh, int begin, int end, std::vector<Side>& sides) {
  sides.clear();
  for (int cell = 0; cell < mesh.cells.size(); ++cell) {
    const auto nodes = mesh.cells.nodes_of(cell);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      const auto [low, high] = std::minmax(nodes[i], nodes[(i + 1) % nodes.size()]);
      if (low >= begin && low < end) sides.push_back({{low, high}, cell, static_cast<int>(i)});
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
  const int owned = mesh.nodes.owned, stretch = std::max(1 << 14, owned / 16);
  std::vector<OuterEdge> outer;
  std::vector<Side> sides;
  for (int begin = 0; begin < owned; begin += stretch) {
    find_sides(mesh, begin, std::min(begin + stretch, owned), sides);
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
