#include <gtest/gtest.h>

#include <cmath>

#include "scenes.hpp"

using namespace slipscale;
using namespace slipscale::testing_support;

namespace {

constexpr double pressure = 2e-3, shear = 6e-4, mu = 0.3;  // shear = μ · pressure

Block strip(Shape shape) {
  Block block;
  block.nx = 5;
  block.ny = 6;
  block.width = 1.7;
  block.shape = shape;
  block.distortion = 0.15;
  block.periodic_x = true;
  return block;
}

/// A strip that starts in the uniform state which its loads and its friction hold in equilibrium.
Scene uniform_state(bool held_top, FrictionChoice::Law law, bool stored, double speed) {
  Scene scene;
  scene.initial.pressure = pressure;
  scene.initial.shear = std::copysign(shear, speed);
  if (held_top)
    scene.conditions = {{"top", {0.0, 0.0}, 0, 0, 0}};
  else
    scene.conditions = {{"top", {}, pressure, -scene.initial.shear, 0}};
  scene.surface = Surface{"bottom", 0, speed, 0};
  scene.friction = {law, mu, false, stored, 0.05, 0, 0};
  return scene;
}

double largest(const Vector2* field, int count) {
  double most = 0;
  for (int i = 0; i < count; ++i) most = std::max({most, std::abs(field[i][0]), std::abs(field[i][1])});
  MPI_Allreduce(MPI_IN_PLACE, &most, 1, MPI_DOUBLE, MPI_MAX, PETSC_COMM_WORLD);
  return most;
}

}  // namespace

/// u_y = −p y/C22 and u_x = τ(H − y)/C66 are linear, which P1 and Q1 hold exactly: what moves is rounding,
/// compared with p/(ρc), the velocity that a wave of the same stress carries.
TEST(InitialState, UniformStateStaysInEquilibrium) {
  using Law = FrictionChoice::Law;
  for (const Shape shape : {Shape::triangles, Shape::quadrilaterals, Shape::mixed}) {
    const Mesh mesh = block_mesh(strip(shape));
    const Model model(mesh, {isotropic(1, 0.3, 1)}, Model::Storage::full);
    for (const bool held_top : {false, true})
      for (const Law law : {Law::coulomb, Law::regularized})
        for (const bool stored : {false, true})
          for (const double speed : {3.0, -3.0}) {
            SlidingBody body(PETSC_COMM_WORLD, model, uniform_state(held_top, law, stored, speed), 0.02);
            for (int n = 0; n < 100; ++n) body.advance(n == 99);
            EXPECT_LT(largest(body.velocity_n(), mesh.nodes.owned), 1e-11 * pressure);
            for (int k = 0; k < body.contact().size(); ++k) {
              EXPECT_NEAR(body.contact().pressure[k] / pressure, 1, 1e-10);
              EXPECT_NEAR(body.contact().traction[k] / std::copysign(shear, speed), 1, 1e-10);
              EXPECT_EQ(body.contact().status[k], ContactStatus::slip);
            }
          }
  }
}

TEST(InitialState, OfABodyThatIsNotUniformIsRefused) {
  Block block = strip(Shape::quadrilaterals);
  block.region = [](double x, double) { return x < 0.8 ? 1 : 2; };
  const Mesh mesh = block_mesh(block);
  const Model model(mesh, {isotropic(1, 0.3, 1), isotropic(2, 0.3, 1)}, Model::Storage::full);
  Scene scene;
  scene.initial.pressure = pressure;
  EXPECT_THROW(SlidingBody(PETSC_COMM_WORLD, model, scene, 0.01), UserError);
}

/// Free fall over the gap: u = gap + v t − g t²/2 at the times t_n, exactly so for this scheme; nothing
/// touches before.
TEST(InitialState, BodyFallsOverItsGap) {
  Block block;
  block.shape = Shape::mixed;
  const Mesh mesh = block_mesh(block);
  const Model model(mesh, {isotropic(1, 0.3, 1)}, Model::Storage::full);
  constexpr double gap = 0.1, gravity = 0.2, start = -0.05, dt = 0.01;
  Scene scene;
  scene.initial.gap = gap;
  scene.initial.velocity = {0.3, start};
  scene.body_acceleration = {0, -gravity};
  scene.surface = Surface{"bottom", 0, 1, 0};
  SlidingBody body(PETSC_COMM_WORLD, model, scene, dt);
  const auto height = [&](double t) { return gap + start * t - 0.5 * gravity * t * t; };
  int n = 0;
  for (; height((n + 1) * dt) > 1e-12; ++n) {
    body.advance(false);
    for (const ContactStatus status : body.contact().status) ASSERT_EQ(status, ContactStatus::open);
    for (int i = 0; i < mesh.nodes.owned; ++i) {
      ASSERT_NEAR(body.next_displacement()[i][0], 0.3 * (n + 1) * dt, 1e-13);
      ASSERT_NEAR(body.next_displacement()[i][1], height((n + 1) * dt), 1e-13);
    }
  }
  EXPECT_GT(n, 50);
  body.advance(false);
  for (const ContactStatus status : body.contact().status) EXPECT_EQ(status, ContactStatus::slip);
}

/// v_x = amplitude cos(2πx/wavelength)(1 − y/H)², on top of the uniform velocity.
TEST(InitialState, SineIsWhatStabilityStudiesStartFrom) {
  Block block;
  block.height = 2;
  const Mesh mesh = block_mesh(block);
  const Model model(mesh, {isotropic(1, 0.3, 1)}, Model::Storage::full);
  Scene scene;
  scene.initial.velocity = {0.5, 0.25};
  scene.initial.amplitude = 3;
  scene.initial.wavelength = 0.8;
  SlidingBody body(PETSC_COMM_WORLD, model, scene, 1e-3);
  for (int i = 0; i < mesh.nodes.owned; ++i) {
    const auto [x, y] = mesh.nodes.position[i];
    const double depth = 1 - y / 2;
    EXPECT_NEAR(body.next_predictor()[i][0], 0.5 + 3 * std::cos(2 * std::acos(-1) * x / 0.8) * depth * depth,
                1e-14);
    EXPECT_EQ(body.next_predictor()[i][1], 0.25);
  }
}

/// Turning about the middle of the block: no momentum, and the angular momentum of a rigid rectangle,
/// ω ρWH(W² + H²)/12, but for the part that lumping the mass adds, W²/nx² and H²/ny² of it twice over.
TEST(InitialState, RotationIsThatOfARigidBody) {
  Block block;
  block.nx = 8;
  block.ny = 10;
  block.width = 2;
  block.left = 30;
  block.shape = Shape::quadrilaterals;
  const Mesh mesh = block_mesh(block);
  const Model model(mesh, {isotropic(1, 0.3, 3)}, Model::Storage::full);
  Scene scene;
  scene.initial.rotation = 1e-3;
  SlidingBody body(PETSC_COMM_WORLD, model, scene, 1e-3);
  body.advance(true);
  const Momentum start = body.momentum();
  EXPECT_NEAR(start.mass, 6, 1e-13);
  EXPECT_NEAR(start.linear[0], 0, 1e-15);
  EXPECT_NEAR(start.linear[1], 0, 1e-15);
  const double exact = 1e-3 * 6 / 12 * (4 * (1 + 2.0 / 64) + 1 * (1 + 2.0 / 100));
  EXPECT_NEAR(start.angular / exact, 1, 1e-12);
  // Forces inside the body change neither momentum.
  for (int n = 1; n <= 200; ++n) body.advance(n == 200);
  EXPECT_NEAR(body.momentum().angular / exact, 1, 1e-12);
  EXPECT_NEAR(body.momentum().linear[1], 0, 1e-15);
}

TEST(InitialState, APeriodicBodyDoesNotRotate) {
  Block block;
  block.periodic_x = true;
  const Mesh mesh = block_mesh(block);
  const Model model(mesh, {isotropic(1, 0.3, 1)}, Model::Storage::full);
  Scene scene;
  scene.initial.rotation = 1;
  EXPECT_THROW(SlidingBody(PETSC_COMM_WORLD, model, scene, 1e-3), UserError);
}

/// Stiffness damping acts on the velocity that the body starts with, from the first step on:
/// a_0 = −M⁻¹ K (u_0 + b v_0).
TEST(InitialState, DampingActsFromTheFirstStep) {
  Block block;
  block.shape = Shape::mixed;
  block.distortion = 0.1;
  const Mesh mesh = block_mesh(block);
  const Model model(mesh, {isotropic(1, 0.3, 1)}, Model::Storage::full);
  Scene scene;
  scene.initial.amplitude = 0.1;
  scene.initial.wavelength = 1;
  scene.damping.stiffness = 0.02;
  SlidingBody body(PETSC_COMM_WORLD, model, scene, 1e-3);
  NodalVector v(PETSC_COMM_WORLD, mesh.nodes, true);
  std::copy_n(body.next_predictor(), mesh.nodes.owned, v.data());
  v.begin_update();
  v.end_update();
  std::vector<Vector2> force(mesh.nodes.number.size());
  model.multiply(v.data(), force.data());
  body.advance(true);
  double largest = 0;
  for (int i = 0; i < mesh.nodes.owned; ++i)
    for (int axis = 0; axis < 2; ++axis) {
      const double expected = -scene.damping.stiffness * force[i][axis] / model.mass[i];
      largest = std::max(largest, std::abs(expected));
      EXPECT_NEAR(body.acceleration_n()[i][axis], expected, 1e-11);
    }
  MPI_Allreduce(MPI_IN_PLACE, &largest, 1, MPI_DOUBLE, MPI_MAX, PETSC_COMM_WORLD);
  EXPECT_GT(largest, 0.01);
}
