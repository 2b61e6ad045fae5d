// Parameters far out: every run must stay sound, and the limits must be those of simpler laws.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "extremes_watch.hpp"
#include "report.hpp"
#include "slipscale/base/print.hpp"

using namespace slipscale;
using namespace slipscale::testing_support;

namespace {

constexpr long steps = 10000;
using Law = FrictionChoice::Law;

constexpr double speed = 2, dt = 20e-9, end = 10e-6;  ///< of `end_state`; dt is .23 of the limit

/// u at `end`, all nodes.
std::vector<Vector2> end_state(const Scene& scene) {
  const Mesh mesh = block_mesh(pressed_block());
  const Model model(mesh, {scene_r_material()}, Model::Storage::full);
  SlidingBody body(PETSC_COMM_WORLD, model, scene, dt);
  for (long n = 0; n < std::lround(end / dt); ++n) body.advance(false);
  return whole_field(PETSC_COMM_WORLD, mesh, body.next_displacement());
}

/// Largest difference, m.
double distance(const std::vector<Vector2>& left, const std::vector<Vector2>& right) {
  double most = 0;
  for (std::size_t i = 0; i < left.size(); ++i)
    for (int axis = 0; axis < 2; ++axis) most = std::max(most, std::abs(left[i][axis] - right[i][axis]));
  return most;
}

Scene with_law(Law law, double coefficient, double time, bool stored_strength = true) {
  Scene scene = pressed_scene();
  scene.friction = {law, coefficient, false, stored_strength, time, 0, 0};
  return scene;
}

}  // namespace

TEST(Extremes, Contrast) {
  Group group("Contrast of Young's moduli 1e-4 to 1e4");
  for (const double contrast : {1e-4, 1e-2, 1e2, 1e4})
    for (const bool layers : {false, true}) {
      Block block = pressed_block();
      block.region = [layers](double x, double y) {
        return (layers ? y < 2.5e-3 : std::hypot(x - 2.5e-3, y - 2.5e-3) < 1.4e-3) ? 2 : 1;
      };
      const auto run = run_watched(block, {scene_r_material(), isotropic(45e9 * contrast, 0.25, 1800)},
                                   pressed_scene(), steps);
      group.add(run.seen, run.reach, format("contrast {:g}", contrast));
    }
  group.report_worst();
}

TEST(Extremes, PoissonsRatio) {
  Group group("Poisson's ratio -.9 to .4999");
  for (const double poisson : {-0.9, 0.0, 0.49, 0.499, 0.4999}) {
    const auto run = run_watched(pressed_block(), {isotropic(45e9, poisson, 1800)}, pressed_scene(), steps);
    group.add(run.seen, run.reach, format("ratio {:g}", poisson));
  }
  group.report_worst();
}

TEST(Extremes, Meshes) {
  Group group("One element; 3 across a torus; slivers of 1 degree");
  const double sliver = std::tan(std::numbers::pi / 180);
  Block single = pressed_block(), torus = pressed_block(), flat = pressed_block(), upright = pressed_block();
  single.nx = single.ny = 1;
  torus.nx = 3;
  torus.width = 1.5e-3;
  torus.periodic_x = true;
  flat.shape = upright.shape = Shape::triangles;
  flat.nx = upright.ny = 4;
  flat.ny = upright.nx = 57;
  flat.width = 4 * (flat.height / 57) / sliver;
  upright.width = 57 * (upright.height / 4) * sliver;
  for (const Block& block : {single, torus, flat, upright}) {
    const auto run = run_watched(block, {scene_r_material()}, pressed_scene(), steps);
    group.add(run.seen, run.reach, format("{} x {} cells", block.nx, block.ny));
  }
  group.report_worst();
  torus.nx = 2;
  EXPECT_THROW(block_mesh(torus), UserError);
}

TEST(Extremes, CoefficientOfFriction) {
  const std::string topic = "Coefficient of friction 0 to 10";
  Group group(topic);
  double frictionless = 0;
  for (const double coefficient : {0.0, 0.1, 1.0, 2.0, 10.0})
    for (const Law law : {Law::coulomb, Law::regularized}) {
      const auto run =
          run_watched(pressed_block(), {scene_r_material()}, with_law(law, coefficient, 0.6e-6), steps);
      group.add(run.seen, run.reach, format("mu {:g}", coefficient));
      if (coefficient == 0) frictionless = std::max(frictionless, run.seen.traction);
    }
  group.report_worst();
  EXPECT_EQ(frictionless, 0);
  report({topic, "mu = 0: largest traction, Pa", "0", format("{:g}", frictionless), "", "Coulomb's law"});
}

/// A regularised traction differs from Coulomb's by the part T/Δt of a change of pressure where T is short,
/// and is the part t/T of it where T is long. The latter for the stored strength only: with the instantaneous
/// threshold a node that once stuck keeps its traction when T is long.
TEST(Extremes, RegularisationLength) {
  const std::string topic = "Regularisation length 1e-15 to 1e3 m";
  Group group(topic);
  for (const double length : {0.0, 1e-15, 1e-12, 1e-9, 1e-6, 1e-3, 1.0, 1e3})
    for (const bool stored_strength : {false, true}) {
      const Scene scene = with_law(Law::regularized, 0.5, length / speed, stored_strength);
      const auto run = run_watched(pressed_block(), {scene_r_material()}, scene, steps);
      group.add(run.seen, run.reach, format("length {:g} m", length));
    }
  group.report_worst();

  const auto coulomb = end_state(with_law(Law::coulomb, 0.5, 0)),
             smooth = end_state(with_law(Law::none, 0, 0));
  const double friction = distance(coulomb, smooth);  // what friction does at all
  const auto from = [&](const std::vector<Vector2>& limit, double length) {
    return distance(limit, end_state(with_law(Law::regularized, 0.5, length / speed))) / friction;
  };
  const double none = from(coulomb, 0), shorter = from(coulomb, 1e-15), longer = from(smooth, 1e3);
  EXPECT_EQ(none, 0);
  EXPECT_LE(shorter, 1e-15 / speed / dt);
  EXPECT_LE(longer, end * speed / 1e3);
  const double order[2] = {std::log10(from(coulomb, 1e-12) / shorter) / 3,
                           std::log10(from(smooth, 1) / longer) / 3};
  for (const double p : order) EXPECT_NEAR(p, 1, 0.01);
  const auto distance_to = [](const char* law) {
    return format(": distance to {} over what friction does, 10 us", law);
  };
  report({topic, "L* = 0" + distance_to("Coulomb"), "0", format("{:g}", none), "", "L* to 0 is Coulomb"});
  report({topic, "L* = 1e-15 m" + distance_to("Coulomb"), format("<= {:.1e}", 1e-15 / speed / dt),
          format("{:.1e}", shorter), format("{:.2f} in L*", order[0]), "T/dt, linear in T"});
  report({topic, "L* = 1e3 m" + distance_to("no friction"), format("<= {:.1e}", end * speed / 1e3),
          format("{:.1e}", longer), format("{:.2f} in 1/L*", order[1]), "t/T, linear in 1/T"});
}

/// At rest all is symmetric, and a slow surface carries the bottom along: no point goes farther than Vt.
TEST(Extremes, SurfaceSpeed) {
  const std::string topic = "Surface speed 0 to 100 m/s";
  Group group(topic);
  double at_rest = 0, farthest = 0;
  for (const Law law : {Law::coulomb, Law::regularized}) {
    const auto at = [&](double v) {
      Scene scene = with_law(law, 0.5, 0.6e-6);
      scene.surface->speed = v;
      return scene;
    };
    for (const double v : {0.0, 1e-9, 1e-6, 1e-3, 1.0, 100.0}) {
      const auto run = run_watched(pressed_block(), {scene_r_material()}, at(v), steps);
      group.add(run.seen, run.reach, format("speed {:g} m/s", v));
      if (v == 0) at_rest = std::max(at_rest, std::abs(run.seen.drag / run.seen.load));
    }
    const auto still = end_state(at(0));
    for (const double v : {1e-9, 1e-6})
      farthest = std::max(farthest, distance(still, end_state(at(v))) / (v * end));
  }
  group.report_worst();
  EXPECT_LE(at_rest, 1e-14);
  report({topic, "V = 0: tangential over normal force of the surface", "<= 1e-14", decade_above(at_rest), "",
          "symmetry"});
  EXPECT_LE(farthest, 1);
  report({topic, "V = 1e-9 and 1e-6 m/s, 10 us: distance to V = 0 over V t", "<= 1",
          format("{:.3f}", farthest), "", "the bottom sticks to the surface"});
}
