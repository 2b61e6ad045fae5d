#include <gtest/gtest.h>

#include <cmath>

#include "scenes.hpp"

using namespace slipscale;
using namespace slipscale::testing_support;

namespace {

Block plate() {
  Block block;
  block.nx = 6;
  block.ny = 5;
  block.width = 2;
  block.height = 1.5;
  block.shape = Shape::mixed;
  block.distortion = 0.2;
  return block;
}

Vector2 total_load(const SlidingBody& body) {
  Vector2 sum{};
  for (const Vector2& load : body.boundary_nodes().load) sum = {sum[0] + load[0], sum[1] + load[1]};
  MPI_Allreduce(MPI_IN_PLACE, sum.data(), 2, MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD);
  return sum;
}

Vector2 contact_force(const SlidingBody& body) {
  Vector2 sum{};
  for (const Vector2& force : body.contact().force) sum = {sum[0] + force[0], sum[1] + force[1]};
  MPI_Allreduce(MPI_IN_PLACE, sum.data(), 2, MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD);
  return sum;
}

}  // namespace

/// Pressure > 0 compresses, shear > 0 acts along +x on the body, on whichever side of the block.
TEST(Loads, AddUpToTractionTimesLength) {
  const Mesh mesh = block_mesh(plate());
  const Model model(mesh, {isotropic(1, 0.3, 1)}, Model::Storage::full);
  constexpr double pressure = 3, shear = 0.7;
  struct Side {
    std::string name;
    Vector2 expected;
  };
  for (const Side& side :
       {Side{"top", {shear * 2, -pressure * 2}}, Side{"bottom", {shear * 2, pressure * 2}},
        Side{"left", {(pressure + shear) * 1.5, 0}}, Side{"right", {(shear - pressure) * 1.5, 0}}}) {
    Scene scene;
    scene.conditions = {{side.name, {}, pressure, shear, 0}};
    SlidingBody body(PETSC_COMM_WORLD, model, scene, 1e-3);
    body.advance(true);
    const Vector2 found = total_load(body);
    EXPECT_NEAR(found[0], side.expected[0], 1e-13) << side.name;
    EXPECT_NEAR(found[1], side.expected[1], 1e-13) << side.name;
  }
}

TEST(Loads, OfTwoSidesAddAtTheirCornerAndFollowTheirOwnRamps) {
  const Mesh mesh = block_mesh(plate());
  const Model model(mesh, {isotropic(1, 0.3, 1)}, Model::Storage::full);
  Scene scene;
  scene.conditions = {{"top", {}, 3, 0, 0}, {"right", {}, 2, 0, 0.02}};
  SlidingBody body(PETSC_COMM_WORLD, model, scene, 5e-3);
  for (const double level : {0.0, 0.5 * (1 - std::sqrt(0.5)), 0.5, 0.5 * (1 + std::sqrt(0.5)), 1.0, 1.0}) {
    body.advance(true);
    const Vector2 found = total_load(body);
    EXPECT_NEAR(found[0], -2 * 1.5 * level, 1e-13);
    EXPECT_NEAR(found[1], -3 * 2, 1e-13);
  }
}

/// At rest the forces on the supports are the loads: force of the body on its support, without nodal inertia.
TEST(Loads, AtRestAreBalancedByTheSupport) {
  const Mesh mesh = block_mesh(plate());
  const Model model(mesh, {isotropic(1, 0.3, 1)}, Model::Storage::full);
  Scene scene;
  scene.conditions = {{"bottom", {0.0, 0.0}, 0, 0, 0}, {"top", {}, 3e-3, 1e-3, 0}};
  scene.damping = {1, 0};
  SlidingBody body(PETSC_COMM_WORLD, model, scene,
                   0.5 * stable_step(largest_frequency(PETSC_COMM_WORLD, model).sharp, 0.5, scene.damping));
  while (body.time() < 150) body.advance(false);
  const Vector2 found = support_force(body, "bottom");
  EXPECT_NEAR(found[0], 1e-3 * 2, 1e-11);
  EXPECT_NEAR(found[1], -3e-3 * 2, 1e-11);
}

/// The same with the surface in place of the support: it carries the load and the weight, its friction the
/// shear.
TEST(Loads, AtRestAreBalancedByTheSurface) {
  const Mesh mesh = block_mesh(plate());
  const Model model(mesh, {isotropic(1, 0.3, 1)}, Model::Storage::full);
  Scene scene;
  scene.conditions = {{"top", {}, 3e-3, 5e-4, 1}};
  scene.body_acceleration = {0, -1e-3};
  scene.damping = {1, 0};
  scene.surface = Surface{"bottom", 0, 0, 0};
  scene.friction.law = FrictionChoice::Law::coulomb;
  scene.friction.coefficient = 1;
  SlidingBody body(PETSC_COMM_WORLD, model, scene,
                   0.5 * stable_step(largest_frequency(PETSC_COMM_WORLD, model).sharp, 0.5, scene.damping));
  while (body.time() < 150) body.advance(false);
  const Vector2 found = contact_force(body);
  EXPECT_NEAR(found[0], -5e-4 * 2, 1e-11);
  EXPECT_NEAR(found[1], 3e-3 * 2 + 1e-3 * 3, 1e-11);
}
