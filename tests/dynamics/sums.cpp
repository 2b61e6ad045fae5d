#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "graded.hpp"
#include "report.hpp"
#include "scenes.hpp"
#include "slipscale/base/order_free_sum.hpp"
#include "slipscale/base/print.hpp"
#include "slipscale/solid/element.hpp"

using namespace slipscale;
using namespace slipscale::testing_support;

// Where the work goes: sums over every step at the contact nodes and in the cells, against the energy ledger,
// and against what a test that looks at every step finds by itself.

namespace {

using Law = FrictionChoice::Law;

Block block(Shape shape) {
  Block b;
  b.nx = b.ny = 8;
  b.width = b.height = 5e-3;
  b.shape = shape;
  b.distortion = 0.1;
  b.region = [](double x, double y) { return std::hypot(x - 2.5e-3, y - 1e-3) < 1.2e-3 ? 2 : 1; };
  return b;
}

std::vector<Material> materials() { return {scene_r_material(), isotropic(200e9, 0.2, 4000)}; }

/// Traction, gravity, a side held along x, an initial velocity and gap.
Scene landing() {
  Scene scene = scene_r();
  scene.conditions = {{"top", {}, 15e6, -2e6, 10e-6}, {"left", {0.0, std::nullopt}, 1e6, 5e5, 5e-6}};
  scene.body_acceleration = {-2e4, -1e5};
  scene.initial.velocity = {0.2, -0.5};
  scene.initial.gap = 2e-7;
  return scene;
}

Scene rigid_top() {
  Scene scene = scene_r();
  scene.conditions[0].displacement[1].reset();
  scene.conditions[0].straight = BoundaryCondition::Straight::tilting;
  scene.conditions[0].plate_force = -7e4;
  scene.conditions[0].plate_mass = 2e-3;
  return scene;
}

double step_of(const Model& model, const Scene& scene) {
  return 0.8 * stable_step(largest_frequency(PETSC_COMM_WORLD, model).sharp, scene.beta2, scene.damping);
}

double sum_of(const std::vector<double>& terms) {
  return order_free_sums(PETSC_COMM_WORLD, {terms}, 1000000)[0];
}

/// What a test that looks at every step finds at the contact nodes.
struct Followed {
  std::vector<ContactTotals> totals;
  std::vector<char> closed;

  explicit Followed(int nodes) : totals(nodes), closed(nodes, 0) {}

  /// After step n, of which u_{n+1} is known.
  void add(const SlidingBody& body) {
    const ContactNodes& contact = body.contact();
    for (int k = 0; k < contact.size(); ++k) {
      ContactTotals& t = totals[k];
      const bool now = contact.status[k] != ContactStatus::open;
      if (now) {
        const double moved =
            body.next_displacement()[contact.node[k]][0] - body.displacement_n()[contact.node[k]][0];
        const double slip = contact.status[k] == ContactStatus::slip || contact.held[k]
                                ? std::abs(body.surface_travel() - moved)
                                : 0;
        t.slip += slip;
        t.pressure_slip += contact.pressure[k] * slip;
        t.time_closed += body.time_step();
        t.impulse += contact.pressure[k] * body.time_step();
        if (!closed[k]) t.closures += 1;
      }
      closed[k] = now;
    }
  }
};

}  // namespace

TEST(ContactSums, AreWhatEveryStepAddsAndAddUpToTheLedger) {
  const Mesh mesh = block_mesh(block(Shape::mixed));
  const Model model(mesh, materials(), Model::Storage::full);
  double worst = 0;
  int runs = 0;
  long bounces = 0;
  for (const Scene& base : {scene_r(), landing(), rigid_top()})
    for (const FrictionChoice& friction :
         {FrictionChoice{Law::coulomb, 0.5, false, false, 0, 0, 0},
          FrictionChoice{Law::regularized, 0.5, false, true, 0.6e-6, 0, 0},
          FrictionChoice{Law::regularized, 0.5, true, false, 0, 1.2e-6, 0.1}})
      for (const double beta2 : {0.5, 0.8}) {
        Scene scene = base;
        scene.friction = friction;
        scene.beta2 = beta2;
        SlidingBody body(PETSC_COMM_WORLD, model, scene, step_of(model, scene));
        body.keep_contact_sums();
        Followed followed(body.contact().size());
        constexpr int steps = 1200;
        for (int n = 0; n < steps; ++n) {
          body.advance(Observed::boundary);
          followed.add(body);
        }
        body.advance(Observed::everything);
        const Energy energy = body.energy();
        const ContactNodes& contact = body.contact();
        std::vector<double> heat, impact, closures;
        for (int k = 0; k < contact.size(); ++k) {
          const ContactTotals found = body.contact_totals(k), &expected = followed.totals[k];
          heat.push_back(found.friction_work * contact.tributary_length[k]);
          impact.push_back(found.impact_loss * contact.tributary_length[k]);
          closures.push_back(found.closures);
          for (const auto member : {&ContactTotals::slip, &ContactTotals::pressure_slip,
                                    &ContactTotals::time_closed, &ContactTotals::impulse}) {
            ASSERT_NEAR(found.*member, expected.*member, 1e-11 * std::abs(expected.*member));
          }
          ASSERT_EQ(found.closures, expected.closures);
        }
        const double error = worse(std::abs(sum_of(heat) - energy.friction_heat),
                                   std::abs(sum_of(impact) - energy.impact_loss)) /
                             energy.flowed;
        EXPECT_GT(energy.friction_heat, 0.01 * energy.flowed);
        EXPECT_LE(error, 1e-14);
        bounces = std::max(bounces, std::lround(sum_of(closures)));
        worst = worse(worst, error);
        ++runs;
      }
  EXPECT_GT(bounces, 50) << "nodes open and close again";
  report({"Contact sums over every step: three scenes, three laws, two beta2",
          format("friction work and impact loss of the nodes against the ledger's, over what flowed, {} runs",
                 runs),
          "<= 1e-14", shown_error(worst, 1e-14), "", "rounding"});
}

TEST(ContactSums, OfSteadySlidingAreThoseOfARigidBody) {
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
  scene.surface = Surface{"bottom", 0, -3, 0};
  scene.initial.shear = -5e-4;
  scene.friction = {Law::regularized, 0.5, false, false, 0.1, 0, 0};
  SlidingBody body(PETSC_COMM_WORLD, model, scene, 0.02);
  body.keep_contact_sums();
  for (int n = 0; n < 101; ++n) body.advance(n == 100);
  for (int k = 0; k < body.contact().size(); ++k) {
    const ContactTotals found = body.contact_totals(k);
    EXPECT_NEAR(found.slip, 6, 1e-11);
    EXPECT_NEAR(found.pressure_slip / 6e-3, 1, 1e-11);
    EXPECT_NEAR(found.friction_work / 3e-3, 1, 1e-11);
    EXPECT_NEAR(found.impulse / 2e-3, 1, 1e-11);
    EXPECT_NEAR(found.time_closed, 2, 1e-12);
    EXPECT_EQ(found.closures, 1);
  }
}

TEST(CellDamping, AddsUpToTheLedger) {
  double worst = 0;
  int runs = 0;
  for (const Shape shape : {Shape::triangles, Shape::quadrilaterals, Shape::mixed}) {
    const Mesh mesh = block_mesh(block(shape));
    const Model model(mesh, materials(), Model::Storage::full);
    for (const Scene& base : {scene_r(), landing(), rigid_top()})
      for (const double beta2 : {0.5, 0.8, 1.0})
        for (const Damping& damping : {Damping{2e4, 0}, Damping{0, 2e-9}, Damping{2e4, 2e-9}}) {
          Scene scene = base;
          scene.beta2 = beta2;
          scene.damping = damping;
          SlidingBody body(PETSC_COMM_WORLD, model, scene, step_of(model, scene));
          body.keep_cell_damping();
          for (int n = 0; n < 600; ++n) body.advance(n == 599);
          std::vector<double> density, works;
          body.cell_damping(density);
          for (int cell = 0; cell < mesh.cells.size(); ++cell) {
            double area = 0;
            for (const double part : corner_areas(mesh.cells.corners_of(cell))) area += part;
            if (!mesh.cells.owned[cell]) {
              EXPECT_EQ(density[cell], 0);
            }
            works.push_back(density[cell] * area);
          }
          const double expected = body.energy().damping, error = std::abs(sum_of(works) / expected - 1);
          EXPECT_GT(expected, 0);
          EXPECT_LE(error, 1e-11) << "beta2 " << beta2 << ", a " << damping.mass << ", b "
                                  << damping.stiffness;
          worst = worse(worst, error);
          ++runs;
        }
  }
  report({"Bulk damping cell by cell: three scenes, P1, Q1 and mixed, three beta2, both dampings",
          format("sum over the cells over the ledger's row, less one, {} runs", runs), "<= 1e-11",
          shown_error(worst, 1e-11), "", "rounding"});
}

/// Of triangles, b/Δt A Δε:C:½(Δε + Δε of the step before), by hand from the states of every step.
TEST(CellDamping, OfATriangleIsThatOfItsStrain) {
  const Mesh mesh = block_mesh(block(Shape::triangles));
  const auto solids = materials();
  const Model model(mesh, solids, Model::Storage::full);
  Scene scene = landing();
  scene.conditions[1].displacement[0].reset();  // free, so that it starts as one
  scene.damping = {0, 2e-9};
  const double step = step_of(model, scene);
  SlidingBody body(PETSC_COMM_WORLD, model, scene, step);
  body.keep_cell_damping();
  const std::size_t nodes = mesh.nodes.number.size();
  const Vector2* const u = body.displacement_n();
  std::vector<Vector2> past(nodes);
  std::vector<double> expected(static_cast<std::size_t>(mesh.cells.size()), 0);
  std::vector<Eigen::Vector3d> before(expected.size(), Eigen::Vector3d::Zero());
  for (int n = 0; n < 300; ++n) {
    body.advance(Observed::everything);
    // With the initial velocity all over: no strain in the step before the first.
    for (int cell = 0; n > 0 && cell < mesh.cells.size(); ++cell) {
      const auto b = centre_strain_displacement(mesh.cells.corners_of(cell));
      const auto of = mesh.cells.nodes_of(cell);
      Eigen::Vector3d strain = Eigen::Vector3d::Zero();
      for (int k = 0; k < 3; ++k)
        for (int axis = 0; axis < 2; ++axis)
          strain += b.col(2 * k + axis) * (u[of[k]][axis] - past[of[k]][axis]);
      const Eigen::Vector3d stress = solids[mesh.cells.region[cell]].stiffness * (strain + before[cell]);
      if (mesh.cells.owned[cell]) expected[cell] += scene.damping.stiffness / step * strain.dot(stress) / 2;
      before[cell] = strain;
    }
    std::copy_n(u, nodes, past.data());
  }
  std::vector<double> density;
  body.cell_damping(density);
  double largest = 0;
  for (const double value : expected) largest = std::max(largest, value);
  for (std::size_t cell = 0; cell < density.size(); ++cell)
    EXPECT_NEAR(density[cell], expected[cell], 1e-9 * largest);
}

/// A body that is strained everywhere at one rate, two of whose regions are graded: b Δt ε̇:C:ε̇ with the
/// stiffness of each cell, in the first step. Damping is so weak that it does not change the rate.
TEST(CellDamping, OfAGradedBodyIsThatOfEachCell) {
  const Eigen::Vector3d rate{3, -2, 4};  // 1/s
  for (const Shape shape : {Shape::triangles, Shape::quadrilaterals, Shape::mixed}) {
    const Mesh mesh = block_mesh(block(shape));
    const auto stiffer = [](const Vector2& x) { return 1 + 400 * x[0] + 100 * x[1]; };
    const auto heavier = [](const Vector2& x) { return 1 + 200 * x[1]; };
    std::vector<Material> solids;
    for (const Material& base : materials()) solids.push_back(graded(mesh, base, stiffer, heavier));
    const Model model(mesh, solids, Model::Storage::full);
    Scene scene;
    scene.damping = {0, 1e-16};
    auto fields = std::make_shared<InitialFields>();
    for (const Vector2& x : mesh.nodes.position) {
      fields->displacement.push_back({0, 0});
      fields->velocity.push_back(
          {rate[0] * x[0] + 0.5 * rate[2] * x[1], rate[1] * x[1] + 0.5 * rate[2] * x[0]});
    }
    scene.initial.fields = fields;
    const double step = step_of(model, scene);
    SlidingBody body(PETSC_COMM_WORLD, model, scene, step);
    body.keep_cell_damping();
    for (int n = 0; n < 2; ++n) body.advance(Observed::everything);
    std::vector<double> density;
    body.cell_damping(density);
    for (int cell = 0; cell < mesh.cells.size(); ++cell) {
      if (!mesh.cells.owned[cell]) continue;
      const Eigen::Matrix3d c = solids[mesh.cells.region[cell]].at(cell).stiffness;
      EXPECT_NEAR(density[cell] / (scene.damping.stiffness * step * rate.dot(c * rate)), 1, 1e-6);
    }
  }
}
