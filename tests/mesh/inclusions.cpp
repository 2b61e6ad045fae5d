#include "slipscale/mesh/inclusions.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

#include "grids.hpp"
#include "scenes.hpp"

using namespace slipscale;
using namespace slipscale::testing_support;

namespace {

/// Of 1 m by 1 m in 24 by 24 cells: squares with sides of six and of two.
Block two_squares(Shape shape) {
  Block b;
  b.nx = b.ny = 24;
  b.shape = shape;
  b.region = [](double x, double y) {
    const bool large = std::abs(x - 0.75) < 0.125 && std::abs(y - 0.25) < 0.125,
               small = std::abs(x - 0.25) < 0.05 && std::abs(y - 0.75) < 0.05;
    return large || small ? 2 : 1;
  };
  return b;
}

int region_of(const Mesh& mesh, const std::string& name) {
  const auto names = mesh.region_names();
  return static_cast<int>(std::find(names.begin(), names.end(), name) - names.begin());
}

void expect_near(const Vector2& found, const Vector2& expected) {
  EXPECT_NEAR(found[0], expected[0], 1e-12);
  EXPECT_NEAR(found[1], expected[1], 1e-12);
}

}  // namespace

TEST(Inclusions, OfTwoSquares) {
  for (const Shape shape : {Shape::triangles, Shape::quadrilaterals, Shape::mixed}) {
    const Mesh mesh = block_mesh(two_squares(shape));
    const Inclusions found = find_inclusions(mesh, region_of(mesh, "inclusion")).inclusions;
    ASSERT_EQ(found.size(), 2);
    expect_near(found.centre[0], {0.75, 0.25});  // from the bottom upwards
    EXPECT_NEAR(found.area[0], 1.0 / 16, 1e-12);
    EXPECT_EQ(found.outer, (std::vector<char>{0, 0}));
    int corners = 0;
    double around = 0;
    for (const InterfaceNode& node : found.interface) {
      EXPECT_FALSE(node.outer);
      if (node.inclusion == 0) around += node.length;
      corners += std::abs(std::abs(node.normal[0]) - std::numbers::sqrt2 / 2) < 1e-9;
      const Vector2& centre = found.centre[node.inclusion];
      EXPECT_GT(
          node.normal[0] * (node.position[0] - centre[0]) + node.normal[1] * (node.position[1] - centre[1]),
          0);
      EXPECT_NEAR(
          std::remainder(node.angle - std::atan2(node.position[1] - centre[1], node.position[0] - centre[0]),
                         2 * std::numbers::pi),
          0, 1e-12);
    }
    EXPECT_EQ(corners, 8);
    // A corner belongs to its node with |∫ N n ds|, 1/√2 of its two halves.
    EXPECT_NEAR(around, 1 - 4 * (1 - std::numbers::sqrt2 / 2) / 24, 1e-12);
    EXPECT_TRUE(std::ranges::is_sorted(
        found.interface, {}, [](const auto& node) { return std::pair(node.inclusion, node.angle); }));
  }
}

/// One square on the seam, one that meets the bottom, two that touch in a corner alone.
TEST(Inclusions, AcrossASeamAtTheOutsideAndCornerToCorner) {
  Block b;
  b.nx = b.ny = 16;
  b.periodic_x = true;
  b.region = [](double x, double y) {
    const auto in = [&](double left, double bottom) {
      return x > left && x < left + 0.25 && y > bottom && y < bottom + 0.25;
    };
    const bool seam = (x < 0.125 || x > 0.875) && y > 0.625 && y < 0.875;
    return seam || in(0.375, 0) || in(0.25, 0.375) || in(0.5, 0.625) ? 2 : 1;
  };
  const Mesh mesh = block_mesh(b);
  const Inclusions found = find_inclusions(mesh, region_of(mesh, "inclusion")).inclusions;
  ASSERT_EQ(found.size(), 4);
  expect_near(found.centre[0], {0.5, 0.125});
  expect_near(found.centre[1], {0.375, 0.5});
  EXPECT_EQ(found.outer, (std::vector<char>{1, 0, 0, 0}));
  for (int k = 2; k < 4; ++k) EXPECT_NEAR(found.area[k], 1.0 / 16, 1e-12);
  const Vector2 seam =
      found.centre[2][0] > 0.6 || found.centre[2][0] < 0.4 ? found.centre[2] : found.centre[3];
  EXPECT_NEAR(std::abs(std::remainder(seam[0], 1.0)), 0, 1e-12);
  for (const InterfaceNode& node : found.interface) {
    const Vector2& centre = found.centre[node.inclusion];
    EXPECT_LE(std::hypot(node.position[0] - centre[0], node.position[1] - centre[1]), 0.18)
        << "torn at the seam";
  }
  int outer = 0;
  for (const InterfaceNode& node : found.interface) outer += node.outer;
  EXPECT_EQ(outer, 2);
}

/// What every rank finds is what one rank finds.
TEST(Inclusions, AreTheSameOnAnyNumberOfRanks) {
  Block b = two_squares(Shape::mixed);
  b.distortion = 0.2;
  const std::string path = scratch("block.msh");
  write_block(b, path);
  const Mesh cut = read_mesh(PETSC_COMM_WORLD, {path, Partitioner::metis, 0}),
             whole = read_mesh(PETSC_COMM_SELF, {path, Partitioner::metis, 0});
  const int region = region_of(cut, "inclusion");
  const Inclusions one = find_inclusions(cut, region).inclusions,
                   other = find_inclusions(whole, region).inclusions;
  EXPECT_EQ(one.of_cell, other.of_cell);
  EXPECT_EQ(one.centre, other.centre);
  EXPECT_EQ(one.area, other.area);
  ASSERT_EQ(one.interface.size(), other.interface.size());
  for (std::size_t k = 0; k < one.interface.size(); ++k) {
    EXPECT_EQ(one.interface[k].node, other.interface[k].node);
    EXPECT_EQ(one.interface[k].normal, other.interface[k].normal);
    EXPECT_EQ(one.interface[k].length, other.interface[k].length);
  }
}

TEST(Inclusions, OfAPlainGridJoinPointsOfEqualNumber) {
  const PlaneGrid grid = block_grid(two_squares(Shape::triangles));
  std::vector<int> same(grid.points.size());
  std::iota(same.begin(), same.end(), 0);
  const Inclusions found = find_inclusions(grid, 1, same).inclusions;
  ASSERT_EQ(found.size(), 2);
  expect_near(found.centre[1], {0.25, 0.75});
  EXPECT_EQ(found.interface.size(), 24u + 8u);
}

/// A disc whose diameter is .8 of the period along both axes, wherever the seams cut it: its lowest cell may
/// be further than half a period from others.
TEST(Inclusions, WiderThanHalfAPeriodAreNotTorn) {
  for (const Vector2& middle : {Vector2{0.5, 0.5}, {0.1, 0.5}, {0.9, 0.9}, {0, 0.3}}) {
    Block b;
    b.nx = b.ny = 24;
    b.periodic_x = b.periodic_y = true;
    b.region = [&](double x, double y) {
      return std::hypot(std::remainder(x - middle[0], 1.0), std::remainder(y - middle[1], 1.0)) < 0.4 ? 2 : 1;
    };
    const Mesh mesh = block_mesh(b);
    const Inclusions found = find_inclusions(mesh, region_of(mesh, "inclusion")).inclusions;
    ASSERT_EQ(found.size(), 1);
    for (int axis = 0; axis < 2; ++axis)
      EXPECT_NEAR(std::remainder(found.centre[0][axis] - middle[axis], 1.0), 0, 1.0 / 24);
    for (const InterfaceNode& node : found.interface)
      EXPECT_NEAR(std::hypot(node.position[0] - found.centre[0][0], node.position[1] - found.centre[0][1]),
                  0.4, 1.5 / 24)
          << "torn at " << middle[0] << ", " << middle[1];
  }
}

/// A bracket whose two ends meet in one node alone: its edges cancel there, and so does its length.
TEST(Inclusions, ThatTouchThemselvesInANodeHaveNoLengthThere) {
  Block b;
  b.nx = b.ny = 12;
  b.shape = Shape::quadrilaterals;
  b.width = b.height = 0.7;
  b.region = [](double x, double y) {
    const int i = static_cast<int>(x / 0.7 * 12), j = static_cast<int>(y / 0.7 * 12);
    const bool ends = (i == 5 && j == 5) || (i == 6 && j == 6);
    const bool round = (i == 5 && j == 4) || (j == 4 && i >= 5 && i <= 8) || (i == 8 && j >= 4 && j <= 6) ||
                       (j == 6 && i >= 6 && i <= 8);
    return ends || round ? 2 : 1;
  };
  const Mesh mesh = block_mesh(b);
  const Inclusions found = find_inclusions(mesh, region_of(mesh, "inclusion")).inclusions;
  ASSERT_EQ(found.size(), 1);
  int pinched = 0;
  for (const InterfaceNode& node : found.interface) {
    if (node.length > 0.01) continue;
    ++pinched;
    EXPECT_EQ(node.length, 0);
    EXPECT_EQ(tractions(node, {1, 2}), (std::array<double, 2>{0, 0}));
    EXPECT_NEAR(node.position[0], 0.35, 1e-12);
  }
  EXPECT_EQ(pinched, 1);
}
