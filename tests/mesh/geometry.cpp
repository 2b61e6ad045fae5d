#include <gtest/gtest.h>

#include <set>

#include "whole.hpp"

using namespace slipscale;
using namespace slipscale::testing_support;

namespace {

constexpr double width = 3, height = 1.5, rounding = 1e-13;

/// Which side of the block a boundary is: the fixed coordinate, its value, and the outward direction.
struct Side {
  const char* name;
  int axis;
  double value, length;
  Vector2 outward;
};
const Side sides[] = {{"bottom", 1, 0, width, {0, -1}},
                      {"top", 1, height, width, {0, 1}},
                      {"left", 0, -1, height, {-1, 0}},
                      {"right", 0, 2, height, {1, 0}}};

}  // namespace

TEST(Geometry, CountsFollowTheRefinement) {
  for (const Case& c : all_cases()) {
    SCOPED_TRACE(testing::Message() << c);
    const Mesh mesh = mesh_of(c);
    const int fine = 1 << c.refine, nx = 6 * fine, ny = 4 * fine;
    EXPECT_EQ(mesh.nodes.total, (c.periodic ? nx : nx + 1) * (ny + 1));
    const int coarse_cells = c.shape == Shape::triangles ? 48 : c.shape == Shape::quadrilaterals ? 24 : 36;
    EXPECT_EQ(mesh.cells.total, coarse_cells * fine * fine);
    EXPECT_EQ(mesh.find_boundary("bottom")->edge_count, nx);
    EXPECT_EQ(mesh.find_boundary("left")->edge_count, ny);
  }
}

TEST(Geometry, AreasAddUp) {
  for (const Case& c : all_cases()) {
    SCOPED_TRACE(testing::Message() << c);
    const Mesh mesh = mesh_of(c);
    EXPECT_NEAR(mesh.area(), width * height, rounding);
    ASSERT_EQ(mesh.region_names(), (std::vector<std::string>{"matrix", "inclusion"}));
    std::array<double, 2> area{};
    double tributary = 0;
    for (int cell = 0; cell < mesh.cells.size(); ++cell) {
      ASSERT_GT(cell_area(mesh.cells, cell), 0);
      if (mesh.cells.owned[cell]) area[mesh.cells.region[cell]] += cell_area(mesh.cells, cell);
      for (int k = mesh.cells.first[cell]; k < mesh.cells.first[cell + 1]; ++k)
        if (mesh.cells.corner_nodes[k] < mesh.nodes.owned)
          tributary += cell_area(mesh.cells, cell) / mesh.cells.corner_count(cell);
    }
    for (int r = 0; r < 2; ++r) EXPECT_NEAR(over_ranks(area[r]), mesh.regions[r].area, rounding);
    EXPECT_NEAR(over_ranks(tributary), width * height, rounding);
  }
}

TEST(Geometry, BoundariesHaveTheirLengthAndFaceOutward) {
  for (const Case& c : all_cases()) {
    SCOPED_TRACE(testing::Message() << c);
    const Mesh mesh = mesh_of(c);
    for (const Side& side : sides) {
      const Boundary& boundary = *mesh.find_boundary(side.name);
      EXPECT_NEAR(boundary.length, side.length, rounding);
      EXPECT_EQ(boundary.interior, c.periodic && side.axis == 0);
      for (int axis = 0; axis < 2; ++axis)
        EXPECT_NEAR(boundary.normal[axis], boundary.interior ? 0 : side.outward[axis], rounding);
      double length = 0;
      for (const BoundaryEdge& edge : boundary.edges) {
        ASSERT_LT(mesh.nodes.number[edge.nodes[0]], mesh.nodes.number[edge.nodes[1]]);
        const double size = std::hypot(edge.ends[1][0] - edge.ends[0][0], edge.ends[1][1] - edge.ends[0][1]);
        EXPECT_NEAR(std::hypot(edge.outward[0], edge.outward[1]), size, rounding);
        if (!boundary.interior) {
          EXPECT_NEAR(edge.outward[side.axis], side.outward[side.axis] * size, rounding);
        }
        for (int node : edge.nodes)
          if (node < mesh.nodes.owned) length += 0.5 * size;
      }
      EXPECT_NEAR(over_ranks(length), side.length, rounding);
    }
  }
}

/// A gmsh curve labels edges only; its nodes, both end points included, must come with them.
TEST(Geometry, EndPointsBelongToTheirCurves) {
  for (const Case& c : all_cases()) {
    SCOPED_TRACE(testing::Message() << c);
    const Mesh mesh = mesh_of(c);
    for (const Side& side : sides) {
      if (c.periodic && side.axis == 0) continue;
      std::vector<int> expected;
      for (int i = 0; i < mesh.nodes.owned; ++i)
        if (std::abs(mesh.nodes.position[i][side.axis] - side.value) < 1e-9) expected.push_back(i);
      EXPECT_EQ(mesh.find_boundary(side.name)->nodes, expected) << side.name;
    }
  }
}

/// On a torus a cell at the seam keeps its shape: no corner lies a period away from the others.
TEST(Geometry, CornersAreUnwrappedAcrossTheSeam) {
  for (const Case& c : all_cases()) {
    SCOPED_TRACE(testing::Message() << c);
    const Mesh mesh = mesh_of(c);
    EXPECT_EQ(mesh.periodic[0], c.periodic);
    EXPECT_FALSE(mesh.periodic[1]);
    EXPECT_NEAR(mesh.lower[0], -1, rounding);
    EXPECT_NEAR(mesh.upper[0], 2, rounding);
    EXPECT_NEAR(mesh.upper[1], height, rounding);
    bool wraps = false;
    for (int cell = 0; cell < mesh.cells.size(); ++cell)
      for (int k = mesh.cells.first[cell]; k < mesh.cells.first[cell + 1]; ++k) {
        const Vector2 &corner = mesh.cells.corners[k],
                      &home = mesh.nodes.position[mesh.cells.corner_nodes[k]];
        EXPECT_LT(std::abs(corner[0] - mesh.cells.corners[mesh.cells.first[cell]][0]), 2 * width / 6);
        EXPECT_NEAR(corner[1], home[1], rounding);
        const double shift = std::abs(corner[0] - home[0]);
        if (c.periodic && shift > 0.5) {
          wraps = true;
          EXPECT_NEAR(shift, width, rounding);
        } else {
          EXPECT_NEAR(shift, 0, rounding);
        }
      }
    EXPECT_EQ(over_ranks(static_cast<int>(wraps), MPI_MAX), c.periodic);
  }
}

/// The seam is inside a torus: every edge on the outside belongs to the bottom or the top.
TEST(Geometry, ATorusHasNoSides) {
  for (Shape shape : {Shape::triangles, Shape::quadrilaterals, Shape::mixed})
    for (int refine : {0, 1}) {
      const Mesh mesh = mesh_of({shape, true, Partitioner::metis, refine});
      EXPECT_EQ(outer_edge_count(mesh),
                mesh.find_boundary("bottom")->edge_count + mesh.find_boundary("top")->edge_count);
    }
}

/// Refinement makes nodes at the middle of each side and of each quadrilateral, and no others; both sides of
/// a seam have the same.
TEST(Geometry, RefinementCutsInTheMiddle) {
  for (Shape shape : {Shape::triangles, Shape::quadrilaterals, Shape::mixed})
    for (bool periodic : {false, true}) {
      const Mesh coarse = whole_mesh_of({shape, periodic, Partitioner::metis, 0}),
                 fine = whole_mesh_of({shape, periodic, Partitioner::metis, 1});
      std::set<Vector2> expected;
      for (int cell = 0; cell < coarse.cells.size(); ++cell) {
        const int first = coarse.cells.first[cell], n = coarse.cells.corner_count(cell);
        Vector2 centre{};
        for (int k = 0; k < n; ++k) {
          const Vector2 &a = coarse.cells.corners[first + k], &b = coarse.cells.corners[first + (k + 1) % n];
          expected.insert(a);
          expected.insert({(a[0] + b[0]) / 2, (a[1] + b[1]) / 2});
          centre = {centre[0] + a[0] / 4, centre[1] + a[1] / 4};
        }
        if (n == 4) expected.insert(centre);
      }
      const std::set<Vector2> found(fine.cells.corners.begin(), fine.cells.corners.end());
      ASSERT_EQ(found.size(), expected.size());
      for (auto one = found.begin(), two = expected.begin(); one != found.end(); ++one, ++two)
        for (int axis = 0; axis < 2; ++axis) EXPECT_NEAR((*one)[axis], (*two)[axis], 1e-15);
    }
}
