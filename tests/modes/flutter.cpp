#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "slipscale/modes/modes_sweep.hpp"

using namespace slipscale;

namespace {

constexpr double apart = 0.1;  ///< of the two squared frequencies without friction

/// Two modes with ω² = 1 and 1 + d, 1/s², that friction couples one way and the other: the two frequencies
/// meet at μ = d/2, at ω² = 1 + d/2, and beyond it
///     p² = −(1 + d/2) ± i √(μ² − d²/4).
/// Without that coupling, but with a stiffness that friction takes from one, they cross and go on as they
/// came.
ReducedProblem two_modes(bool coupled) {
  ReducedProblem problem{Eigen::Matrix2d{{1, 0}, {0, 1 + apart}}, Eigen::Matrix2d{{0, 1}, {-1, 0}}};
  if (!coupled) problem.friction = Eigen::Matrix2d{{0, 0}, {0, 2}};
  return problem;
}

Complex grown(double coefficient) {
  const double square = coefficient * coefficient - apart * apart / 4;
  return std::sqrt(Complex(-(1 + apart / 2), -std::sqrt(square)));
}

/// The two followed by the solver of a sweep's points from μ = 0 on, each from where the last two point to;
/// past a meeting from both sides of it.
ModesSweep followed(bool coupled) {
  ModesSweep sweep;
  sweep.choice.name = "coefficient";
  for (int k = 0; k <= 50; ++k) sweep.choice.values.push_back(0.002 * k + 1e-4);
  const ReducedProblem problem = two_modes(coupled);
  for (const double square : {1.0, 1 + apart}) {
    ModePath path;
    Complex here{0, std::sqrt(square)}, before = here;
    Eigen::VectorXcd vector;
    for (const double value : sweep.choice.values) {
      SlidingLaw law;
      law.coefficient = value;
      const double beside = sweep.paths.empty() ? 1e-3 : -1e-3;  // of two conjugate ways each takes one
      const ReducedMode mode = nearest_mode(problem, law, 2.0 * here - before + beside, vector);
      before = here;
      here = mode.exponent;
      vector = mode.vector;
      path.exponent.push_back(here);
      path.residual.push_back(0);
    }
    sweep.paths.push_back(path);
  }
  find_events(sweep);
  return sweep;
}

}  // namespace

TEST(Flutter, TwoFrequenciesMergeWhereTheyMust) {
  const ModesSweep sweep = followed(true);
  for (std::size_t k = 0; k < sweep.choice.values.size(); ++k) {
    const double value = sweep.choice.values[k];
    if (value < apart / 2) continue;
    const Complex p = grown(value), expected{std::abs(p.real()), std::abs(p.imag())};
    const Complex one = sweep.paths[0].exponent[k], other = sweep.paths[1].exponent[k];
    EXPECT_LE(std::abs(Complex(std::abs(one.real()), one.imag()) - expected), 1e-10) << value;
    EXPECT_LE(std::abs(Complex(std::abs(other.real()), other.imag()) - expected), 1e-10) << value;
    EXPECT_LT(one.real() * other.real(), 0) << value;
  }
  ASSERT_EQ(sweep.couplings.size(), 1u);
  EXPECT_NEAR(sweep.couplings[0].value, apart / 2, 0.002);
  EXPECT_NEAR(sweep.couplings[0].frequency, std::sqrt(1 + apart / 2) / (2 * std::numbers::pi), 1e-4);
  ASSERT_EQ(sweep.limits.size(), 1u);
  EXPECT_NEAR(sweep.limits[0].value, apart / 2, 0.002);
  EXPECT_TRUE(sweep.limits[0].grows);
}

TEST(Flutter, TwoThatCrossDoNotCouple) {
  const ModesSweep sweep = followed(false);
  EXPECT_LT(sweep.paths[1].exponent.back().imag(), sweep.paths[0].exponent.back().imag());
  EXPECT_TRUE(sweep.couplings.empty());
  EXPECT_TRUE(sweep.limits.empty());
}
