#include <gtest/gtest.h>

#include "scenes.hpp"
#include "slipscale/base/cosine_ramp.hpp"

using namespace slipscale;
using namespace slipscale::testing_support;

namespace {

/// The message of the UserError that the scene causes on this rank; empty when it causes none.
std::string refusal(const Scene& scene) {
  Block block;
  block.nx = 6;
  block.ny = 5;
  const Mesh mesh = block_mesh(block);
  const Model model(mesh, {isotropic(1, 0.3, 1)}, Model::Storage::full);
  try {
    const SlidingBody body(PETSC_COMM_WORLD, model, scene, 1e-3);
  } catch (const UserError& error) {
    return error.what();
  }
  return "";
}

bool names(const std::string& message, const std::vector<std::string>& words) {
  for (const std::string& word : words)
    if (message.find(word) == std::string::npos) return false;
  return true;
}

}  // namespace

/// The corner belongs to one rank, the error to all.
TEST(Supports, ThatContradictOneAnotherAreRefusedOnEveryRank) {
  Scene scene;
  scene.conditions = {{"top", {0.0, -1e-6}, 0, 0, 0}, {"left", {1e-6, std::nullopt}, 0, 0, 0}};
  EXPECT_TRUE(names(refusal(scene), {"'top'", "'left'", "along x", "-boundary_left_x"})) << refusal(scene);
  scene.conditions = {{"top", {std::nullopt, -1e-6}, 0, 0, 1}, {"left", {std::nullopt, -1e-6}, 0, 0, 2}};
  EXPECT_TRUE(names(refusal(scene), {"'top'", "'left'", "along y", "-boundary_left_y"})) << refusal(scene);
}

TEST(Supports, ThatAgreeAtTheirCornerAreAccepted) {
  Scene scene;
  scene.conditions = {{"top", {0.0, -1e-6}, 0, 0, 1},
                      {"left", {0.0, std::nullopt}, 0, 0, 2},
                      {"right", {std::nullopt, -1e-6}, 0, 0, 1}};
  EXPECT_EQ(refusal(scene), "");
}

TEST(Supports, BodyBelowTheSurfaceIsRefusedOnEveryRank) {
  Scene scene;
  scene.surface = Surface{"bottom", 0.01, 1, 0};
  EXPECT_TRUE(names(refusal(scene), {"-surface_height", "-initial_gap"})) << refusal(scene);
  scene.initial.gap = 0.02;
  EXPECT_EQ(refusal(scene), "");
}

TEST(Supports, FollowTheCosineRampAndThenHold) {
  Block block;
  block.nx = 6;
  block.ny = 5;
  const Mesh mesh = block_mesh(block);
  const Model model(mesh, {isotropic(1, 0.3, 1)}, Model::Storage::full);
  Scene scene;
  scene.conditions = {{"top", {0.25, -0.5}, 0, 0, 0.5}};
  SlidingBody body(PETSC_COMM_WORLD, model, scene, 0.01);
  for (int n = 0; n < 80; ++n) {
    body.advance(false);
    const double level = cosine_ramp(static_cast<double>(n + 1) * 0.01, 0.5);
    for (int i : mesh.find_boundary("top")->nodes) {
      ASSERT_EQ(body.next_displacement()[i][0], 0.25 * level);
      ASSERT_EQ(body.next_displacement()[i][1], -0.5 * level);
    }
  }
}
