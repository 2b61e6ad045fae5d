#include "side_by_side.hpp"

#include <algorithm>
#include <cmath>

namespace slipscale {
namespace {

struct Side {
  std::array<int, 2> ends;  ///< low, high
  int cell, low;            ///< `low`: the corner of the cell, among all corners, that is the first of them
  auto operator<=>(const Side&) const = default;
};

/// Of all cells, ascending ends.
std::vector<Side> sides_of(const RegionCells& cells) {
  std::vector<Side> sides;
  sides.reserve(cells.node.size());
  for (int cell = 0; cell < cells.size(); ++cell)
    for (int begin = cells.first[cell], end = cells.first[cell + 1], k = begin; k < end; ++k) {
      const int next = k + 1 < end ? k + 1 : begin, a = cells.node[k], b = cells.node[next];
      sides.push_back({{std::min(a, b), std::max(a, b)}, cell, a < b ? k : next});
    }
  std::ranges::sort(sides);
  return sides;
}

/// Neighbours of cells: where they share a node.
struct Neighbour {
  int cell, own, other;  ///< corners
};
std::vector<std::vector<Neighbour>> neighbours_of(const RegionCells& cells) {
  std::vector<std::vector<Neighbour>> found(static_cast<std::size_t>(cells.size()));
  const auto sides = sides_of(cells);
  for (std::size_t s = 1; s < sides.size(); ++s)
    if (const Side& one = sides[s - 1], &other = sides[s]; one.ends == other.ends) {
      found[one.cell].push_back({other.cell, one.low, other.low});
      found[other.cell].push_back({one.cell, other.low, one.low});
    }
  return found;
}

}  // namespace

std::vector<Vector2> side_by_side(const RegionCells& cells, const std::vector<int>& part) {
  std::vector<Vector2> shift(static_cast<std::size_t>(cells.size()), {0, 0});
  if (cells.period[0] == 0 && cells.period[1] == 0) return shift;
  const auto neighbours = neighbours_of(cells);
  std::vector<char> placed(shift.size(), 0);
  std::vector<int> front;
  for (int first = 0; first < cells.size(); ++first) {
    if (placed[first]) continue;
    placed[first] = 1;
    front.assign(1, first);
    for (std::size_t next = 0; next < front.size(); ++next)
      for (const auto& [cell, own, other] : neighbours[front[next]]) {
        if (placed[cell] || part[cell] != part[first]) continue;
        placed[cell] = 1;
        for (int axis = 0; axis < 2; ++axis)
          if (const double period = cells.period[axis]; period > 0)
            shift[cell][axis] =
                std::round((cells.corner[own][axis] + shift[front[next]][axis] - cells.corner[other][axis]) /
                           period) *
                period;
        front.push_back(cell);
      }
  }
  return shift;
}

}  // namespace slipscale
