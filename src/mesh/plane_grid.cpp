#include "slipscale/mesh/plane_grid.hpp"

#include <algorithm>
#include <limits>

#include "slipscale/mesh/shape_functions.hpp"

namespace slipscale {

CellCorners PlaneGrid::corners_of(int cell) const {
  CellCorners all;
  for (int k = first[cell]; k < first[cell + 1]; ++k) all.x[all.count++] = points[corners[k]];
  return all;
}

Vector2 centre(const PlaneGrid& grid, int cell) {
  const CellCorners corners = grid.corners_of(cell);
  Vector2 sum{};
  for (const Vector2& x : std::span<const Vector2>(corners))
    for (int d = 0; d < 2; ++d) sum[d] += x[d];
  const double count = static_cast<double>(corners.count);
  return {sum[0] / count, sum[1] / count};
}

double area(const PlaneGrid& grid, int cell) { return cell_area(grid.corners_of(cell)); }

std::vector<Vector2> centres(const PlaneGrid& grid) {
  std::vector<Vector2> all(grid.region.size());
  for (int cell = 0; cell < grid.cells(); ++cell) all[cell] = centre(grid, cell);
  return all;
}

std::vector<double> areas(const PlaneGrid& grid) {
  std::vector<double> all(grid.region.size());
  for (int cell = 0; cell < grid.cells(); ++cell) all[cell] = area(grid, cell);
  return all;
}

Box bounding_box(const PlaneGrid& grid) {
  constexpr double far = std::numeric_limits<double>::infinity();
  Box box{{far, far}, {-far, -far}};
  for (const int point : grid.corners)
    for (int d = 0; d < 2; ++d) {
      box.lower[d] = std::min(box.lower[d], grid.points[point][d]);
      box.upper[d] = std::max(box.upper[d], grid.points[point][d]);
    }
  return box;
}

void append_cells(PlaneGrid& grid, const PlaneGrid& other, std::span<const int> cells, const Vector2& shift) {
  std::vector<int> number(other.points.size(), -1);
  for (const int cell : cells) {
    for (int k = other.first[cell]; k < other.first[cell + 1]; ++k) {
      int& point = number[other.corners[k]];
      if (point < 0) {
        point = static_cast<int>(grid.points.size());
        const Vector2& x = other.points[other.corners[k]];
        grid.points.push_back({x[0] + shift[0], x[1] + shift[1]});
      }
      grid.corners.push_back(point);
    }
    grid.first.push_back(static_cast<int>(grid.corners.size()));
    grid.region.push_back(other.region[cell]);
  }
}

}  // namespace slipscale
