#include <gtest/gtest.h>

#include "scenes.hpp"
#include "slipscale/dynamics/remarks.hpp"

using namespace slipscale;
using namespace slipscale::testing_support;

namespace {

bool says(const std::vector<std::string>& remarks, const std::string& words) {
  for (const std::string& remark : remarks)
    if (remark.find(words) != std::string::npos) return true;
  return false;
}

Block block() {
  Block b;
  b.nx = b.ny = 6;
  b.width = b.height = 5e-3;
  return b;
}

/// The same block without one of its boundaries' edges: those for which `left_out(x)` holds at their middle.
template <class LeftOut>
Mesh with_part_of_bottom(const LeftOut& left_out) {
  Mesh mesh = block_mesh(block());
  for (Boundary& boundary : mesh.boundaries) {
    if (boundary.name != "bottom") continue;
    std::erase_if(boundary.edges, [&](const BoundaryEdge& edge) {
      return left_out(0.5 * (edge.ends[0][0] + edge.ends[1][0]));
    });
    boundary.nodes.clear();
    for (const BoundaryEdge& edge : boundary.edges)
      for (int node : edge.nodes)
        if (node < mesh.nodes.owned) boundary.nodes.push_back(node);
    std::ranges::sort(boundary.nodes);
    boundary.nodes.erase(std::ranges::unique(boundary.nodes).begin(), boundary.nodes.end());
  }
  return mesh;
}

}  // namespace

TEST(Remarks, APlainRunHasNone) {
  const Mesh mesh = block_mesh(block());
  const Model model(mesh, {scene_r_material()}, Model::Storage::full);
  SlidingBody body(PETSC_COMM_WORLD, model, scene_r(), 2e-8);
  EXPECT_TRUE(remarks_at_start(body).empty());
  for (int n = 0; n <= 500; ++n) body.advance(n == 500);
  EXPECT_TRUE(body.has_touched());
  EXPECT_TRUE(remarks_at_end(body).empty());
}

TEST(Remarks, NameAMemoryThatIsShorterThanTheStep) {
  const Mesh mesh = block_mesh(block());
  const Model model(mesh, {scene_r_material()}, Model::Storage::full);
  Scene scene = scene_r();
  scene.friction.time = 2e-9;
  EXPECT_TRUE(says(remarks_at_start(SlidingBody(PETSC_COMM_WORLD, model, scene, 2e-8)), "2.000 ns"));
  scene.friction.by_slip_rate = true;
  scene.friction.length = 4e-9;  // over 2 + 1 m/s
  scene.friction.rate_reference = 1;
  EXPECT_TRUE(says(remarks_at_start(SlidingBody(PETSC_COMM_WORLD, model, scene, 2e-8)), "1.333 ns"));
  scene.friction.length = 1e-6;
  EXPECT_TRUE(remarks_at_start(SlidingBody(PETSC_COMM_WORLD, model, scene, 2e-8)).empty());
  scene.friction = {FrictionChoice::Law::coulomb, 0.5, false, false, 0, 0, 0};  // as it was asked for
  EXPECT_TRUE(remarks_at_start(SlidingBody(PETSC_COMM_WORLD, model, scene, 2e-8)).empty());
}

TEST(Remarks, NameABodyThatNeverTouches) {
  const Mesh mesh = block_mesh(block());
  const Model model(mesh, {scene_r_material()}, Model::Storage::full);
  Scene scene = scene_r();
  scene.surface->height = -1e-3;
  SlidingBody body(PETSC_COMM_WORLD, model, scene, 2e-8);
  for (int n = 0; n <= 100; ++n) body.advance(n == 100);
  EXPECT_FALSE(body.has_touched());
  EXPECT_TRUE(says(remarks_at_end(body), "never touched"));
}

/// Half of the underside has no name: 3 of 6 edges, which lie on the surface and sink through it.
TEST(Remarks, NameEdgesAtTheSurfaceThatAreNotInTheContact) {
  const Mesh mesh = with_part_of_bottom([](double x) { return x > 2.5e-3; });
  const Model model(mesh, {scene_r_material()}, Model::Storage::full);
  SlidingBody body(PETSC_COMM_WORLD, model, scene_r(), 2e-8);
  EXPECT_TRUE(says(remarks_at_start(body), "3 outer edges between x = 0.0025 and 0.005 m"));
  for (int n = 0; n <= 1500; ++n) body.advance(n == 1500);
  EXPECT_TRUE(says(remarks_at_end(body), "3 outer nodes between"));
}
