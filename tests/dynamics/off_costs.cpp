#include <gtest/gtest.h>

#include <cstdlib>
#include <new>

#include "scenes.hpp"

using namespace slipscale;
using namespace slipscale::testing_support;

// What a scene lacks costs nothing: allocations and bytes of a body and its steps are counted by replacing
// the global operator new, with and without each feature.

namespace {

long allocations = 0, bytes = 0;

void* counted(std::size_t size, std::size_t line) {
  ++allocations;
  bytes += static_cast<long>(size);
  const std::size_t whole = (size + line) / line * line;
  if (void* memory = std::aligned_alloc(line, whole)) return memory;
  throw std::bad_alloc();
}

}  // namespace

// Kept out of line: GCC warns of `free` where it sees only one of a pair of operators inlined.
[[gnu::noinline]] void* operator new(std::size_t size) { return counted(size, 16); }
[[gnu::noinline]] void* operator new(std::size_t size, std::align_val_t line) {
  return counted(size, static_cast<std::size_t>(line));
}
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  return counted(size, 16);
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  std::free(memory);
}

namespace {

struct Taken {
  long allocations, bytes;
  auto operator<=>(const Taken&) const = default;
};

/// A surface without friction below a block that is held at its top: nothing else.
Scene bare() {
  Scene scene = scene_r();
  scene.friction = {};
  scene.friction.law = FrictionChoice::Law::none;
  scene.damping = {};
  scene.beta2 = 0.5;
  return scene;
}

class OffCosts : public testing::Test {
 protected:
  /// Of making the body and 20 steps of it, none observed.
  Taken taken(const Scene& scene) const {
    const Taken before{allocations, bytes};
    SlidingBody body(PETSC_COMM_WORLD, model, scene, 5e-9);
    for (int n = 0; n < 20; ++n) body.advance(false);
    return {allocations - before.allocations, bytes - before.bytes};
  }

  /// Of squares, or distorted, so that no two rows of the stiffness are alike.
  static Mesh squares(double distortion = 0) {
    Block block;
    block.distortion = distortion;
    block.nx = block.ny = 12;
    block.width = block.height = 5e-3;
    return block_mesh(block);
  }

  const Mesh mesh = squares();
  const Model model{mesh, {scene_r_material()}, Model::Storage::full};
  const Taken plain = taken(bare());
};

}  // namespace

TEST_F(OffCosts, TheSameSceneTakesTheSame) { EXPECT_EQ(taken(bare()), plain); }

TEST_F(OffCosts, StiffnessDampingBringsTheForceOfTheStepBefore) {
  Scene scene = bare();
  scene.damping.stiffness = 2e-9;
  const Taken damped = taken(scene);
  const auto nodes = static_cast<long>(mesh.nodes.number.size());
  EXPECT_GE(damped.bytes - plain.bytes, nodes * static_cast<long>(sizeof(Vector2)));
  EXPECT_GT(damped.allocations, plain.allocations);
}

TEST_F(OffCosts, MassDampingAndDissipationKeepNothing) {
  Scene scene = bare();
  scene.damping.mass = 100;
  const long vectors = static_cast<long>(mesh.nodes.number.size()) * static_cast<long>(sizeof(Vector2));
  EXPECT_LT(taken(scene).bytes - plain.bytes, vectors) << "of no motion or force of the nodes";
  scene.damping.mass = 0;
  scene.beta2 = 0.6;
  EXPECT_LT(taken(scene).bytes - plain.bytes, vectors);
}

TEST_F(OffCosts, AStraightSideIsMadeOnlyWhereThereIsOne) {
  Scene scene = bare();
  scene.conditions[0].displacement[1].reset();
  scene.conditions[0].straight = BoundaryCondition::Straight::rigid;
  scene.conditions[0].plate_force = -7e4;
  EXPECT_GT(taken(scene).bytes, plain.bytes);
}

TEST_F(OffCosts, SingleStorageHoldsLess) {
  const Mesh general = squares(0.2);
  const auto held = [&](Model::Storage storage) {
    const long before = bytes;
    const Model one(general, {scene_r_material()}, storage);
    return bytes - before;
  };
  EXPECT_LT(held(Model::Storage::single), held(Model::Storage::full));
}

TEST_F(OffCosts, AFrictionlessSurfaceHasNoMemory) {
  const Taken rubbed = taken(scene_r());
  EXPECT_GE(rubbed.bytes, plain.bytes);
}
