#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "slipscale/base/box.hpp"
#include "slipscale/base/vector2.hpp"

namespace slipscale {

/// Corners of one triangle or quadrilateral, counter-clockwise, m.
struct CellCorners {
  std::array<Vector2, 4> x{};
  std::size_t count = 0;
  operator std::span<const Vector2>() const { return {x.data(), count}; }
};

/// A plane mesh as its files hold it: the whole of it, in their order. The seam of a torus is cut open.
struct PlaneGrid {
  std::vector<Vector2> points;       ///< m
  std::vector<int> first{0};         ///< [cells + 1] where the corners of a cell start
  std::vector<int> corners;          ///< point of each corner, counter-clockwise
  std::vector<int> region;           ///< [cells] index into `regions`
  std::vector<std::string> regions;  ///< names

  int cells() const { return static_cast<int>(region.size()); }
  int corner_count(int cell) const { return first[cell + 1] - first[cell]; }
  CellCorners corners_of(int cell) const;
};

/// Mean of the corners, m: where the strain and the stress of a cell are given.
Vector2 centre(const PlaneGrid& grid, int cell);
double area(const PlaneGrid& grid, int cell);  ///< m²

std::vector<Vector2> centres(const PlaneGrid& grid);  ///< [cells], m
std::vector<double> areas(const PlaneGrid& grid);     ///< [cells], m²

/// Of the points of the cells.
Box bounding_box(const PlaneGrid& grid);

/// Appends the given cells of another mesh with the same region names, shifted; its points are numbered anew,
/// those of these cells only.
void append_cells(PlaneGrid& grid, const PlaneGrid& other, std::span<const int> cells, const Vector2& shift);

}  // namespace slipscale
