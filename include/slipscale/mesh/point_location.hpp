#pragma once

#include <array>
#include <vector>

#include "slipscale/mesh/plane_grid.hpp"

namespace slipscale {

/// The cell that holds a point, and its shape functions there.
struct CellPlace {
  static constexpr int none = -1;
  int cell = none;
  std::array<double, 4> shape{};  ///< one a corner; their sum is 1
};

/// Finds the cell of a mesh that holds a point: on an edge or a corner the one with the lowest number among
/// those that meet there, and none where the point lies outside of all by more than 1e-9 of the cell's size.
/// Triangles, quadrilaterals (convex) and both together.
///
/// The cells are sorted into a uniform grid of as many buckets, so that a search looks at a few of them. (The
/// DMLocatePoints of PETSc 3.18 loses points on the edges of quadrilaterals, and points within them as well
/// under -dm_plex_hash_location; without that it looks at every cell for every point.)
class PointLocation {
 public:
  /// `grid` must outlive this object.
  explicit PointLocation(const PlaneGrid& grid);

  CellPlace find(const Vector2& x) const;

 private:
  std::array<int, 2> bucket(const Vector2& x) const;
  /// Calls `visit(bucket)` for each bucket that the cell may reach into.
  template <class Visit>
  void buckets_of(int cell, Visit visit) const;

  const PlaneGrid& grid_;
  Box box_;
  std::array<int, 2> count_{1, 1};  ///< buckets along x and y
  std::vector<int> first_, cells_;  ///< [buckets + 1], and the cells of each, ascending
};

}  // namespace slipscale
