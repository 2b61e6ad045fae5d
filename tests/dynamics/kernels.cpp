#include <gtest/gtest.h>

#include "scenes.hpp"

using namespace slipscale;
using namespace slipscale::testing_support;

namespace {

struct State {
  std::vector<Vector2> u, w, v, force;
  Energy energy;
};

/// After 40 steps, the last one observed; a stiff disc in a grid that contact and friction push about.
State after_steps(const Mesh& mesh, const Scene& scene, Model::Storage storage,
                  const StiffnessKernel& kernel) {
  Material stiff = scene_r_material();
  stiff.stiffness *= 3;
  const Model model(mesh, {scene_r_material(), stiff}, storage, kernel);
  SlidingBody body(PETSC_COMM_WORLD, model, scene, 5e-9);
  for (int n = 0; n < 40; ++n) body.advance(n == 39);
  const auto owned = static_cast<std::size_t>(mesh.nodes.owned);
  const auto copy = [&](const Vector2* field) { return std::vector<Vector2>(field, field + owned); };
  return {copy(body.next_displacement()), copy(body.next_predictor()), copy(body.velocity_n()),
          copy(body.internal_force_n()), body.energy()};
}

}  // namespace

/// However the stiffness is worked with and whatever the instructions: the same bits, energies included.
TEST(Kernels, MakeTheSameStep) {
  Scene plain = scene_r();
  plain.initial.amplitude = 0.01;
  plain.initial.wavelength = 5e-3;
  plain.body_acceleration = {3, -9.81};
  std::vector<Scene> scenes(5, plain);
  scenes[1].damping.mass = 10;
  scenes[2].damping.stiffness = 2e-10;
  scenes[3].beta2 = 0.6;
  scenes[4].beta2 = 0.7;
  scenes[4].damping = {20, 1e-10};
  for (const Shape shape : {Shape::triangles, Shape::quadrilaterals}) {
    Block block;
    block.nx = block.ny = 37;
    block.width = block.height = 5e-3;
    block.shape = shape;
    block.region = [](double x, double y) { return std::hypot(x - 2e-3, y - 2e-3) < 1e-3 ? 2 : 1; };
    const Mesh mesh = block_mesh(block);
    for (const Scene& scene : scenes)
      for (const Model::Storage storage : {Model::Storage::full, Model::Storage::single}) {
        const State expected = after_steps(mesh, scene, storage, {false, Instructions::base});
        for (const Instructions instructions :
             {Instructions::base, Instructions::avx2, Instructions::avx512}) {
          if (instructions > widest_instructions()) continue;
          for (const bool runs : {true, false}) {
            const State state = after_steps(mesh, scene, storage, {runs, instructions});
            SCOPED_TRACE(testing::Message()
                         << "shape " << static_cast<int>(shape) << ", " << name_of(instructions)
                         << (runs ? ", runs" : ", pairs") << ", beta2 " << scene.beta2 << ", damping "
                         << scene.damping.mass << ' ' << scene.damping.stiffness);
            EXPECT_EQ(state.u, expected.u);
            EXPECT_EQ(state.w, expected.w);
            EXPECT_EQ(state.v, expected.v);
            EXPECT_EQ(state.force, expected.force);
            EXPECT_EQ(state.energy.kinetic, expected.energy.kinetic);
            EXPECT_EQ(state.energy.strain, expected.energy.strain);
            EXPECT_EQ(state.energy.residual, expected.energy.residual);
          }
        }
      }
  }
}

/// A step of which only the boundary is observed shows there what one of which everything is shows, to the
/// bit, and the steps after it do not know.
TEST(Kernels, ObserveTheBoundaryAlone) {
  std::vector<Scene> scenes(4, scene_r());
  for (Scene& scene : scenes) scene.initial.amplitude = 0.01, scene.initial.wavelength = 5e-3;
  scenes[0].damping = {};
  scenes[1].damping = {20, 1e-10};
  scenes[2].beta2 = 0.6;
  scenes[3].friction.by_slip_rate = true;
  scenes[3].friction.length = 1e-6;
  scenes[3].friction.rate_reference = 0.1;
  Block block;
  block.nx = block.ny = 37;
  block.width = block.height = 5e-3;
  block.shape = Shape::quadrilaterals;
  const Mesh mesh = block_mesh(block);
  const Model model(mesh, {scene_r_material()}, Model::Storage::full);
  for (const Scene& scene : scenes) {
    SlidingBody whole(PETSC_COMM_WORLD, model, scene, 5e-9), part(PETSC_COMM_WORLD, model, scene, 5e-9);
    for (int n = 0; n < 60; ++n) {
      whole.advance(Observed::everything);
      part.advance(n % 7 == 3 ? Observed::boundary : Observed::nothing);
      for (int k = 0; k < part.boundary_nodes().size(); ++k) {
        const int i = part.boundary_nodes().node[k];
        ASSERT_EQ(part.internal_force_n()[i], whole.internal_force_n()[i]);
        if (n % 7 != 3) continue;
        ASSERT_EQ(part.displacement_n()[i], whole.displacement_n()[i]);
        ASSERT_EQ(part.velocity_n()[i], whole.velocity_n()[i]);
      }
    }
    for (int i = 0; i < mesh.nodes.owned; ++i)
      ASSERT_EQ(part.next_displacement()[i], whole.next_displacement()[i]);
  }
}
