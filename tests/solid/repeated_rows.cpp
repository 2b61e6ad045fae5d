#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "bodies.hpp"
#include "slipscale/base/parallel.hpp"
#include "slipscale/solid/pair_stiffness.hpp"

using namespace slipscale;
using namespace slipscale::testing_support;

namespace {

struct GridBody {
  const char* what;
  Block block;
  int refine = 0;
};

/// 44 by 33 cells, unlike along x and y and of a size that no double has exactly, so that every coordinate is
/// rounded; several chunks of rows.
Block grid(Shape shape) {
  Block block;
  block.nx = 44;
  block.ny = 33;
  block.width = 3.1e-3;
  block.height = 1.7e-3;
  block.left = -0.7e-3;
  block.shape = shape;
  return block;
}

int in_disc(double x, double y) { return std::hypot(x - 0.85e-3, y - 0.8e-3) < 0.5e-3 ? 2 : 1; }

/// Below half the height one material, above it every cell one of two: nothing repeats there.
int in_disorder(double x, double y) { return y > 0.85e-3 && std::sin(1e7 * x + 3e6 * y) > 0 ? 2 : 1; }

std::vector<GridBody> grid_bodies() {
  std::vector<GridBody> bodies;
  for (const Shape shape : {Shape::triangles, Shape::quadrilaterals}) {
    bodies.push_back({"one material", grid(shape)});
    bodies.push_back({"a disc", grid(shape)});
    bodies.back().block.region = in_disc;
    bodies.push_back({"half of it disorder", grid(shape)});
    bodies.back().block.region = in_disorder;
    bodies.push_back({"periodic", grid(shape)});
    bodies.back().block.periodic_x = true;
    bodies.back().block.region = in_disc;
    bodies.push_back({"torus", grid(shape)});
    bodies.back().block.periodic_x = bodies.back().block.periodic_y = true;
    bodies.push_back({"refined", grid(shape), 1});
    bodies.back().block.nx = 20, bodies.back().block.ny = 24;
  }
  bodies.push_back({"triangles and squares by turns", grid(Shape::mixed)});
  bodies.push_back({"distorted", grid(Shape::quadrilaterals)});
  bodies.back().block.distortion = 0.2;
  return bodies;
}

std::vector<Instructions> all_instructions() {
  std::vector<Instructions> all;
  for (const Instructions each : {Instructions::base, Instructions::avx2, Instructions::avx512})
    if (each <= widest_instructions()) all.push_back(each);
  return all;
}

template <class Scalar>
std::vector<Vector2> product(const Mesh& mesh, const StiffnessKernel& kernel) {
  std::vector<Vector2> u = rough_field(mesh.nodes), force(u.size(), {std::nan(""), std::nan("")});
  PairStiffness<Scalar>(mesh, two_materials(), kernel).multiply(u.data(), force.data());
  force.resize(static_cast<std::size_t>(mesh.nodes.owned));
  return force;
}

/// Part of the whole mesh's nodes whose forces are gathered, and that repeat.
std::array<double, 2> parts(const Mesh& mesh) {
  const PairStiffness<double> stiffness(mesh, two_materials());
  double part[2] = {static_cast<double>(stiffness.gathered()), static_cast<double>(stiffness.repeating())};
  MPI_Allreduce(MPI_IN_PLACE, part, 2, MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD);
  const auto total = static_cast<double>(mesh.nodes.total);
  return {part[0] / total, part[1] / total};
}

}  // namespace

/// Whatever the kernel, the instructions and the partition: the bits of the visit of all pairs on one rank.
TEST(RepeatedRows, GiveTheBitsOfTheVisitOfAllPairs) {
  for (const GridBody& body : grid_bodies()) {
    const std::string path = scratch("grid.msh");
    write_block(body.block, path);
    const Mesh whole = read_mesh(PETSC_COMM_SELF, {path, Partitioner::metis, body.refine});
    const auto alone = product<double>(whole, {false}), alone_single = product<float>(whole, {false});
    for (const Partitioner partitioner : {Partitioner::metis, Partitioner::simple}) {
      const Mesh mesh = read_mesh(PETSC_COMM_WORLD, {path, partitioner, body.refine});
      for (const Instructions instructions : all_instructions())
        for (const bool runs : {true, false}) {
          SCOPED_TRACE(testing::Message() << body.what << ", shape " << static_cast<int>(body.block.shape)
                                          << ", " << name_of(instructions) << (runs ? ", runs" : ", pairs"));
          const auto force = product<double>(mesh, {runs, instructions}),
                     single = product<float>(mesh, {runs, instructions});
          for (int i = 0; i < mesh.nodes.owned; ++i) {
            ASSERT_EQ(force[i], alone[mesh.nodes.number[i]]) << i;
            ASSERT_EQ(single[i], alone_single[mesh.nodes.number[i]]) << i;
          }
        }
    }
  }
}

/// Of a grid all but the ends of its lines repeats, however its coordinates are rounded; what does not repeat
/// is left to the visit of the pairs.
TEST(RepeatedRows, AreFoundWhereAGridIs) {
  const int ranks = ranks_of(PETSC_COMM_WORLD);
  for (const Shape shape : {Shape::triangles, Shape::quadrilaterals}) {
    Block block = grid(shape);
    const auto [gathered, repeating] = parts(block_mesh(block));
    EXPECT_EQ(gathered, 1);
    EXPECT_GT(repeating, ranks == 1 ? 0.95 : 0.8);  // the more ranks, the more ends
    const auto [refined_gathered, refined_repeating] = parts(block_mesh(block, Partitioner::metis, 1));
    EXPECT_EQ(refined_gathered, 1);
    EXPECT_GT(refined_repeating, 0.9);
    block.region = in_disc;
    const auto [disc_gathered, disc_repeating] = parts(block_mesh(block));
    EXPECT_EQ(disc_gathered, 1);
    EXPECT_GT(disc_repeating, ranks == 1 ? 0.75 : 0.6);
    block.region = in_disorder;
    if (ranks == 1) {
      const auto [half_gathered, half_repeating] = parts(block_mesh(block));
      EXPECT_NEAR(half_gathered, 0.5, 0.2);
      EXPECT_NEAR(half_repeating, 0.5, 0.2);
    }
    block.distortion = 0.2;
    const auto [distorted_gathered, distorted_repeating] = parts(block_mesh(block));
    EXPECT_EQ(distorted_gathered, 0);
    EXPECT_EQ(distorted_repeating, 0);
  }
}

/// Each owned node is handed over once, in ascending order, with its force complete and its neighbours
/// served: moving it at once must change nothing.
TEST(RepeatedRows, HandOverEachOwnedNodeOnceAndDone) {
  for (const GridBody& body : grid_bodies()) {
    SCOPED_TRACE(body.what);
    const Mesh mesh = block_mesh(body.block, Partitioner::metis, body.refine);
    auto u = rough_field(mesh.nodes);
    const auto expected = product<double>(mesh, {});
    std::vector<Vector2> force(u.size());
    int next = 0;
    PairStiffness<double>(mesh, two_materials()).multiply(u.data(), force.data(), [&](int begin, int end) {
      EXPECT_EQ(begin, next);
      for (next = begin; next < end; ++next) {
        EXPECT_EQ(force[next], expected[next]);
        u[next] = {1e9, -1e9};
      }
    });
    EXPECT_EQ(next, mesh.nodes.owned);
    for (int i = 0; i < mesh.nodes.owned; ++i) EXPECT_EQ(force[i], expected[i]);
  }
}

/// A rigid translation by any two doubles costs nothing, not even rounding.
TEST(RepeatedRows, LetTranslationsCostNothing) {
  for (const GridBody& body : grid_bodies()) {
    const Mesh mesh = block_mesh(body.block, Partitioner::metis, body.refine);
    std::vector<Vector2> u(mesh.nodes.number.size(), {1.0 / 3, -2e-7 / 7}), force(u.size());
    PairStiffness<double>(mesh, two_materials()).multiply(u.data(), force.data());
    for (int i = 0; i < mesh.nodes.owned; ++i) EXPECT_EQ(force[i], (Vector2{0, 0}));
  }
}

/// The shapes of the cells of a grid are the same to the last bit, and what they are to the rounding of the
/// coordinates.
TEST(EdgeRounding, MakesEqualCellsEqual) {
  for (const double left : {-0.7e-3, 0.0, 1.3}) {
    Block block = grid(Shape::quadrilaterals);
    block.left = left;
    const Mesh mesh = block_mesh(block);
    const double noise = 64 * std::ldexp(std::max(std::abs(left), block.width), -52);
    const auto first = mesh.shape_of(0);
    EXPECT_NEAR(std::abs(first[2][0]), block.width / block.nx, noise);
    EXPECT_NEAR(std::abs(first[2][1]), block.height / block.ny, noise);
    for (int cell = 0; cell < mesh.cells.size(); ++cell) EXPECT_EQ(mesh.shape_of(cell), first) << cell;
  }
}

std::set<std::array<Vector2, 4>> shapes_in(const Mesh& mesh) {
  std::set<std::array<Vector2, 4>> shapes;
  for (int cell = 0; cell < mesh.cells.size(); ++cell) shapes.insert(mesh.shape_of(cell));
  return shapes;
}

/// Nodes that a mesh generator found to a few digits less than a number has are those of a grid all the same;
/// a mesh whose cells differ keeps all its digits.
TEST(EdgeRounding, SeesTheGridBehindTheNoiseOfItsNodes) {
  for (const Shape shape : {Shape::quadrilaterals, Shape::triangles}) {
    Block block = grid(shape);
    const std::size_t kinds = shapes_in(block_mesh(block)).size();
    block.distortion = 4e-10;
    const Mesh noisy = block_mesh(block);
    EXPECT_LT(noisy.edge_rounding.quantum, 1e-7 * noisy.shortest_edge);
    EXPECT_EQ(shapes_in(noisy).size(), kinds);
    block.distortion = 0.1;
    const Mesh distorted = block_mesh(block);
    EXPECT_LT(distorted.edge_rounding.quantum, 1e-9 * distorted.shortest_edge);
  }
}

/// Where every force is gathered, the same forces come by in passing.
TEST(RepeatedRows, HandOverForcesInPassing) {
  for (const GridBody& body : grid_bodies()) {
    SCOPED_TRACE(body.what);
    const Mesh mesh = block_mesh(body.block, Partitioner::metis, body.refine);
    auto u = rough_field(mesh.nodes);
    const auto expected = product<double>(mesh, {});
    const PairStiffness<double> stiffness(mesh, two_materials());
    ASSERT_EQ(stiffness.passing_size() > 0, stiffness.gathered() == mesh.nodes.owned);
    if (stiffness.passing_size() == 0) continue;
    LargeArray<Vector2> passing(stiffness.passing_size());
    for (int go = 0; go < 2; ++go) {  // what a sweep leaves behind disturbs no other
      int next = 0;
      stiffness.multiply_passing(u.data(), passing, [&](int begin, int end, const Vector2* force) {
        EXPECT_EQ(begin, next);
        for (int i = begin; i < end; ++i) ASSERT_EQ(force[i], expected[i]) << i;
        next = end;
      });
      EXPECT_EQ(next, mesh.nodes.owned);
    }
  }
}
