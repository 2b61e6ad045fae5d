#include <gtest/gtest.h>

#include <array>
#include <sstream>

#include "msh_text.hpp"
#include "whole.hpp"

using namespace slipscale;
using namespace slipscale::testing_support;

namespace {

std::string text_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

Mesh read(const std::string& path, int refine = 0, bool cut = false) {
  return read_mesh(PETSC_COMM_WORLD, {path, Partitioner::metis, refine, cut});
}

/// Equal in every bit, cut alike.
void expect_equal(const Mesh& a, const Mesh& b) {
  EXPECT_EQ(a.nodes.number, b.nodes.number);
  EXPECT_EQ(a.nodes.position, b.nodes.position);
  EXPECT_EQ(a.nodes.ghosts, b.nodes.ghosts);
  EXPECT_EQ(a.cells.number, b.cells.number);
  EXPECT_EQ(a.cells.owned, b.cells.owned);
  EXPECT_EQ(a.cells.region, b.cells.region);
  EXPECT_EQ(a.cells.first, b.cells.first);
  EXPECT_EQ(a.cells.corner_nodes, b.cells.corner_nodes);
  EXPECT_EQ(a.cells.corners, b.cells.corners);
  EXPECT_EQ(a.periodic, b.periodic);
  ASSERT_EQ(a.region_names(), b.region_names());
  for (std::size_t r = 0; r < a.regions.size(); ++r) EXPECT_EQ(a.regions[r].area, b.regions[r].area);
  ASSERT_EQ(a.boundary_names(), b.boundary_names());
  for (std::size_t k = 0; k < a.boundaries.size(); ++k) {
    const Boundary &one = a.boundaries[k], &two = b.boundaries[k];
    SCOPED_TRACE(one.name);
    EXPECT_EQ(one.edge_count, two.edge_count);
    EXPECT_EQ(one.length, two.length);
    EXPECT_EQ(one.interior, two.interior);
    EXPECT_EQ(one.normal, two.normal);
    EXPECT_EQ(one.nodes, two.nodes);
    ASSERT_EQ(one.edges.size(), two.edges.size());
    for (std::size_t e = 0; e < one.edges.size(); ++e) {
      EXPECT_EQ(one.edges[e].nodes, two.edges[e].nodes);
      EXPECT_EQ(one.edges[e].ends, two.edges[e].ends);
      EXPECT_EQ(one.edges[e].outward, two.edges[e].outward);
    }
  }
}

/// The unit square in two triangles, its nodes under tags of their own and its lines in two groups.
std::string square(const std::array<int, 4>& tags) {
  const auto [a, b, c, d] = tags;
  std::ostringstream text;
  text << "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n"
          "$PhysicalNames\n4\n1 1 \"bottom\"\n1 2 \"outside\"\n1 3 \"diagonal\"\n2 1 \"matrix\"\n"
          "$EndPhysicalNames\n"
          "$Entities\n0 3 1 0\n1 0 0 0 1 0 0 2 1 2 0\n2 1 0 0 1 1 0 1 2 0\n3 0 0 0 1 1 0 1 3 0\n"
          "1 0 0 0 1 1 0 1 1 0\n$EndEntities\n"
          "$Nodes\n1 4 "
       << a << ' ' << d << "\n2 1 0 4\n"
       << a << '\n'
       << b << '\n'
       << c << '\n'
       << d << "\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n$EndNodes\n"
       << "$Elements\n4 5 1 5\n1 1 1 1\n1 " << a << ' ' << b << "\n1 2 1 1\n2 " << c << ' ' << b
       << "\n1 3 1 1\n3 " << a << ' ' << c << "\n2 1 2 2\n4 " << a << ' ' << b << ' ' << c << "\n5 " << a
       << ' ' << c << ' ' << d << "\n$EndElements\n";
  return text.str();
}

}  // namespace

/// Text and binary say the same, and sections that only others need change nothing.
TEST(Formats, BinaryIsTheSame) {
  for (Shape shape : {Shape::triangles, Shape::quadrilaterals, Shape::mixed})
    for (int periodic : {0, 1, 2})
      for (int refine : {0, 1})
        for (bool cut : {false, true}) {
          Case c{shape, periodic > 0, Partitioner::metis, refine};
          SCOPED_TRACE(testing::Message() << c << ", periodic along " << periodic << ", cut " << cut);
          Block block = block_of(c);
          block.periodic_y = periodic == 2;
          const std::string path = scratch("own.msh");
          write_block(block, path);
          const Mesh mesh = read(path, refine, cut);
          expect_equal(mesh, read(written(binary(text_of(path))), refine, cut));
          const std::string more = "$Parametrizations\n0 0\n$EndParametrizations\n";
          expect_equal(mesh, read(written(text_of(path) + more), refine, cut));
        }
}

/// gmsh numbers nodes as it likes, and ends lines as its system does.
TEST(Formats, TagsAndLineEndsDoNotMatter) {
  const Mesh plain = read(written(square({1, 2, 3, 4})));
  expect_equal(plain, read(written(square({7, 20, 31, 90}))));
  expect_equal(plain, read(written(square({1000001, 1000002, 1000003, 1000004}))));
  expect_equal(plain, read(written(square({1, 2, 3, 2000000000}))));
  expect_equal(plain, read(written(binary(square({1, 2, 3, 2000000000})))));
  std::string text;
  for (const char character : square({1, 2, 3, 4})) {
    if (character == '\n') text += '\r';
    text += character;
  }
  expect_equal(plain, read(written(text)));
}

/// A curve may be in several groups, and lie between cells.
TEST(Formats, CurvesInSeveralGroups) {
  const Mesh mesh = read(written(square({1, 2, 3, 4})));
  EXPECT_EQ(mesh.find_boundary("bottom")->edge_count, 1);
  EXPECT_EQ(mesh.find_boundary("outside")->edge_count, 2);
  EXPECT_EQ(mesh.find_boundary("bottom")->normal, (Vector2{0, -1}));
  EXPECT_FALSE(mesh.find_boundary("outside")->interior);
  EXPECT_TRUE(mesh.find_boundary("diagonal")->interior);
  EXPECT_EQ(mesh.find_boundary("diagonal")->edge_count, 1);
  EXPECT_NEAR(mesh.find_boundary("diagonal")->length, std::sqrt(2.0), 1e-15);
}
