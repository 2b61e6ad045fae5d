#include "slipscale/mesh/point_location.hpp"

#include <algorithm>
#include <cmath>

#include "slipscale/mesh/shape_functions.hpp"

namespace slipscale {
namespace {

constexpr double tolerance = 1e-9;  ///< of the cell's size, as `shape_values_at` has it

/// The rectangle around a cell, a little enlarged.
Box reach(const CellCorners& corners) {
  Box box{corners.x[0], corners.x[0]};
  for (const Vector2& x : std::span<const Vector2>(corners))
    for (int d = 0; d < 2; ++d) {
      box.lower[d] = std::min(box.lower[d], x[d]);
      box.upper[d] = std::max(box.upper[d], x[d]);
    }
  const double little = 2 * tolerance * std::max(box.extent(0), box.extent(1));
  for (int d = 0; d < 2; ++d) {
    box.lower[d] -= little;
    box.upper[d] += little;
  }
  return box;
}

bool holds(const Box& box, const Vector2& x) {
  return x[0] >= box.lower[0] && x[0] <= box.upper[0] && x[1] >= box.lower[1] && x[1] <= box.upper[1];
}

}  // namespace

PointLocation::PointLocation(const PlaneGrid& grid) : grid_(grid), box_(bounding_box(grid)) {
  const double width = box_.extent(0), height = box_.extent(1), cells = grid.cells();
  // As many as there are cells: of a thin strip all of them along it.
  const auto buckets = [cells](double aspect) {
    return static_cast<int>(std::clamp(std::sqrt(cells * aspect), 1.0, std::max(cells, 1.0)));
  };
  if (width > 0 && height > 0) count_ = {buckets(width / height), buckets(height / width)};
  first_.assign(static_cast<std::size_t>(count_[0]) * count_[1] + 1, 0);
  for (int cell = 0; cell < grid.cells(); ++cell) buckets_of(cell, [&](int b) { ++first_[b + 1]; });
  for (std::size_t b = 1; b < first_.size(); ++b) first_[b] += first_[b - 1];
  cells_.resize(static_cast<std::size_t>(first_.back()));
  std::vector<int> next(first_);
  for (int cell = 0; cell < grid.cells(); ++cell) buckets_of(cell, [&](int b) { cells_[next[b]++] = cell; });
}

/// Of a point outside: the nearest.
std::array<int, 2> PointLocation::bucket(const Vector2& x) const {
  std::array<int, 2> at{};
  for (int d = 0; d < 2; ++d) {
    const double place = std::floor((x[d] - box_.lower[d]) / box_.extent(d) * count_[d]);
    at[d] = static_cast<int>(std::clamp(place, 0.0, count_[d] - 1.0));
  }
  return at;
}

template <class Visit>
void PointLocation::buckets_of(int cell, Visit visit) const {
  const Box around = reach(grid_.corners_of(cell));
  const auto lower = bucket(around.lower), upper = bucket(around.upper);
  for (int j = lower[1]; j <= upper[1]; ++j)
    for (int i = lower[0]; i <= upper[0]; ++i) visit(j * count_[0] + i);
}

CellPlace PointLocation::find(const Vector2& x) const {
  if (grid_.cells() == 0 || !std::isfinite(x[0]) || !std::isfinite(x[1])) return {};
  const auto [i, j] = bucket(x);
  const int b = j * count_[0] + i;
  for (int k = first_[b]; k < first_[b + 1]; ++k) {
    CellCorners corners = grid_.corners_of(cells_[k]);
    if (!holds(reach(corners), x)) continue;
    // Seen from the point, so that a small cell far from the origin loses no digits.
    for (std::size_t c = 0; c < corners.count; ++c)
      for (int d = 0; d < 2; ++d) corners.x[c][d] -= x[d];
    CellPlace place{cells_[k], {}};
    if (shape_values_at(corners, {0, 0}, place.shape)) return place;
  }
  return {};
}

}  // namespace slipscale
