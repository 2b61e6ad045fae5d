#include <gtest/gtest.h>

#include <random>

#include "grids.hpp"
#include "report.hpp"
#include "slipscale/relocalize/strain_recovery.hpp"

using namespace slipscale;
using namespace slipscale::testing_support;

namespace {

using Field = std::function<double(const Vector2&)>;

/// Largest difference between a field recovered from its values at the centres and itself, at points all over
/// the mesh, its outline and corners included.
double largest_error(const PlaneGrid& grid, Recovery recovery, const Field& field) {
  const Box box = bounding_box(grid);
  const PointLocation location(grid);
  std::vector<Vector2> points;
  std::vector<CellPlace> places;
  constexpr int samples = 41;
  for (int j = 0; j <= samples; ++j)
    for (int i = 0; i <= samples; ++i) {
      points.push_back(
          {box.lower[0] + box.extent(0) * i / samples, box.lower[1] + box.extent(1) * j / samples});
      places.push_back(location.find(points.back()));
      EXPECT_NE(places.back().cell, CellPlace::none);
    }
  std::vector<std::array<double, 3>> cells, found(points.size());
  for (const Vector2& x : centres(grid)) cells.push_back({field(x), -field(x), 1});
  StrainRecovery recover(grid, recovery, places);
  recover(std::span<const std::array<double, 3>>(cells), found);
  double worst = 0;
  for (std::size_t k = 0; k < points.size(); ++k) {
    worst = worse(worst, std::abs(found[k][0] - field(points[k])));
    EXPECT_NEAR(found[k][1], -found[k][0], 1e-13);
    EXPECT_NEAR(found[k][2], 1, 1e-13);
  }
  return worst;
}

double linear(const Vector2& x) { return 0.3 + 2 * x[0] - 0.7 * x[1]; }
double smooth(const Vector2& x) { return std::sin(2 * x[0] + 0.4) * std::cosh(1.5 * x[1]); }

}  // namespace

/// Shapes, distortions, and cells ten times as long as wide.
TEST(NodalRecovery, ReproducesLinearFieldsOnAnyMesh) {
  for (const double height : {1.0, 0.1, 10.0})
    for (const double distortion : {0.0, 0.25})
      for (Block block : distorted_blocks(7, 6, distortion)) {
        block.height = height;
        EXPECT_LE(largest_error(block_grid(block), Recovery::nodal, linear), 1e-12 * (1 + height)) << height;
      }
}

/// Few cells: every patch lies at a corner.
TEST(NodalRecovery, ReproducesLinearFieldsOnFourCells) {
  for (const Block& block : distorted_blocks(2, 2, 0.1))
    EXPECT_LE(largest_error(block_grid(block), Recovery::nodal, linear), 1e-13);
}

TEST(NodalRecovery, IsLinearAlongAStripOfOneCell) {
  Block block;
  block.nx = 12;
  block.ny = 1;
  block.height = 0.1;
  block.shape = Shape::quadrilaterals;
  const auto along = [](const Vector2& x) { return 3 - 2 * x[0]; };
  EXPECT_LE(largest_error(block_grid(block), Recovery::nodal, along), 1e-13);
  block.nx = 1;
  EXPECT_LE(largest_error(block_grid(block), Recovery::nodal, [](const Vector2&) { return 2.0; }), 1e-15);
}

/// The error of linear fits to values at the centres is that of the second order terms.
TEST(NodalRecovery, IsOfSecondOrderUpToTheBoundary) {
  for (const double distortion : {0.0, 0.2})
    for (std::size_t k = 0; k < 3; ++k) {
      std::array<double, 3> errors{};
      for (int n = 0; n < 3; ++n)
        errors[n] = largest_error(block_grid(distorted_blocks(10 << n, 8 << n, distortion)[k]),
                                  Recovery::nodal, smooth);
      EXPECT_GE(0.5 * std::log2(errors[0] / errors[2]), 1.85) << errors[0] << ' ' << errors[2];
    }
}

/// A constant in each cell is of first order.
TEST(ElementRecovery, IsTheValueOfTheCell) {
  std::array<double, 2> errors{};
  for (int n = 0; n < 2; ++n)
    errors[n] =
        largest_error(block_grid(distorted_blocks(10 << n, 10 << n, 0)[1]), Recovery::element, linear);
  // Half a cell's diagonal, seen along the gradient: (2 + .7)/20 and /40.
  EXPECT_NEAR(errors[0], 2.7 / 20, 1e-13);
  EXPECT_NEAR(errors[1], 2.7 / 40, 1e-13);
}

/// A strain that jumps at the interface of two regions is not smeared over it.
TEST(NodalRecovery, KeepsTheJumpBetweenRegions) {
  for (Block block : distorted_blocks(8, 6, 0)) {
    block.region = [](double x, double) { return x < 0.5 ? 1 : 2; };
    const PlaneGrid grid = block_grid(block);
    const PointLocation location(grid);
    const auto side = [&](int cell) { return grid.region[cell] == 0 ? 1.0 : -5.0; };
    std::vector<std::array<double, 6>> cells, found(1);
    const auto middles = centres(grid);
    for (int cell = 0; cell < grid.cells(); ++cell) {
      const double value = side(cell) * linear(middles[cell]);
      cells.push_back({value, 0, 1, 2, 3, -value});
    }
    for (const double x : {0.01, 0.4, 0.49, 0.51, 0.6, 0.99})
      for (const double y : {0.0, 0.03, 0.5, 1.0}) {
        const std::array<CellPlace, 1> place{location.find({x, y})};
        StrainRecovery recover(grid, Recovery::nodal, place);
        recover(std::span<const std::array<double, 6>>(cells), found);
        EXPECT_NEAR(found[0][0], (x < 0.5 ? 1.0 : -5.0) * linear({x, y}), 1e-12);
        EXPECT_NEAR(found[0][4], 3, 1e-13);
        EXPECT_NEAR(found[0][5], -found[0][0], 1e-13);
      }
  }
}
