#include "slipscale/morphology/smooth.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <unordered_map>

#include "slipscale/morphology/quality.hpp"

namespace slipscale {
namespace {

constexpr int passes = 4;       ///< over all bad cells
constexpr int halvings = 6;     ///< of the length of a move
constexpr double first = 0.25;  ///< move, over the distance to the nearest neighbour

/// The cells around the nodes of bad cells.
class Patches {
 public:
  Patches(const CompositeMesh& mesh, const std::vector<int>& bad) {
    for (int cell : bad)
      for (int i = 0; i < mesh.cells[cell].count; ++i) cells_[mesh.cells[cell].corners[i]];
    for (std::size_t k = 0; k < mesh.cells.size(); ++k)
      for (int i = 0; i < mesh.cells[k].count; ++i)
        if (const auto patch = cells_.find(mesh.cells[k].corners[i]); patch != cells_.end())
          patch->second.push_back(static_cast<int>(k));
  }

  const std::vector<int>& around(int node) const { return cells_.at(node); }

  /// Whether the cells close around the node and lie in one part of the composite.
  bool free(const CompositeMesh& mesh, int node) const {
    std::set<int> leaving, arriving;
    for (int k : around(node)) {
      const CompositeMesh::Cell &cell = mesh.cells[k], &other = mesh.cells[around(node).front()];
      if (cell.region != other.region || cell.inclusion != other.inclusion) return false;
      for (int i = 0; i < cell.count; ++i)
        if (cell.corners[i] == node) {
          leaving.insert(cell.corners[(i + 1) % cell.count]);
          arriving.insert(cell.corners[(i + cell.count - 1) % cell.count]);
        }
    }
    return leaving == arriving;
  }

  double worst(const CompositeMesh& mesh, int node) const {
    double least = std::numbers::pi;
    for (int k : around(node)) least = std::min(least, worst_angle(mesh.corners(mesh.cells[k])));
    return least;
  }

 private:
  std::unordered_map<int, std::vector<int>> cells_;
};

double nearest_neighbour(const CompositeMesh& mesh, const Patches& patches, int node) {
  double least = 1e300;
  for (int k : patches.around(node))
    for (const Vector2& x : mesh.corners(mesh.cells[k]))
      if (x != mesh.nodes[node])
        least = std::min(least, std::hypot(x[0] - mesh.nodes[node][0], x[1] - mesh.nodes[node][1]));
  return least;
}

/// Pattern search in eight directions. Returns whether the node moved.
bool improve(CompositeMesh& mesh, const Patches& patches, int node) {
  double best = patches.worst(mesh, node), step = first * nearest_neighbour(mesh, patches, node);
  bool moved = false;
  for (int halving = 0; halving < halvings; step *= 0.5, ++halving)
    for (int direction = 0; direction < 8; ++direction) {
      const Vector2 before = mesh.nodes[node];
      const double angle = std::numbers::pi * direction / 4;
      mesh.nodes[node] = {before[0] + step * std::cos(angle), before[1] + step * std::sin(angle)};
      if (const double worst = patches.worst(mesh, node); worst > best) {
        best = worst;
        moved = true;
      } else {
        mesh.nodes[node] = before;
      }
    }
  return moved;
}

}  // namespace

std::vector<int> smooth(CompositeMesh& mesh, double target) {
  std::vector<int> bad;
  for (std::size_t k = 0; k < mesh.cells.size(); ++k)
    if (worst_angle(mesh.corners(mesh.cells[k])) < target) bad.push_back(static_cast<int>(k));
  const Patches patches(mesh, bad);
  std::set<int> moved;
  for (int pass = 0; pass < passes; ++pass)
    for (int cell : bad) {
      if (worst_angle(mesh.corners(mesh.cells[cell])) >= target) continue;
      for (int i = 0; i < mesh.cells[cell].count; ++i)
        if (const int node = mesh.cells[cell].corners[i];
            patches.free(mesh, node) && improve(mesh, patches, node))
          moved.insert(node);
    }
  return {moved.begin(), moved.end()};
}

}  // namespace slipscale
