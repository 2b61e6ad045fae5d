#include <gtest/gtest.h>

#include <bit>
#include <cstdint>
#include <map>

#include "scenes.hpp"

using namespace slipscale;
using namespace slipscale::testing_support;

namespace {

/// Two materials that land at an angle on the moving surface, with both dampings and a dissipative scheme: in
/// a few thousand steps every contact node has stuck, slipped and been open.
Block block(Shape shape, bool periodic) {
  Block b;
  b.nx = 14;
  b.ny = 9;
  b.width = 7e-3;
  b.height = 4.5e-3;
  b.shape = shape;
  b.distortion = 0.1;
  b.periodic_x = periodic;
  b.region = [](double x, double y) { return (x > 2e-3 && x < 4e-3 && y > 1e-3 && y < 3e-3) ? 2 : 1; };
  return b;
}

Scene scene(bool periodic) {
  Scene s = scene_r();
  s.conditions = {{"top", {}, 15e6, -1e6, 2e-6}};
  if (!periodic) s.conditions.push_back({"right", {0.0, std::nullopt}, 0, 3e5, 0});
  s.initial.velocity = {0.1, -0.5};
  s.initial.gap = 1e-7;
  s.initial.amplitude = 2;
  s.initial.wavelength = 7e-3;
  s.damping = {1e3, 2e-9};
  s.beta2 = 0.55;
  s.body_acceleration = {10, -1e4};
  return s;
}

std::vector<Material> materials() { return {scene_r_material(), isotropic(80e9, 0.2, 2500)}; }

/// The bits of everything at the end of the run, by whole-mesh node number.
using Bits = std::map<std::pair<PetscInt, int>, std::array<std::uint64_t, 2>>;

Bits bits(const Simulation& simulation) {
  Bits all;
  const auto put = [&](int i, int what, const Vector2& value) {
    all[{simulation.mesh.nodes.number[i], what}] = {std::bit_cast<std::uint64_t>(value[0]),
                                                    std::bit_cast<std::uint64_t>(value[1])};
  };
  const SlidingBody& body = simulation.body;
  for (int i = 0; i < simulation.mesh.nodes.owned; ++i) {
    put(i, 0, body.next_displacement()[i]);
    put(i, 1, body.velocity_n()[i]);
    put(i, 2, body.acceleration_n()[i]);
    put(i, 3, body.internal_force_n()[i]);
  }
  const ContactNodes& contact = body.contact();
  for (int k = 0; k < contact.size(); ++k) {
    put(contact.node[k], 4, contact.force[k]);
    put(contact.node[k], 5, {contact.memory[k].traction, contact.memory[k].pressure});
  }
  const BoundaryNodes& boundary = body.boundary_nodes();
  for (int k = 0; k < boundary.size(); ++k) {
    put(boundary.node[k], 6, body.force_on_support(k));
    put(boundary.node[k], 7, boundary.support[k]);
  }
  return all;
}

StatusCount run(Simulation& simulation) {
  StatusCount count;
  for (int n = 0; n < 2000; ++n) {
    simulation.body.advance(n == 1999);
    count.add(simulation.body.contact());
  }
  return count;
}

void compare(Shape shape, bool periodic) {
  const std::string path = scratch("bits.msh");
  write_block(block(shape, periodic), path);
  constexpr double step = 1.5e-8;
  Simulation alone(PETSC_COMM_SELF, {path}, materials(), scene(periodic), step);
  const StatusCount count = run(alone);
  EXPECT_TRUE(count.all_seen()) << "open " << count.open << ", stick " << count.stick << ", slip "
                                << count.slip;
  const Bits expected = bits(alone);

  for (const Partitioner partitioner : {Partitioner::metis, Partitioner::simple}) {
    Simulation together(PETSC_COMM_WORLD, {path, partitioner}, materials(), scene(periodic), step);
    const StatusCount seen = run(together).over_ranks(PETSC_COMM_WORLD);
    EXPECT_EQ(seen.stick, count.stick);
    EXPECT_EQ(seen.open, count.open);
    long entries = 0, different = 0;
    for (const auto& [key, value] : bits(together)) {
      ++entries;
      different += value != expected.at(key);
    }
    EXPECT_EQ(different, 0) << "of " << entries << " values of this rank";
    MPI_Allreduce(MPI_IN_PLACE, &entries, 1, MPI_LONG, MPI_SUM, PETSC_COMM_WORLD);
    EXPECT_EQ(entries, static_cast<long>(expected.size()));
  }
}

}  // namespace

/// The same bits on any number of ranks, whoever owns a node.
TEST(BitIdentity, Triangles) { compare(Shape::triangles, false); }
TEST(BitIdentity, Quadrilaterals) { compare(Shape::quadrilaterals, false); }
TEST(BitIdentity, MixedCells) { compare(Shape::mixed, false); }
TEST(BitIdentity, PeriodicTriangles) { compare(Shape::triangles, true); }
TEST(BitIdentity, PeriodicQuadrilaterals) { compare(Shape::quadrilaterals, true); }
TEST(BitIdentity, PeriodicMixedCells) { compare(Shape::mixed, true); }
