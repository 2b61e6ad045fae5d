#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "graded.hpp"
#include "grids.hpp"
#include "report.hpp"
#include "scenes.hpp"
#include "slipscale/base/order_free_sum.hpp"
#include "slipscale/base/parallel.hpp"
#include "slipscale/base/print.hpp"
#include "slipscale/record/interface_record.hpp"
#include "slipscale/solid/element.hpp"

using namespace slipscale;
using namespace slipscale::testing_support;

namespace {

/// Two discs in a block of 5 mm, neither at its outside.
Block block(Shape shape) {
  Block b;
  b.nx = b.ny = 20;
  b.width = b.height = 5e-3;
  b.shape = shape;
  b.distortion = 0.1;
  b.region = [](double x, double y) {
    return std::hypot(x - 1.5e-3, y - 1.5e-3) < 0.9e-3 || std::hypot(x - 3.4e-3, y - 3.2e-3) < 1.1e-3 ? 2 : 1;
  };
  return b;
}

std::vector<Material> materials() { return {scene_r_material(), isotropic(200e9, 0.2, 4000)}; }

Scene shaken() {
  Scene scene = scene_r();
  scene.conditions[0].ramp = 1e-6;
  scene.body_acceleration = {-2e5, -1e6};
  return scene;
}

/// Σ m (a + a w − g) over all nodes of each inclusion, by its own cells.
std::vector<Vector2> inertia(const SlidingBody& body, const RegionInclusions& found, int region) {
  const Material& material = body.model().materials[region];
  const Mesh& mesh = body.model().mesh;
  const Scene& scene = body.scene();
  const double velocity = scene.beta2 * body.time_step();
  std::vector<Vector2> sums(found.inclusions.area.size());
  for (std::size_t inclusion = 0; inclusion < sums.size(); ++inclusion)
    for (int axis = 0; axis < 2; ++axis) {
      std::vector<double> terms;
      for (int cell = 0; cell < mesh.cells.size(); ++cell) {
        if (mesh.cells.region[cell] != region) continue;
        const auto at =
            std::ranges::lower_bound(found.cells.number, static_cast<int>(mesh.cells.number[cell]));
        if (found.inclusions.of_cell[at - found.cells.number.begin()] != static_cast<int>(inclusion))
          continue;
        const auto areas = corner_areas(mesh.cells.corners_of(cell));
        const auto nodes = mesh.cells.nodes_of(cell);
        for (std::size_t k = 0; k < nodes.size(); ++k) {
          if (nodes[k] >= mesh.nodes.owned) continue;
          const double a = body.acceleration_n()[nodes[k]][axis], v = body.velocity_n()[nodes[k]][axis];
          terms.push_back(material.at(cell).density * areas[k] *
                          (a + scene.damping.mass * (v - velocity * a) - scene.body_acceleration[axis]));
        }
      }
      sums[inclusion][axis] = order_free_sums(PETSC_COMM_WORLD, {terms}, 100000)[0];
    }
  return sums;
}

}  // namespace

/// The forces that the matrix exerts on an inclusion add up to its inertia.
TEST(InterfaceForces, BalanceTheInertiaOfEachInclusion) {
  double worst = 0;
  int runs = 0;
  for (const Shape shape : {Shape::triangles, Shape::quadrilaterals, Shape::mixed}) {
    const Mesh mesh = block_mesh(block(shape));
    const Model model(mesh, materials(), Model::Storage::full);
    const double frequency = largest_frequency(PETSC_COMM_WORLD, model).sharp;
    for (const double beta2 : {0.5, 0.8})
      for (const Damping& damping : {Damping{0, 0}, Damping{2e5, 0}, Damping{0, 2e-9}, Damping{2e5, 2e-9}}) {
        Scene scene = shaken();
        scene.beta2 = beta2;
        scene.damping = damping;
        SlidingBody body(PETSC_COMM_WORLD, model, scene, 0.8 * stable_step(frequency, beta2, damping));
        InterfaceRecord record(body, {"inclusion", {}});
        EXPECT_EQ(record.needs_step_before(), damping.stiffness > 0);
        for (int n = 0; n < 300; ++n) body.advance(false);
        body.advance(true);
        if (record.needs_step_before()) record.keep_past();
        body.advance(true);
        const auto forces = record.forces();
        const auto found = find_inclusions(mesh, 1);
        const auto expected = inertia(body, found, 1);
        ASSERT_EQ(expected.size(), 2u);
        if (is_root(PETSC_COMM_WORLD)) {
          std::vector<Vector2> sums(2);
          double flowed = 0;
          for (std::size_t k = 0; k < forces.size(); ++k) {
            for (int axis = 0; axis < 2; ++axis)
              sums[found.inclusions.interface[k].inclusion][axis] += forces[k][axis];
            flowed += std::hypot(forces[k][0], forces[k][1]);
          }
          for (std::size_t k = 0; k < 2; ++k)
            for (int axis = 0; axis < 2; ++axis) {
              EXPECT_GT(std::hypot(expected[k][0], expected[k][1]), 1e-4 * flowed) << "nothing to balance";
              EXPECT_NEAR(sums[k][axis], expected[k][axis], 1e-11 * flowed);
              worst = worse(worst, std::abs(sums[k][axis] - expected[k][axis]) / flowed);
            }
        }
        ++runs;
      }
  }
  worst = largest_of_ranks(worst);
  report(
      {"Traction along the interfaces of two shaken inclusions, P1, Q1 and mixed, both dampings, two beta2",
       format("sum of the forces less m a of each inclusion, over the sizes of the forces, {} runs", runs),
       "<= 1e-11", shown_error(worst, 1e-11), "", "Newton's second law, rounding"});
}

/// Of a uniform stress the traction is σ n at every node of any mesh, from nodal displacements and from
/// stresses.
TEST(InterfaceForces, OfAUniformStressAreExact) {
  const Eigen::Vector3d strain{1e-4, -2e-4, 3e-4};
  for (const Shape shape : {Shape::triangles, Shape::quadrilaterals, Shape::mixed}) {
    const Mesh mesh = block_mesh(block(shape));
    const std::vector<Material> same{scene_r_material(), scene_r_material()};
    const auto found = find_inclusions(mesh, 1);
    const InterfaceForces forces(mesh, same, 1, found);
    const Eigen::Vector3d stress = same[0].stiffness * strain;
    std::vector<Vector2> u;
    for (const Vector2& x : mesh.nodes.position)
      u.push_back(
          {strain[0] * x[0] + 0.5 * strain[2] * x[1] + 1, strain[1] * x[1] + 0.5 * strain[2] * x[0] - 1});
    for (std::size_t k = 0; k < forces.rows().size(); ++k) {
      const InterfaceNode& node = found.inclusions.interface[forces.rows()[k]];
      const Vector2& n = node.normal;
      const double t[2] = {stress[0] * n[0] + stress[2] * n[1], stress[2] * n[0] + stress[1] * n[1]};
      const auto recovered = tractions(node, forces.internal(k, u.data()));
      EXPECT_NEAR(recovered[0], t[0] * n[0] + t[1] * n[1], 1e-6 * stress.norm());
      EXPECT_NEAR(recovered[1], t[1] * n[0] - t[0] * n[1], 1e-6 * stress.norm());
    }
    const PlaneGrid grid = block_grid(block(shape));
    std::vector<int> points(grid.points.size());
    std::iota(points.begin(), points.end(), 0);
    const auto plain = find_inclusions(grid, 1, points);
    const StressForces of_stress(grid, plain);
    const auto all =
        of_stress(std::vector<PlaneTensor>(of_stress.cells().size(), {stress[0], stress[1], stress[2]}));
    ASSERT_EQ(all.size(), plain.inclusions.interface.size());
    for (std::size_t k = 0; k < all.size(); ++k) {
      const InterfaceNode& node = plain.inclusions.interface[k];
      const Vector2& n = node.normal;
      const double t[2] = {stress[0] * n[0] + stress[2] * n[1], stress[2] * n[0] + stress[1] * n[1]};
      const auto recovered = tractions(node, all[k]);
      EXPECT_NEAR(recovered[0], t[0] * n[0] + t[1] * n[1], 1e-10 * stress.norm());
      EXPECT_NEAR(recovered[1], t[1] * n[0] - t[0] * n[1], 1e-10 * stress.norm());
    }
  }
}

/// The same of graded inclusions in a graded matrix, which takes the stiffness and the density of each cell.
TEST(InterfaceForces, BalanceTheInertiaOfGradedInclusions) {
  for (const Shape shape : {Shape::triangles, Shape::mixed}) {
    const Mesh mesh = block_mesh(block(shape));
    std::vector<Material> solids;
    for (const Material& base : materials())
      solids.push_back(graded(
          mesh, base, [](const Vector2& x) { return 1 + 400 * x[0] + 200 * x[1]; },
          [](const Vector2& x) { return 1 + 300 * x[1]; }));
    const Model model(mesh, solids, Model::Storage::full);
    Scene scene = shaken();
    scene.damping = {2e5, 2e-9};
    SlidingBody body(
        PETSC_COMM_WORLD, model, scene,
        0.8 * stable_step(largest_frequency(PETSC_COMM_WORLD, model).sharp, scene.beta2, scene.damping));
    InterfaceRecord record(body, {"inclusion", {}});
    for (int n = 0; n < 300; ++n) body.advance(false);
    body.advance(true);
    record.keep_past();
    body.advance(true);
    const auto forces = record.forces();
    const auto found = find_inclusions(mesh, 1);
    const auto expected = inertia(body, found, 1);
    if (!is_root(PETSC_COMM_WORLD)) continue;
    std::vector<Vector2> sums(2);
    double flowed = 0;
    for (std::size_t k = 0; k < forces.size(); ++k) {
      for (int axis = 0; axis < 2; ++axis)
        sums[found.inclusions.interface[k].inclusion][axis] += forces[k][axis];
      flowed += std::hypot(forces[k][0], forces[k][1]);
    }
    for (std::size_t k = 0; k < 2; ++k) {
      EXPECT_GT(std::hypot(expected[k][0], expected[k][1]), 1e-4 * flowed) << "nothing to balance";
      for (int axis = 0; axis < 2; ++axis) EXPECT_NEAR(sums[k][axis], expected[k][axis], 1e-11 * flowed);
    }
  }
}

/// t = σ n where every cell of a graded region happens to be alike, and not as its slowest one.
TEST(InterfaceForces, AreOfTheCellsOfAGradedRegion) {
  const Eigen::Vector3d strain{1e-4, -2e-4, 3e-4};
  const Mesh mesh = block_mesh(block(Shape::mixed));
  const Material base = scene_r_material();
  const auto twice = [](const Vector2&) { return 2.0; };
  const auto found = find_inclusions(mesh, 1);
  const InterfaceForces forces(mesh, {base, graded(mesh, base, twice, twice)}, 1, found);
  const Eigen::Vector3d stress = 2 * base.stiffness * strain;
  std::vector<Vector2> u;
  for (const Vector2& x : mesh.nodes.position)
    u.push_back({strain[0] * x[0] + 0.5 * strain[2] * x[1], strain[1] * x[1] + 0.5 * strain[2] * x[0]});
  for (std::size_t k = 0; k < forces.rows().size(); ++k) {
    const InterfaceNode& node = found.inclusions.interface[forces.rows()[k]];
    const Vector2& n = node.normal;
    const double t[2] = {stress[0] * n[0] + stress[2] * n[1], stress[2] * n[0] + stress[1] * n[1]};
    EXPECT_NEAR(tractions(node, forces.internal(k, u.data()))[0], t[0] * n[0] + t[1] * n[1],
                1e-9 * stress.norm());
  }
}

/// A step that was kept for another row than the next is as good as none: a restart may change the rows.
TEST(InterfaceForces, TakeNoStepForTheOneBeforeThatIsNot) {
  const Mesh mesh = block_mesh(block(Shape::triangles));
  const Model model(mesh, materials(), Model::Storage::full);
  Scene scene = shaken();
  scene.damping = {0, 2e-9};
  SlidingBody body(
      PETSC_COMM_WORLD, model, scene,
      0.8 * stable_step(largest_frequency(PETSC_COMM_WORLD, model).sharp, scene.beta2, scene.damping));
  InterfaceRecord stale(body, {"inclusion", {}}), none(body, {"inclusion", {}});
  for (int n = 0; n < 300; ++n) body.advance(n == 100);
  stale.keep_past();
  for (int n = 0; n < 5; ++n) body.advance(true);
  const auto one = stale.forces(), other = none.forces();
  EXPECT_EQ(one, other);
}

TEST(InterfaceChoice, DoubtsAMatrix) {
  const Mesh mesh = block_mesh(block(Shape::triangles));
  EXPECT_EQ(doubt_about("inclusion", find_inclusions(mesh, 1).inclusions), "");
  EXPECT_NE(doubt_about("matrix", find_inclusions(mesh, 0).inclusions)
                .find("-interfaces_region matrix: 1 of the 1 inclusions that it makes lies around"),
            std::string::npos);
}

/// One node, rows without end: a peak where it is, and no more in the .xdmf than a reader can hold.
TEST(InterfacesFile, OfOneNodeAndManyRows) {
  const std::string folder = scratch("interfaces");
  if (!is_root(PETSC_COMM_WORLD)) return;
  Inclusions one;
  one.centre = {{0, 0}};
  one.area = {1};
  one.outer = {0};
  InterfaceNode node{0, 7, {1, 0}, {1, 0}, 2, 0, false};
  one.interface = {node};
  constexpr int rows = 10001;
  InterfacesFile file(folder + ".h5", one, {"fibre", {}}, {""}, rows);
  for (int n = 0; n < rows; ++n) file.write(n, {{{n == 5000 ? 6.0 : 2.0, -4}}});
  EXPECT_EQ(file.headline().find(
                "inclusion 0 is pulled hardest: 3 Pa at x = 1 m, y = 0 m (0.0 degrees), t = 5000 s"),
            0u)
      << file.headline();
  EXPECT_EQ(file.peaks()[0][0].shear.value, 2);
  const std::string shown = file.xdmf("interfaces.h5");
  int times = 0;
  for (auto at = shown.find("<Time"); at != std::string::npos; at = shown.find("<Time", at + 1)) ++times;
  EXPECT_EQ(times, 5001);
  file.series().close();
}
