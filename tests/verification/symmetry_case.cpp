#include "symmetry_case.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "report.hpp"

namespace slipscale::testing_support {
namespace {

Material anisotropic_inclusion() {
  Material material = isotropic(80e9, 0.2, 2500);
  material.stiffness(0, 0) *= 1.5;
  material.stiffness(0, 2) = material.stiffness(2, 0) = 9e9;
  material.stiffness(1, 2) = material.stiffness(2, 1) = -4e9;
  return material;
}

}  // namespace

Case pressed_case(Shape shape, bool stored_strength) {
  Case what;
  what.name = "pressed block";
  what.block.width = what.block.height = 5e-3;
  what.block.nx = what.block.ny = 20;
  what.block.shape = shape;
  what.materials = {scene_r_material()};
  what.scene = scene_r();
  what.scene.friction.stored_strength = stored_strength;
  what.steps = 6000;
  return what;
}

Case landing_case(bool stored_strength) {
  Case what;
  what.name = "landing block";
  what.block.width = 7e-3;
  what.block.height = 4.5e-3;
  what.block.nx = 15;  // odd, so that the pattern of mixed cells is its own mirror image
  what.block.ny = 9;
  what.block.shape = Shape::mixed;
  what.materials = {scene_r_material()};
  Scene& s = what.scene;
  s = scene_r();
  s.conditions = {{"top", {}, 15e6, -1e6, 2e-6}};
  s.initial.velocity = {0.1, -0.5};
  s.initial.gap = 1e-7;
  s.initial.amplitude = 2;
  s.initial.wavelength = what.block.width;
  s.damping = {1e3, 2e-9};
  s.beta2 = 0.55;
  s.body_acceleration = {10, -1e4};
  s.friction = {FrictionChoice::Law::regularized, 0.5, true, stored_strength, 0, 1.2e-6, 0.1};
  what.steps = 2000;
  return what;
}

Case with_inclusion(Case what) {
  const double width = what.block.width, height = what.block.height;
  what.block.region = [=](double x, double y) {
    return x > 0.25 * width && x < 0.6 * width && y > 0.2 * height && y < 0.7 * height ? 2 : 1;
  };
  what.materials = {what.materials.front(), anisotropic_inclusion()};
  return what;
}

Case mirrored(Case what) {
  what.block.mirrored = !what.block.mirrored;
  what.block.region = [region = what.block.region, width = what.block.width](double x, double y) {
    return region(width - x, y);
  };
  for (Material& material : what.materials)
    for (int row = 0; row < 2; ++row) {
      material.stiffness(row, 2) = -material.stiffness(row, 2);
      material.stiffness(2, row) = -material.stiffness(2, row);
    }
  Scene& s = what.scene;
  for (BoundaryCondition& condition : s.conditions) condition.shear = -condition.shear;
  s.initial.velocity[0] = -s.initial.velocity[0];
  s.initial.amplitude = -s.initial.amplitude;  // a cosine over the width is its own mirror image
  s.body_acceleration[0] = -s.body_acceleration[0];
  s.surface->speed = -s.surface->speed;
  return what;
}

Case scaled(Case what, double factor) {
  Scene& s = what.scene;
  for (BoundaryCondition& condition : s.conditions) {
    for (auto& u : condition.displacement)
      if (u) *u *= factor;
    condition.pressure *= factor;
    condition.shear *= factor;
  }
  for (double* value : {&s.initial.velocity[0], &s.initial.velocity[1], &s.initial.gap, &s.initial.amplitude,
                        &s.body_acceleration[0], &s.body_acceleration[1], &s.surface->speed,
                        &s.friction.length, &s.friction.rate_reference})
    *value *= factor;
  return what;
}

Case in_units(Case what, const Units& units) {
  what.block.region = [region = what.block.region, length = units.length](double x, double y) {
    return region(x / length, y / length);
  };
  what.step *= units.time;
  for (Material& material : what.materials) {
    material.stiffness *= units.stress();
    material.density *= units.density();
  }
  Scene& s = what.scene;
  for (BoundaryCondition& condition : s.conditions) {
    for (auto& u : condition.displacement)
      if (u) *u *= units.length;
    condition.pressure *= units.stress();
    condition.shear *= units.stress();
    condition.ramp *= units.time;
  }
  for (double* length :
       {&what.block.width, &what.block.height, &s.initial.gap, &s.initial.wavelength, &s.friction.length})
    *length *= units.length;
  for (double* speed : {&s.initial.velocity[0], &s.initial.velocity[1], &s.initial.amplitude,
                        &s.surface->speed, &s.friction.rate_reference})
    *speed *= units.speed();
  for (double& acceleration : s.body_acceleration) acceleration *= units.acceleration();
  for (double* time : {&s.damping.stiffness, &s.friction.time}) *time *= units.time;
  s.damping.mass /= units.time;
  return what;
}

State run(const Case& what) {
  const std::string path = scratch("case.msh");
  write_block(what.block, path);
  Simulation simulation(PETSC_COMM_WORLD, {path}, what.materials, what.scene, what.step);
  State state;
  for (int n = 0; n < what.steps; ++n) {
    simulation.body.advance(n + 1 == what.steps);
    state.count.add(simulation.body.contact());
  }
  state.count = state.count.over_ranks(PETSC_COMM_WORLD);
  const Mesh& mesh = simulation.mesh;
  const auto u = whole_field(PETSC_COMM_WORLD, mesh, simulation.body.displacement_n());
  const auto v = whole_field(PETSC_COMM_WORLD, mesh, simulation.body.velocity_n());
  const auto x = whole_field(PETSC_COMM_WORLD, mesh, mesh.nodes.position.data());
  for (std::size_t i = 0; i < x.size(); ++i)
    state.places[{std::lround(x[i][0] / what.block.width * what.block.nx),
                  std::lround(x[i][1] / what.block.height * what.block.ny)}] = {u[i][0], u[i][1], v[i][0],
                                                                                v[i][1]};
  return state;
}

State mirrored(const State& state, int columns) {
  State image;
  image.count = state.count;
  for (const auto& [place, values] : state.places)
    image.places[{columns - place.first, place.second}] = {-values[0], values[1], -values[2], values[3]};
  return image;
}

State divided(const State& state, double displacement, double velocity) {
  State result = state;
  for (auto& [place, values] : result.places)
    values = {values[0] / displacement, values[1] / displacement, values[2] / velocity, values[3] / velocity};
  return result;
}

double largest_difference(const State& expected, const State& found) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  if (expected.places.empty() || expected.places.size() != found.places.size()) return infinite;
  std::array<double, 4> worst{}, largest{};
  for (const auto& [place, values] : expected.places) {
    const auto match = found.places.find(place);
    if (match == found.places.end()) return infinite;
    for (int c = 0; c < 4; ++c) {
      const double difference = std::abs(values[c] - match->second[c]);
      if (!std::isfinite(difference)) return infinite;
      worst[c] = worse(worst[c], difference);
      largest[c] = std::max(largest[c], std::abs(values[c]));
    }
  }
  double most = 0;
  for (int c = 0; c < 4; ++c) most = std::max(most, largest[c] > 0 ? worst[c] / largest[c] : infinite);
  return most;
}

}  // namespace slipscale::testing_support
