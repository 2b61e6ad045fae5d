#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "report.hpp"
#include "scenes.hpp"
#include "slipscale/base/print.hpp"

using namespace slipscale;
using namespace slipscale::testing_support;

namespace {

using Straight = BoundaryCondition::Straight;

constexpr double width = 2, height = 1.5;

Block uneven() {
  Block block;
  block.nx = 6;
  block.ny = 5;
  block.width = width;
  block.height = height;
  block.shape = Shape::mixed;
  block.distortion = 0.2;
  block.region = [](double x, double) { return x > 1.2 ? 2 : 1; };
  return block;
}

std::vector<Material> materials() { return {isotropic(1, 0.3, 1), isotropic(4, 0.2, 2)}; }

/// `force` along +y.
BoundaryCondition plate(Straight straight, double force, double mass, double ramp = 0) {
  BoundaryCondition condition;
  condition.boundary = "top";
  condition.straight = straight;
  condition.plate_force = force;
  condition.plate_mass = mass;
  condition.ramp = ramp;
  return condition;
}

/// Of the plate on the top: displacement, velocity and tilt of the rank that holds nodes of it, on all ranks.
PlateMotion known_everywhere(const SlidingBody& body, const PlateMotion& motion) {
  const bool holds = !body.model().mesh.find_boundary("top")->nodes.empty();
  PlateMotion found = holds ? motion : PlateMotion{-HUGE_VAL, -HUGE_VAL};
  MPI_Allreduce(MPI_IN_PLACE, found.data(), 2, MPI_DOUBLE, MPI_MAX, body.comm());
  return found;
}

PlateMotion velocity_of_plate(const SlidingBody& body) {
  return known_everywhere(body, (*body.straight_sides().begin())->velocity());
}

/// A landing under a plate, in SI units: contact, friction, both dampings, gravity, a shear along the plate.
Scene landing(Straight straight) {
  Scene scene = scene_r();
  scene.conditions = {plate(straight, -15e6 * 5e-3, 0.02, 2e-6)};
  scene.conditions[0].shear = -1e6;
  scene.initial.velocity = {0.2, -0.5};
  scene.initial.rotation = 20;
  scene.initial.gap = 2e-7;
  scene.damping = {1e3, 2e-9};
  scene.beta2 = 0.55;
  scene.body_acceleration = {10, -1e4};
  return scene;
}

Block small_block() {
  Block block;
  block.nx = block.ny = 10;
  block.width = block.height = 5e-3;
  block.shape = Shape::mixed;
  block.distortion = 0.1;
  block.region = [](double x, double) { return x > 3e-3 ? 2 : 1; };
  return block;
}

std::vector<Material> hard_materials() { return {scene_r_material(), isotropic(80e9, 0.2, 2500)}; }

}  // namespace

/// At rest the foot carries the force, and a uniform body held at its sides is compressed by F H/(C22 W).
TEST(StraightSides, ForceIsCarriedInEquilibrium) {
  Block block = uneven();
  block.region = [](double, double) { return 1; };
  const Mesh mesh = block_mesh(block);
  const Material material = isotropic(1, 0.3, 1);
  const Model model(mesh, {material}, Model::Storage::full);
  constexpr double force = 1e-3;
  Scene scene;
  scene.conditions = {{"bottom", {std::nullopt, 0.0}, 0, 0, 0},
                      {"left", {0.0, std::nullopt}, 0, 0, 0},
                      {"right", {0.0, std::nullopt}, 0, 0, 0},
                      plate(Straight::rigid, -force, 3)};
  scene.damping.mass = 2;
  SlidingBody body(PETSC_COMM_WORLD, model, scene, 0.05);
  for (int n = 0; n <= 6000; ++n) body.advance(n == 6000);
  const double expected = -force * height / (material.c22() * width);
  double worst = 0;
  for (int i : mesh.find_boundary("top")->nodes)
    worst = worse(worst, std::abs(body.displacement_n()[i][1] / expected - 1));
  worst = largest_of_ranks(worst);
  const double foot = std::abs(support_force(body, "bottom")[1] / -force - 1),
               work = std::abs(body.energy().loads / (-force * expected) - 1);
  EXPECT_LT(worst, 1e-10);
  EXPECT_LT(foot, 1e-10);
  EXPECT_LT(work, 1e-10);
  report({"Straight side under a force F, at rest on a body held at its other sides",
          "relative error of u_y = F H/(C22 W); of the force at the foot; of the work of F",
          "<= 1e-10; 1e-10; 1e-10",
          shown_error(worst, 1e-11) + "; " + shown_error(foot, 1e-11) + "; " + shown_error(work, 1e-11), "",
          "exact solution"});
}

/// Nothing holds body and plate: together they gain F t along y, and where the plate may tilt no angular
/// momentum, because the force points at the middle. All nodes of the side stay on one line.
TEST(StraightSides, FreeFlightGainsTheImpulseOfTheForce) {
  const Mesh mesh = block_mesh(uneven());
  const Model model(mesh, materials(), Model::Storage::full);
  constexpr double force = -0.01;
  double of_impulse = 0, of_angular = 0, of_line = 0;
  for (const Straight straight : {Straight::rigid, Straight::tilting})
    for (const double mass : {0.0, 5.0}) {
      Scene scene;
      scene.conditions = {plate(straight, force, mass)};
      SlidingBody body(PETSC_COMM_WORLD, model, scene, 0.05);
      for (int n = 0; n <= 400; ++n) body.advance(n == 400);
      const Momentum momentum = body.momentum();
      const PlateMotion v = velocity_of_plate(body);
      EXPECT_NEAR(momentum.mass, mesh.regions[0].area + 2 * mesh.regions[1].area, 1e-13);
      EXPECT_NEAR(momentum.linear[0], 0, 1e-13);
      of_impulse =
          worse(of_impulse, std::abs((momentum.linear[1] + mass * v[0]) / (force * body.time()) - 1));
      if (straight == Straight::tilting) {
        EXPECT_GT(std::abs(v[1]), 1e-4) << "the uneven body should have turned";
        of_angular = worse(of_angular, std::abs(momentum.angular + mass * width * width / 12 * v[1]));
      } else {
        EXPECT_EQ(v[1], 0);
      }
      const PlateMotion u = known_everywhere(body, (*body.straight_sides().begin())->displacement());
      for (int i : mesh.find_boundary("top")->nodes)
        of_line = worse(of_line, std::abs(body.displacement_n()[i][1] - u[0] -
                                          u[1] * (mesh.nodes.position[i][0] - width / 2)));
    }
  of_line = largest_of_ranks(of_line);
  EXPECT_LT(of_impulse, 1e-11);
  EXPECT_LT(of_angular, 1e-13);
  EXPECT_LT(of_line, 1e-15);
  report({"Straight side of a free uneven body, rigid and tilting, with and without mass",
          "relative error of the momentum F t; angular momentum, kg m/s; distance of nodes from a line, m",
          "<= 1e-11; 1e-13; 1e-15",
          shown_error(of_impulse, 1e-11) + "; " + shown_error(of_angular, 1e-13) + "; " +
              shown_error(of_line, 1e-15),
          "", "conservation of momentum"});
}

/// A plate on a column held at its sides is a chain of ny springs C22 W/h with masses ρWh and, at its end,
/// the plate's and half a cell's: under a force applied at once its modes k swing as
/// (1 − cos ω'nΔt)/ω² with sin(ω'Δt/2) = ωΔt/2, exactly so for central difference.
TEST(StraightSides, MassOnAColumnSwingsAsItsModesDo) {
  constexpr int n_cells = 8;
  constexpr double density = 1.3, mass = 4, force = -0.02, dt = 0.04;
  Block block;
  block.nx = 3;
  block.ny = n_cells;
  block.width = width;
  block.height = height;
  block.shape = Shape::quadrilaterals;
  const Mesh mesh = block_mesh(block);
  const Material material = isotropic(1, 0.3, density);
  const Model model(mesh, {material}, Model::Storage::full);
  Scene scene;
  scene.conditions = {{"bottom", {std::nullopt, 0.0}, 0, 0, 0},
                      {"left", {0.0, std::nullopt}, 0, 0, 0},
                      {"right", {0.0, std::nullopt}, 0, 0, 0},
                      plate(Straight::rigid, force, mass)};

  const double spring = material.c22() * width / (height / n_cells),
               cell = density * width * height / n_cells;
  Eigen::MatrixXd k = Eigen::MatrixXd::Zero(n_cells, n_cells), m = Eigen::MatrixXd::Zero(n_cells, n_cells);
  for (int i = 0; i < n_cells; ++i) {
    k(i, i) = i + 1 < n_cells ? 2 * spring : spring;
    m(i, i) = i + 1 < n_cells ? cell : 0.5 * cell + mass;
    if (i > 0) k(i, i - 1) = k(i - 1, i) = -spring;
  }
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> modes(k, m);
  const auto top = [&](int n) {
    double u = 0;
    for (int q = 0; q < n_cells; ++q) {
      const double omega = std::sqrt(modes.eigenvalues()[q]), shape = modes.eigenvectors()(n_cells - 1, q);
      const double turns = 2 * std::asin(0.5 * omega * dt) * n;
      u += shape * shape * force * (1 - std::cos(turns)) / (omega * omega);
    }
    return u;
  };

  SlidingBody body(PETSC_COMM_WORLD, model, scene, dt);
  double largest = 0, worst = 0;
  for (int n = 0; n <= 2000; ++n) {
    body.advance(true);
    largest = std::max(largest, std::abs(top(n)));
    for (int i : mesh.find_boundary("top")->nodes)
      worst = worse(worst, std::abs(body.displacement_n()[i][1] - top(n)));
  }
  worst = largest_of_ranks(worst);
  EXPECT_LT(worst, 1e-10 * largest);
  report({"Plate with mass on a column, force applied at once", "largest relative error of u over 2000 steps",
          "<= 1e-10", shown_error(worst / largest, 1e-10), "",
          "modes of a chain of springs under central difference, in the test"});
}

/// The ledger closes to rounding with the plate's mass in it, whatever the scheme and the damping.
TEST(StraightSides, EnergyBalanceCloses) {
  const Mesh mesh = block_mesh(small_block());
  const Model model(mesh, hard_materials(), Model::Storage::full);
  for (const Straight straight : {Straight::rigid, Straight::tilting})
    for (const double beta2 : {0.5, 0.6, 1.0}) {
      Scene scene = landing(straight);
      scene.beta2 = beta2;
      SlidingBody body(PETSC_COMM_WORLD, model, scene, 1e-8);
      double worst = 0;
      Energy energy;
      for (int n = 1; n <= 1500; ++n) {
        body.advance(n % 25 == 0);
        if (n % 25 != 0) continue;
        energy = body.energy();
        worst = worse(worst, std::abs(energy.residual) / energy.flowed);
      }
      EXPECT_LT(worst, 1e-12) << "beta2 " << beta2;
      EXPECT_GT(std::abs(energy.loads), 1e-3 * energy.flowed);
      EXPECT_GT(energy.friction_heat, 0);
    }
}

TEST(StraightSides, SameBitsOnAnyNumberOfRanks) {
  const std::string path = scratch("straight.msh");
  write_block(small_block(), path);
  for (const Straight straight : {Straight::rigid, Straight::tilting}) {
    Simulation alone(PETSC_COMM_SELF, {path}, hard_materials(), landing(straight), 1e-8);
    Simulation together(PETSC_COMM_WORLD, {path}, hard_materials(), landing(straight), 1e-8);
    for (int n = 0; n < 1500; ++n) alone.body.advance(false), together.body.advance(false);
    const auto one = whole_field(PETSC_COMM_SELF, alone.mesh, alone.body.next_displacement());
    const auto all = whole_field(PETSC_COMM_WORLD, together.mesh, together.body.next_displacement());
    long different = 0;
    for (std::size_t i = 0; i < one.size(); ++i)
      for (int axis = 0; axis < 2; ++axis)
        different += std::bit_cast<std::uint64_t>(one[i][axis]) != std::bit_cast<std::uint64_t>(all[i][axis]);
    EXPECT_EQ(different, 0);
  }
}

/// What cannot be straight as well: a side whose end is prescribed along y, and one that touches the surface.
TEST(StraightSides, RefuseNodesThatOthersHold) {
  const Mesh mesh = block_mesh(uneven());
  const Model model(mesh, materials(), Model::Storage::full);
  const auto refusal = [&](const Scene& scene) -> std::string {
    try {
      SlidingBody(PETSC_COMM_WORLD, model, scene, 1e-3);
    } catch (const UserError& error) {
      return error.what();
    }
    return "";
  };
  Scene scene;
  scene.conditions = {plate(Straight::rigid, 1, 0), {"left", {std::nullopt, 0.0}, 0, 0, 0}};
  EXPECT_NE(refusal(scene).find("prescribes the motion along y"), std::string::npos) << refusal(scene);
  scene.conditions = {plate(Straight::rigid, 1, 0)};
  scene.conditions[0].boundary = "left";
  scene.surface = Surface{"bottom", 0, 1, 0};
  EXPECT_NE(refusal(scene).find("meets the surface"), std::string::npos) << refusal(scene);
}
