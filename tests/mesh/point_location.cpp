#include "slipscale/mesh/point_location.hpp"

#include <gtest/gtest.h>

#include <random>

#include "grids.hpp"

using namespace slipscale;
using namespace slipscale::testing_support;

namespace {

/// Distance of a point from a convex cell's edges: the least, negative outside; m.
double depth(const PlaneGrid& grid, int cell, const Vector2& x) {
  const CellCorners corners = grid.corners_of(cell);
  double least = 1e300;
  for (std::size_t k = 0; k < corners.count; ++k) {
    const Vector2 &a = corners.x[k], &b = corners.x[(k + 1) % corners.count];
    const double dx = b[0] - a[0], dy = b[1] - a[1];
    least = std::min(least, (dx * (x[1] - a[1]) - dy * (x[0] - a[0])) / std::hypot(dx, dy));
  }
  return least;
}

/// The lowest cell that holds the point, by looking at all. Rounding in the points is far below the
/// tolerance, and that below the one of the search.
int lowest_holder(const PlaneGrid& grid, const Vector2& x) {
  for (int cell = 0; cell < grid.cells(); ++cell)
    if (depth(grid, cell, x) >= -1e-11 * std::sqrt(area(grid, cell))) return cell;
  return CellPlace::none;
}

Vector2 middle(const Vector2& a, const Vector2& b) { return {0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])}; }

/// Corners, middles of edges and odd points of edges of every cell.
std::vector<Vector2> points_on_edges(const PlaneGrid& grid) {
  std::vector<Vector2> all;
  for (int cell = 0; cell < grid.cells(); ++cell) {
    const CellCorners corners = grid.corners_of(cell);
    for (std::size_t k = 0; k < corners.count; ++k) {
      const Vector2 &a = corners.x[k], &b = corners.x[(k + 1) % corners.count];
      all.insert(all.end(), {a, middle(a, b), middle(a, middle(a, middle(a, b)))});
    }
  }
  return all;
}

/// Small blocks and one with a fine corner, near the origin and far from it.
std::vector<PlaneGrid> grids() {
  std::vector<PlaneGrid> all;
  for (Block block : distorted_blocks(13, 9, 0.15)) {
    all.push_back(block_grid(block));
    block.width = 2e-5;
    block.height = 1e-5;
    all.push_back(block_grid(block, {0.003, -0.002}));
    block.width = block.height = 1;
    block.distortion = 0.1;
    PlaneGrid graded = block_grid(block);
    for (Vector2& x : graded.points)
      for (double& c : x) c = std::pow(c, 3);
    all.push_back(graded);
  }
  return all;
}

}  // namespace

TEST(PointLocation, FindsTheLowestCellThatHoldsAPoint) {
  std::mt19937 numbers(7);
  for (const PlaneGrid& grid : grids()) {
    const PointLocation location(grid);
    const Box box = bounding_box(grid);
    std::uniform_real_distribution<double> x(box.lower[0], box.upper[0]), y(box.lower[1], box.upper[1]);
    std::vector<Vector2> points = points_on_edges(grid);
    for (int k = 0; k < 2000; ++k) points.push_back({x(numbers), y(numbers)});
    for (const Vector2& point : points)
      EXPECT_EQ(location.find(point).cell, lowest_holder(grid, point)) << point[0] << ' ' << point[1];
  }
}

/// Shape functions reproduce linear fields: the place itself.
TEST(PointLocation, GivesTheShapeFunctionsAtThePoint) {
  for (const PlaneGrid& grid : grids()) {
    const PointLocation location(grid);
    const Box box = bounding_box(grid);
    for (int k = 1; k < 100; ++k) {
      const Vector2 x{box.lower[0] + box.extent(0) * std::fmod(0.618034 * k, 1),
                      box.lower[1] + box.extent(1) * std::fmod(0.754878 * k, 1)};
      const CellPlace place = location.find(x);
      ASSERT_NE(place.cell, CellPlace::none);
      const CellCorners corners = grid.corners_of(place.cell);
      Vector2 found{-x[0], -x[1]};
      for (std::size_t c = 0; c < corners.count; ++c)
        for (int d = 0; d < 2; ++d) found[d] += place.shape[c] * corners.x[c][d];
      for (int d = 0; d < 2; ++d) EXPECT_NEAR(found[d], 0, 1e-14 * (std::abs(x[d]) + box.extent(d)));
      EXPECT_NEAR(place.shape[0] + place.shape[1] + place.shape[2] + place.shape[3], 1, 1e-13);
    }
  }
}

/// By the tolerance of the header: a cell of these blocks is about a tenth of the block.
TEST(PointLocation, TellsOutsideFromRounding) {
  for (const Block& block : distorted_blocks(10, 10, 0.2)) {
    const PlaneGrid grid = block_grid(block);
    const PointLocation location(grid);
    for (const double s : {0.05, 0.3, 0.77}) {
      const double near = 1e-11, far = 1e-8;
      for (const Vector2& x :
           {Vector2{-near, s}, Vector2{1 + near, s}, Vector2{s, -near}, Vector2{s, 1 + near}})
        EXPECT_NE(location.find(x).cell, CellPlace::none) << x[0] << ' ' << x[1];
      for (const Vector2& x : {Vector2{-far, s}, Vector2{1 + far, s}, Vector2{s, -far}, Vector2{s, 1 + far}})
        EXPECT_EQ(location.find(x).cell, CellPlace::none) << x[0] << ' ' << x[1];
    }
    EXPECT_EQ(location.find({40, -70}).cell, CellPlace::none);
    EXPECT_EQ(location.find({std::nan(""), 0.5}).cell, CellPlace::none);
  }
}

/// The inside of a frame is outside of the mesh.
TEST(PointLocation, SeesHoles) {
  PlaneGrid frame;
  Block block;
  block.nx = block.ny = 9;
  const PlaneGrid whole = block_grid(block);
  std::vector<int> kept;
  for (int cell = 0; cell < whole.cells(); ++cell) {
    const Vector2 x = centre(whole, cell);
    if (std::max(std::abs(x[0] - 0.5), std::abs(x[1] - 0.5)) > 1.0 / 6) kept.push_back(cell);
  }
  append_cells(frame, whole, kept, {2, 0});
  const PointLocation location(frame);
  EXPECT_EQ(location.find({2.5, 0.5}).cell, CellPlace::none);
  EXPECT_EQ(location.find({0.1, 0.5}).cell, CellPlace::none);
  const CellPlace place = location.find({2.1, 0.5});
  ASSERT_NE(place.cell, CellPlace::none);
  EXPECT_GE(depth(frame, place.cell, {2.1, 0.5}), 0);
}
