#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "scenes.hpp"

using namespace slipscale;
using namespace slipscale::testing_support;

namespace {

Block block_r(Shape shape) {
  Block block;
  block.width = block.height = 5e-3;
  block.nx = block.ny = 20;
  block.shape = shape;
  return block;
}

/// Displacement and velocity of all nodes after 30 µs, by place (column, row).
using Places = std::map<std::pair<long, long>, std::array<double, 4>>;

struct Units {
  double length = 1, time = 1, mass = 1;  ///< new units in one old unit
  double speed() const { return length / time; }
  double stress() const {
    return mass / (length * time * time);
  }  // a plane body's loads are per metre of depth
};

Places run(Block block, Scene scene, const Units& units = {}) {
  block.width *= units.length;
  block.height *= units.length;
  scene.conditions[0].displacement[1] = *scene.conditions[0].displacement[1] * units.length;
  scene.conditions[0].ramp *= units.time;
  scene.damping.stiffness *= units.time;
  scene.surface->speed *= units.speed();
  scene.friction.time *= units.time;
  const double density = units.mass / (units.length * units.length * units.length);
  const std::string path = scratch("scene.msh");
  write_block(block, path);
  Simulation simulation(PETSC_COMM_WORLD, {path}, {isotropic(45e9 * units.stress(), 0.25, 1800 * density)},
                        scene, 5e-9 * units.time);
  for (int n = 0; n < 6000; ++n) simulation.body.advance(n == 5999);
  const Mesh& mesh = simulation.mesh;
  const auto u = whole_field(PETSC_COMM_WORLD, mesh, simulation.body.displacement());
  const auto v = whole_field(PETSC_COMM_WORLD, mesh, simulation.body.velocity());
  const auto x = whole_field(PETSC_COMM_WORLD, mesh, mesh.nodes.position.data());
  Places places;
  for (std::size_t i = 0; i < x.size(); ++i)
    places[{std::lround(x[i][0] / block.width * block.nx), std::lround(x[i][1] / block.height * block.ny)}] =
        {u[i][0] / units.length, u[i][1] / units.length, v[i][0] / units.speed(), v[i][1] / units.speed()};
  return places;
}

double largest(const Places& places, int component) {
  double most = 0;
  for (const auto& [place, values] : places) most = std::max(most, std::abs(values[component]));
  return most;
}

}  // namespace

/// Science, section 8: V → −V gives the mirror image; on triangles, on the mirrored mesh. Rounding only,
/// before the motion saturates.
TEST(SceneR, MirrorsWithTheDirectionOfSliding) {
  for (const Shape shape : {Shape::triangles, Shape::quadrilaterals}) {
    Block block = block_r(shape);
    Scene scene = scene_r();
    const Places right = run(block, scene);
    block.mirrored = true;
    scene.surface->speed = -scene.surface->speed;
    const Places left = run(block, scene);
    ASSERT_EQ(right.size(), 441U);
    ASSERT_EQ(left.size(), 441U);
    for (int component = 0; component < 4; ++component) {
      const double sign = component % 2 == 0 ? -1 : 1;
      double worst = 0;
      for (const auto& [place, values] : right) {
        const double image = left.at({20 - place.first, place.second})[component];
        const double difference = std::abs(values[component] - sign * image);
        if (!(difference <= worst)) worst = difference;  // keeps a NaN
      }
      EXPECT_GT(largest(right, component), 0);
      EXPECT_LE(worst, 1e-10 * largest(right, component)) << "component " << component;
    }
  }
}

/// Powers of two scale without rounding, so nothing may depend on the units: no hidden length, time or
/// stress.
TEST(SceneR, KeepsItsBitsInOtherUnits) {
  for (const Shape shape : {Shape::triangles, Shape::quadrilaterals}) {
    const Places si = run(block_r(shape), scene_r());
    for (const Units& units : {Units{0x1p10, 0x1p20, 0x1p-10}, Units{0x1p-40, 0x1p-3, 0x1p40}})
      EXPECT_EQ(run(block_r(shape), scene_r(), units), si);
  }
}
