#include <gtest/gtest.h>

#include <cmath>

#include "report.hpp"
#include "scenes.hpp"
#include "slipscale/base/print.hpp"

using namespace slipscale;
using namespace slipscale::testing_support;

namespace {

using Law = FrictionChoice::Law;

struct Case {
  std::string name;
  FrictionChoice friction;
};

std::vector<Case> laws() {
  constexpr double mu = 0.5, time = 0.6e-6, length = 1.2e-6;
  return {{"frictionless", {Law::none, 0, false, false, 0, 0, 0}},
          {"coulomb", {Law::coulomb, mu, false, false, 0, 0, 0}},
          {"instantaneous", {Law::regularized, mu, false, false, time, 0, 0}},
          {"stored strength", {Law::regularized, mu, false, true, time, 0, 0}},
          {"slip rate, instantaneous", {Law::regularized, mu, true, false, 0, length, 0.1}},
          {"slip rate, stored strength", {Law::regularized, mu, true, true, 0, length, 0.1}}};
}

/// Scene R in miniature: 10 × 10 cells of .5 mm.
Block block() {
  Block b;
  b.nx = b.ny = 10;
  b.width = b.height = 5e-3;
  b.shape = Shape::mixed;
  b.distortion = 0.1;
  return b;
}

/// A hard landing under everything at once: traction loads, gravity, a side held along x, an initial velocity
/// and gap.
Scene landing() {
  Scene scene = scene_r();
  scene.conditions = {{"top", {}, 15e6, -2e6, 10e-6}, {"left", {0.0, std::nullopt}, 1e6, 5e5, 5e-6}};
  scene.body_acceleration = {-2e4, -1e5};
  scene.initial.velocity = {0.2, -0.5};
  scene.initial.gap = 2e-7;
  return scene;
}

struct Course {
  Energy end;
  double worst_residual = 0;      ///< over `flowed`
  double least_damping = 1;       ///< over `flowed`
  double worst_fall_of_heat = 0;  ///< between two rows, over the heat
  StatusCount status;
};

Course course(const Model& model, const Scene& scene) {
  const double step =
      0.8 * stable_step(largest_frequency(PETSC_COMM_WORLD, model).sharp, scene.beta2, scene.damping);
  SlidingBody body(PETSC_COMM_WORLD, model, scene, step);
  Course c;
  double heat = 0;
  for (int n = 1; n <= 1500; ++n) {
    const bool row = n % 25 == 0;
    body.advance(row);
    c.status.add(body.contact());
    if (!row) continue;
    c.end = body.energy();
    const double residual = std::abs(c.end.residual) / c.end.flowed;
    c.worst_residual = worse(c.worst_residual, residual);
    c.least_damping = std::min(c.least_damping, c.end.damping / c.end.flowed);
    if (heat > 0) c.worst_fall_of_heat = worse(c.worst_fall_of_heat, 1 - c.end.friction_heat / heat);
    heat = c.end.friction_heat;
  }
  c.status = c.status.over_ranks(PETSC_COMM_WORLD);
  return c;
}

}  // namespace

/// The balance closes to rounding, here 1e-10 of all that flowed, whatever the scheme,
/// the law and the damping; friction, damping and scheme only take.
TEST(EnergyLedger, Closes) {
  const Mesh mesh = block_mesh(block());
  const Model model(mesh, {scene_r_material()}, Model::Storage::full);
  double worst = 0;
  int runs = 0;
  for (const bool lands : {false, true})
    for (const Case& law : laws()) {
      StatusCount status;
      for (const double beta2 : {0.5, 0.6, 0.8, 1.0})
        for (const Damping& damping :
             {Damping{0, 0}, Damping{2e4, 0}, Damping{0, 2e-9}, Damping{2e4, 2e-9}}) {
          Scene scene = lands ? landing() : scene_r();
          scene.beta2 = beta2;
          scene.damping = damping;
          scene.friction = law.friction;
          const Course c = course(model, scene);
          const std::string name =
              law.name + format(", beta2 {:g}, a {:g}, b {:g}", beta2, damping.mass, damping.stiffness) +
              (lands ? ", landing" : ", scene R");
          EXPECT_LE(c.worst_residual, 1e-10) << name;
          worst = worse(worst, c.worst_residual);
          ++runs;
          EXPECT_LE(c.worst_fall_of_heat, 1e-12) << name;
          EXPECT_GE(c.least_damping, 0) << name;
          EXPECT_EQ(c.end.damping > 0, damping.mass > 0 || damping.stiffness > 0) << name;
          EXPECT_EQ(c.end.scheme_dissipation > 0, beta2 > 0.5) << name;
          EXPECT_EQ(c.end.friction_heat > 0, law.friction.coefficient > 0) << name;
          if (lands) {
            EXPECT_GT(c.end.impact_loss, 0) << name;
          }
          status = {status.open + c.status.open, status.stick + c.status.stick, status.slip + c.status.slip};
        }
      if (lands && law.friction.coefficient > 0) {
        EXPECT_TRUE(status.all_seen()) << law.name;
      }
    }
  report({"Energy ledger: scene R and a landing, six laws, four beta2, with and without both dampings",
          format("largest residual over the energy that flowed, {} runs", runs), "<= 1e-10",
          shown_error(worst, 1e-11), "", "rounding"});
}

/// A free body that rings: with no force that jumps, what the scheme and the dampers take grows in every
/// step.
TEST(EnergyLedger, OfAFreeBodyOnlyLoses) {
  const Mesh mesh = block_mesh(block());
  const Model model(mesh, {scene_r_material()}, Model::Storage::full);
  const double frequency = largest_frequency(PETSC_COMM_WORLD, model).sharp;
  for (const double beta2 : {0.6, 0.8, 1.0})
    for (const Damping& damping : {Damping{0, 0}, Damping{2e5, 0}}) {
      Scene scene;
      scene.beta2 = beta2;
      scene.damping = damping;
      scene.initial.amplitude = 1;
      scene.initial.wavelength = 5e-3;
      SlidingBody body(PETSC_COMM_WORLD, model, scene, 0.8 * stable_step(frequency, beta2, damping));
      Energy last;
      for (int n = 0; n < 500; ++n) {
        body.advance(true);
        const Energy energy = body.energy();
        ASSERT_GE(energy.scheme_dissipation, last.scheme_dissipation) << "beta2 " << beta2 << " step " << n;
        ASSERT_GE(energy.damping, last.damping) << "beta2 " << beta2 << " step " << n;
        ASSERT_LE(std::abs(energy.residual), 1e-10 * energy.flowed);
        last = energy;
      }
      EXPECT_GT(last.scheme_dissipation, 0);
    }
}

/// Terms with known values: a strip in uniform sliding turns the drive's work τLVt into heat, and nothing
/// else flows.
TEST(EnergyLedger, OfSteadySlidingIsAllHeat) {
  Block b;
  b.nx = 4;
  b.width = 2;
  b.periodic_x = true;
  const Mesh mesh = block_mesh(b);
  const Model model(mesh, {isotropic(1, 0.3, 1)}, Model::Storage::full);
  Scene scene;
  scene.conditions = {{"top", {0.0, 0.0}, 0, 0, 0}};
  scene.initial.pressure = 1e-3;
  scene.initial.shear = 5e-4;
  scene.surface = Surface{"bottom", 0, 3, 0};
  scene.friction = {Law::regularized, 0.5, false, false, 0.1, 0, 0};
  SlidingBody body(PETSC_COMM_WORLD, model, scene, 0.02);
  for (int n = 0; n < 101; ++n) body.advance(n == 100);
  const Energy energy = body.energy();
  const double expected = 5e-4 * 2 * 3 * body.time();
  EXPECT_NEAR(body.time(), 2, 1e-12);
  EXPECT_NEAR(energy.surface_drive / expected, 1, 1e-12);
  EXPECT_NEAR(energy.friction_heat / expected, 1, 1e-12);
  EXPECT_NEAR(energy.loads + energy.supports + energy.impact_loss, 0, 1e-12 * expected);
  report({"Energy ledger: strip in uniform sliding", "drive and friction heat over tau L V t, less one",
          "<= 1e-12",
          shown_error(worse(std::abs(energy.surface_drive / expected - 1),
                            std::abs(energy.friction_heat / expected - 1)),
                      1e-12),
          "", "exact solution"});
}

/// A free body under gravity: its kinetic energy grows by the work of gravity.
TEST(EnergyLedger, OfFreeFallIsTheWorkOfGravity) {
  const Mesh mesh = block_mesh(block());
  const Model model(mesh, {scene_r_material()}, Model::Storage::full);
  Scene scene;
  scene.body_acceleration = {3, -4};
  scene.initial.velocity = {1, 2};
  SlidingBody body(PETSC_COMM_WORLD, model, scene, 1e-8);
  for (int n = 0; n < 101; ++n) body.advance(n == 100);
  const Energy energy = body.energy();
  const double t = body.time(), mass = 1800 * 25e-6;
  // Ê differs from the kinetic energy by (Δt²β2/4) aᵀMa.
  const double kinetic =
      0.5 * mass * (std::pow(1 + 3 * t, 2) + std::pow(2 - 4 * t, 2)) - 1e-16 / 8 * mass * 25;
  EXPECT_NEAR(energy.kinetic / kinetic, 1, 1e-12);
  const double work = mass * (3 * (t + 1.5 * t * t) - 4 * (2 * t - 2 * t * t));
  EXPECT_NEAR(energy.body_force, work, 1e-12 * kinetic);
  report({"Energy ledger: free fall", "kinetic energy; work of gravity: relative error", "<= 1e-12; 1e-12",
          shown_error(std::abs(energy.kinetic / kinetic - 1), 1e-12) + "; " +
              shown_error(std::abs(energy.body_force - work) / kinetic, 1e-12),
          "", "exact solution"});
}
