#include <gtest/gtest.h>

#include <cmath>

#include "report.hpp"
#include "scenes.hpp"
#include "slipscale/base/print.hpp"

using namespace slipscale;
using namespace slipscale::testing_support;

namespace {

constexpr double relaxation_time = 0.1;

/// Bottom displacement of the slab H = c_s = G = 1 that a traction τ(t) = 1 − exp(−t/T) drags from t = 0: the
/// wave f(t − y) comes back from the fixed top as −f(t − 2 + y), so f'(t) = τ(t) − f'(t − 2) and u = f(t) −
/// f(t − 2).
double exact(double t) {
  const auto whole = [](double s) {  // ∫ τ
    return s <= 0 ? 0 : s - relaxation_time * -std::expm1(-s / relaxation_time);
  };
  return whole(t) - 2 * whole(t - 2);  // up to t = 4
}

struct Outcome {
  double error = 0;
  std::array<double, 3> at{};  ///< u(1), u(2), u(4)
};

/// A column that is periodic in x. With ν = 0 the pressure p0 = 2, μp0 = 1, stays uniform.
Outcome slab(int elements, double steps_per_crossing) {
  Block block;
  block.nx = 3;
  block.ny = elements;
  block.width = 0.15;
  block.shape = Shape::quadrilaterals;
  block.periodic_x = true;
  const std::string path = scratch("slab.msh");
  write_block(block, path);
  Scene scene;
  scene.conditions = {{"top", {0.0, std::nullopt}, 2, 0, 0}};
  scene.initial.pressure = 2;
  scene.surface = Surface{"bottom", 0, 5, 0};
  scene.friction = {FrictionChoice::Law::regularized, 0.5, false, false, relaxation_time, 0, 0};
  const double dt = 1 / steps_per_crossing;
  Simulation simulation(PETSC_COMM_WORLD, {path}, {isotropic(2, 0, 1)}, scene, dt);
  Outcome outcome;
  double largest = 0;
  for (long n = 1; n <= std::lround(4 * steps_per_crossing); ++n) {
    simulation.body.advance(false);  // leaves u_n, n = 1, 2, …
    for (int i : simulation.body.contact().node)
      largest = std::max(
          largest, std::abs(simulation.body.next_displacement()[i][0] - exact(static_cast<double>(n) * dt)));
    for (int k = 0; k < 3; ++k)
      if (n == std::lround((k == 2 ? 4 : k + 1) * steps_per_crossing))
        outcome.at[k] =
            value_near(simulation.mesh, simulation.body.next_displacement(), {block.width / 3, 0}, 0);
  }
  MPI_Allreduce(&largest, &outcome.error, 1, MPI_DOUBLE, MPI_MAX, PETSC_COMM_WORLD);
  return outcome;
}

}  // namespace

TEST(ShearSlab, ExactSolutionHasTheQuotedValues) {
  EXPECT_NEAR(exact(1), 0.900005, 5e-7);
  EXPECT_NEAR(exact(2), 1.9, 5e-7);
  EXPECT_NEAR(exact(4), 0.1, 5e-7);
}

/// The kinks of the exact velocity, where the wave comes back, are smoothed over a few elements: hence the
/// order 1.2 and not 2, and the bounds 4e-3 at 100 elements and 1.8e-3 at 200.
TEST(ShearSlab, AgreesWithTheExactSolution) {
  for (const double part : {0.5, 0.6, 0.69}) {
    const Outcome coarse = slab(100, std::floor(100 / part)), fine = slab(200, std::floor(200 / part));
    const double order = std::log2(coarse.error / fine.error);
    EXPECT_LE(coarse.error, 4e-3) << "step " << part;
    EXPECT_LE(fine.error, 1.8e-3) << "step " << part;
    EXPECT_GE(order, 1.1) << "step " << part;
    report({"Shear slab dragged by friction",
            format("largest error of u, m, 100; 200 elements, dt {:.2f} h/c_s", part),
            "<= 4e-3; 1.8e-3, order >= 1.1", format("{:.2e}; {:.2e}", coarse.error, fine.error),
            format("{:.2f}", order), "exact solution"});
    if (part == 0.5)
      report({"Shear slab dragged by friction", "u(1); u(2); u(4), m, 200 elements, dt 0.50 h/c_s",
              "0.900005; 1.900000; 0.100000",
              format("{:.6f}; {:.6f}; {:.6f}", fine.at[0], fine.at[1], fine.at[2]), "", "exact solution"});
    for (const Outcome& outcome : {coarse, fine}) {
      EXPECT_NEAR(outcome.at[0], 0.900005, outcome.error);
      EXPECT_NEAR(outcome.at[1], 1.9, outcome.error);
      EXPECT_NEAR(outcome.at[2], 0.1, outcome.error);
    }
  }
}
