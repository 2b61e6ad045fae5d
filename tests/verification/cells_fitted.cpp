#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "cells_checks.hpp"
#include "cells_composite.hpp"
#include "report.hpp"

using namespace slipscale;
using namespace slipscale::testing_support;

/// C11 of the square array of discs, f = .4, 30/80 GPa, ν = .3: 56.954383132 GPa by disc_arrays.py.
/// Squares fitted to the interface with its area come to it from above, with h² and 1.7e-4, 4.2e-5, 1.0e-5 at
/// 32, 64, 128 of them across the cell.
TEST(FittedGrid, ConvergesToTheReference) {
  constexpr double expected = 56.954383132e9;
  const std::array<double, 3> bound{2e-4, 5e-5, 1.25e-5};
  std::array<double, 3> error{};
  for (int k = 0; k < 3; ++k) {
    const Mesh mesh = drawn_mesh(disc_array(Arrangement::square, 0.4, 32 << k, CellShape::grid));
    const CellSolution solution =
        solve(mesh, two_materials(mesh, isotropic(30e9, 0.3, 1), isotropic(80e9, 0.3, 1)));
    error[k] = 0.5 * (solution.stiffness(0, 0) + solution.stiffness(1, 1)) / expected - 1;
    EXPECT_GT(error[k], 0);
    EXPECT_LE(error[k], bound[k]) << (32 << k) << " squares across";
  }
  const double order = 0.5 * std::log2(error[0] / error[2]);
  EXPECT_NEAR(order, 2, 0.15);
  report({"Square array of discs, f .4, on the fitted grid",
          "C11 at 32; 64; 128 squares across, relative error", "< 2e-4; 5e-5; 1.25e-5",
          format("{:.2g}; {:.2g}; {:.2g}", error[0], error[1], error[2]), format("{:.2f}", order),
          "complex potentials, disc_arrays.py"});
}
