#include "slipscale/solid/pair_stiffness.hpp"

#include <gtest/gtest.h>

#include <bit>

#include "assembled.hpp"
#include "bodies.hpp"
#include "report.hpp"
#include "slipscale/dynamics/model.hpp"

using namespace slipscale;
using namespace slipscale::testing_support;

namespace {

template <class Scalar>
std::vector<Vector2> product(const Mesh& mesh, std::vector<Vector2> u) {
  std::vector<Vector2> force(u.size(), {std::nan(""), std::nan("")});  // whatever was there must not matter
  PairStiffness<Scalar>(mesh, two_materials()).multiply(u.data(), force.data());
  return force;
}

/// Order-independent digest of (number, bits) over the owned nodes.
std::uint64_t digest(const Nodes& nodes, const std::vector<Vector2>& field) {
  const auto mix = [](std::uint64_t x) {  // splitmix64
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
    return x ^ (x >> 31);
  };
  std::uint64_t sum = 0;
  for (int i = 0; i < nodes.owned; ++i) {
    std::uint64_t h = mix(static_cast<std::uint64_t>(nodes.number[i]) + 1);
    for (double x : field[i]) h = mix(h ^ std::bit_cast<std::uint64_t>(x));
    sum += h;
  }
  return sum;
}

double dot(const Nodes& nodes, const std::vector<Vector2>& a, const std::vector<Vector2>& b) {
  double sum = 0;
  for (int i = 0; i < nodes.owned; ++i) sum += a[i][0] * b[i][0] + a[i][1] * b[i][1];
  MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD);
  return sum;
}

}  // namespace

/// Against PETSc's own assembly. Both add at most 8 cells' parts and then at most 9 products; 64 roundings of
/// the row's sizes |K| |u| are a generous bound.
TEST(PairStiffness, EqualsTheAssembledMatrix) {
  for (const Body& body : all_bodies()) {
    SCOPED_TRACE(testing::Message() << body);
    const Mesh mesh = block_mesh(block_of(body));
    const OwnedMat matrix = assembled_stiffness(PETSC_COMM_WORLD, mesh, two_materials(), MATAIJ);
    NodalVector u(PETSC_COMM_WORLD, mesh.nodes, true), expected(PETSC_COMM_WORLD, mesh.nodes, true),
        sizes(PETSC_COMM_WORLD, mesh.nodes, true);
    for (int i = 0; i < mesh.nodes.size(); ++i) u.data()[i] = rough(mesh.nodes.number[i]);
    petsc(MatMult(matrix, u.vec(), expected.vec()));
    petsc(MatGetRowMaxAbs(matrix, sizes.vec(), nullptr));
    const auto force = product<double>(mesh, rough_field(mesh.nodes));
    for (int i = 0; i < mesh.nodes.owned; ++i)
      for (int axis = 0; axis < 2; ++axis) {
        const double bound = 64 * 2.3e-16 * sizes.data()[i][axis] * 1e-6 * 18;
        EXPECT_NEAR(force[i][axis], expected.data()[i][axis], bound);
        EXPECT_GT(sizes.data()[i][axis], 0);
      }
  }
}

/// A rigid translation by any two doubles costs nothing, not even rounding.
TEST(PairStiffness, TranslationsGiveExactlyZero) {
  for (const Body& body : all_bodies()) {
    SCOPED_TRACE(testing::Message() << body);
    const Mesh mesh = block_mesh(block_of(body));
    for (const Vector2 shift : {Vector2{1.0 / 3, -2e-7 / 7}, Vector2{1e5, 1e-300}}) {
      const std::vector<Vector2> u(mesh.nodes.number.size(), shift);
      for (const auto& force : {product<double>(mesh, u), product<float>(mesh, u)})
        for (int i = 0; i < mesh.nodes.owned; ++i) {
          EXPECT_EQ(force[i][0], 0.0);
          EXPECT_EQ(force[i][1], 0.0);
        }
    }
  }
}

/// In single storage as well: the parts that cancel around a node are not rounded each for itself.
template <class Scalar>
void expect_symmetric() {
  for (const Body& body : all_bodies()) {
    SCOPED_TRACE(testing::Message() << body);
    const Mesh mesh = block_mesh(block_of(body));
    const auto u = rough_field(mesh.nodes);
    std::vector<Vector2> v;
    for (PetscInt number : mesh.nodes.number) v.push_back(rough(3 * number + 1000));
    const double uku = dot(mesh.nodes, u, product<Scalar>(mesh, u)),
                 vkv = dot(mesh.nodes, v, product<Scalar>(mesh, v));
    const double ukv = dot(mesh.nodes, u, product<Scalar>(mesh, v)),
                 vku = dot(mesh.nodes, v, product<Scalar>(mesh, u));
    EXPECT_GT(uku, 0);
    EXPECT_NEAR(ukv, vku, 1e-13 * std::sqrt(uku * vkv));
  }
}

TEST(PairStiffness, IsSymmetric) {
  expect_symmetric<double>();
  expect_symmetric<float>();
}

/// However the mesh is cut, and on one rank alone: the same bits at every node.
TEST(PairStiffness, GivesTheSameBitsHoweverTheMeshIsCut) {
  for (const Body& body : all_bodies()) {
    SCOPED_TRACE(testing::Message() << body);
    const std::string path = scratch("bits.msh");
    write_block(block_of(body), path);
    const Mesh whole = read_mesh(PETSC_COMM_SELF, {path});
    const auto alone = product<double>(whole, rough_field(whole.nodes));
    const auto expected = digest(whole.nodes, alone);
    const auto expected_single = digest(whole.nodes, product<float>(whole, rough_field(whole.nodes)));
    EXPECT_NE(expected, expected_single);
    for (Partitioner partitioner : {Partitioner::metis, Partitioner::simple, Partitioner::ptscotch}) {
      const Mesh mesh = read_mesh(PETSC_COMM_WORLD, {path, partitioner});
      const auto force = product<double>(mesh, rough_field(mesh.nodes));
      std::uint64_t sums[2] = {digest(mesh.nodes, force),
                               digest(mesh.nodes, product<float>(mesh, rough_field(mesh.nodes)))};
      MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPI_UINT64_T, MPI_SUM, PETSC_COMM_WORLD);
      EXPECT_EQ(sums[0], expected);
      EXPECT_EQ(sums[1], expected_single);
      for (int i = 0; i < mesh.nodes.owned; ++i) EXPECT_EQ(force[i], alone[mesh.nodes.number[i]]);
    }
  }
}

/// Blocks rounded to single precision: relative 2⁻²⁴ each, so the force is that close in the size of its
/// terms.
TEST(PairStiffness, SingleStorageIsClose) {
  for (const Body& body : all_bodies()) {
    SCOPED_TRACE(testing::Message() << body);
    const Mesh mesh = block_mesh(block_of(body));
    const auto u = rough_field(mesh.nodes);
    const auto full = product<double>(mesh, u), single = product<float>(mesh, u);
    double largest = 0, difference = 0;
    for (int i = 0; i < mesh.nodes.owned; ++i)
      for (int axis = 0; axis < 2; ++axis) {
        largest = std::max(largest, std::abs(full[i][axis]));
        difference = worse(difference, std::abs(full[i][axis] - single[i][axis]));
      }
    EXPECT_GT(difference, 0);
    EXPECT_LT(difference, 1e-7 * largest);
  }
}

/// Each owned node is handed over once, in ascending order, with its force complete and its neighbours
/// served: moving it at once must change nothing.
TEST(PairStiffness, HandsOverEachOwnedNodeOnceAndDone) {
  for (const Body& body : all_bodies()) {
    SCOPED_TRACE(testing::Message() << body);
    const Mesh mesh = block_mesh(block_of(body));
    auto u = rough_field(mesh.nodes);
    const auto expected = product<double>(mesh, u);
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
