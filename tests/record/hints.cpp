#include "slipscale/record/hints.hpp"

#include <gtest/gtest.h>

#include "scenes.hpp"

using namespace slipscale;
using namespace slipscale::testing_support;

namespace {

/// Scene R on 20 x 20 squares of .25 mm, and what is asked for about it.
struct Case {
  Scene scene = scene_r();
  std::vector<Material> materials{scene_r_material()};
  TimeStep step{2e-8, 4e-8, 4e-8, 20000, {5e7, 5e7, {}}};
  RecordChoice record;

  Case() {
    record.history.every = 1000;
    record.contact.every = 1000;
  }

  std::vector<std::string> hints() const {
    Block block;
    block.nx = block.ny = 20;
    block.width = block.height = 5e-3;
    Mesh mesh = block_mesh(block);
    while (mesh.regions.size() < materials.size())
      mesh.regions.push_back({"region " + std::to_string(mesh.regions.size())});
    const Model model(mesh, materials, Model::Storage::full);
    const SlidingBody body(PETSC_COMM_WORLD, model, scene, step.step);
    memory = describe_memory(body);
    return hints_at_start(body, step, record);
  }
  mutable std::string memory;
};

void expect_only(const std::vector<std::string>& hints, const std::string& words) {
  ASSERT_EQ(hints.size(), 1U) << (hints.empty() ? "" : hints[1]);
  EXPECT_NE(hints[0].find(words), std::string::npos) << hints[0];
}

}  // namespace

TEST(Hints, APlainSceneHasNone) {
  const Case plain;
  EXPECT_TRUE(plain.hints().empty());
  // c_s T = 3162 m/s times .6 µs over edges of .25 mm.
  EXPECT_NE(plain.memory.find("7.59 of the contact's longest edge"), std::string::npos) << plain.memory;
}

TEST(Hints, AMaterialThatIsGivenTwice) {
  Case twice;
  twice.materials.push_back(scene_r_material());
  twice.materials[1].description = "said otherwise";
  expect_only(twice.hints(), "have the same material");
  twice.materials[1].density *= 1.01;
  EXPECT_TRUE(twice.hints().empty());
}

TEST(Hints, DampingThatChangesNothing) {
  Case idle;
  idle.scene.damping = {0, 1e-17};  // b omega² end / 2 = 5e-6
  expect_only(idle.hints(), "-damping_stiffness 1e-17 s takes less");
  idle.scene.damping = {1, 0};  // a end / 2 = 2e-4
  expect_only(idle.hints(), "-damping_mass 1 1/s takes less");
  idle.scene.damping = {100, 2e-9};
  EXPECT_TRUE(idle.hints().empty());
}

TEST(Hints, AStepFarBelowTheLimit) {
  Case small;
  small.step.limit = 8.1e-8;
  expect_only(small.hints(), "0.247 of the stable one, so that 3.65 times");
}

TEST(Hints, AMemoryShorterThanTwoEdges) {
  Case brief;
  brief.scene.friction.time = 0.1e-6;  // c_s T = 316 µm, edges of 250
  expect_only(brief.hints(), "1.3 edges of the contact");
  brief.scene.friction.time = 0.16e-6;
  EXPECT_TRUE(brief.hints().empty());
  brief.scene.friction.time = 1e-8;  // shorter than a step, which is said already
  EXPECT_TRUE(brief.hints().empty());
}

TEST(Hints, OutputsThatTakeMoreThanATenth) {
  Case dear;
  dear.step.count = 2000000;
  dear.record.history.every = 5;
  expect_only(dear.hints(), "most of it history.h5");
  dear.record.history.every = 1000;
  dear.record.contact.every = 5;
  expect_only(dear.hints(), "most of it contact.h5");
  dear.record.contact.every = 1000;
  dear.record.fields.every = 100;
  expect_only(dear.hints(), "most of it fields.h5");
  dear.step.count = 2000;  // a moment
  EXPECT_TRUE(dear.hints().empty());
}

TEST(Hints, OutputsWithNothingBetweenStartAndEnd) {
  Case seldom;
  seldom.step.count = 500;
  seldom.record.history.option = "history_interval";
  seldom.record.contact.option = "contact_interval";
  expect_only(
      seldom.hints(),
      "nothing between start and end is recorded in history.h5 (-history_every 1000 steps), contact.h5");
  seldom.record.history = seldom.record.contact = {{}, 1e-6, "history_interval"};
  EXPECT_TRUE(seldom.hints().empty());
  seldom.record.interface_rows = {{}, 1.1e-5, "interfaces_interval"};  // 550 steps
  expect_only(
      seldom.hints(),
      "recorded in interfaces.h5 (-interfaces_interval 1.1e-05 s), as the run has 500 steps to 1e-05 s");
  seldom.record.interface_rows = {};
  seldom.record.fields = {501, {}, "fields_interval"};
  expect_only(seldom.hints(), "fields.h5 (-fields_every 501 steps)");
  seldom.record.fields.every = 500;
  EXPECT_TRUE(seldom.hints().empty());
}
