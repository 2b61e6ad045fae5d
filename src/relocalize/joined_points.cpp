#include <algorithm>
#include <array>
#include <numeric>

#include "slipscale/relocalize/boundary_layer.hpp"

namespace slipscale {
namespace {

/// Numbers coordinates along one axis, those closer than `tolerance` alike.
std::vector<int> levels(const PlaneGrid& grid, int axis, double tolerance) {
  std::vector<int> order(grid.points.size()), level(grid.points.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, {}, [&](int point) { return grid.points[point][axis]; });
  for (std::size_t k = 1; k < order.size(); ++k) {
    const double step = grid.points[order[k]][axis] - grid.points[order[k - 1]][axis];
    level[order[k]] = level[order[k - 1]] + (step > tolerance ? 1 : 0);
  }
  return level;
}

}  // namespace

std::vector<int> joined_points(const PlaneGrid& grid) {
  const Box box = bounding_box(grid);
  const double tolerance = 1e-10 * std::max(box.extent(0), box.extent(1));
  const std::vector<int> x = levels(grid, 0, tolerance), y = levels(grid, 1, tolerance);
  std::vector<int> order(grid.points.size()), first(grid.points.size()), joint(grid.points.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, {}, [&](int point) { return std::array{x[point], y[point], point}; });
  for (std::size_t k = 0; k < order.size(); ++k) {
    const bool same = k > 0 && x[order[k]] == x[order[k - 1]] && y[order[k]] == y[order[k - 1]];
    first[order[k]] = same ? first[order[k - 1]] : order[k];
  }
  int count = 0;
  for (std::size_t p = 0; p < joint.size(); ++p)
    joint[p] = first[p] == static_cast<int>(p) ? count++ : joint[first[p]];
  return joint;
}

}  // namespace slipscale
