// One degree of freedom, m = k = 1, dragged by a coefficient that falls with the slip rate:
//     ẍ + x = s,   ṡ = −(s − μ(V − ẋ) p)/T in slip
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <complex>

#include "friction_column.hpp"
#include "report.hpp"
#include "slipscale/base/print.hpp"

using namespace slipscale;
using namespace slipscale::testing_support;

namespace {

constexpr double memory = 0.3, still = column_friction * column_pressure, kinetic = 0.2 * column_pressure;

double strength(double slip) { return kinetic + (still - kinetic) * std::exp(-slip); }  // V_c = 1 m/s

/// Growth and frequency of steady sliding at V: (1 + pT)(p² + 1) − d p = 0 with d = −dμp/dv.
std::complex<double> exact_exponent(double speed) {
  const double falls = (still - kinetic) * std::exp(-speed);
  Eigen::Matrix3d companion;
  companion << -1 / memory, -1 + falls / memory, -1 / memory, 1, 0, 0, 0, 1, 0;
  const Eigen::Vector3cd roots = companion.eigenvalues();
  return *std::ranges::max_element(roots, {}, [](const std::complex<double>& p) { return p.imag(); });
}

/// The same of a run that starts next to it: of three readings a quarter of a period apart,
/// x_{n+1} = 2 Re z x_n − |z|² x_{n−1}, once the third root has died away.
std::complex<double> found_exponent(double speed, double step) {
  Column column{falling_friction(memory), speed, 0, 1e-8, 0, false};
  column.shear = strength(speed);
  const auto quarter = std::lround(1.5 / step);
  const auto readings = run_column(column, step, 14 * quarter);
  Eigen::MatrixXd left(8, 2);
  Eigen::VectorXd right(8);
  const auto moved = [&](long n) {
    return readings[static_cast<std::size_t>(n * quarter)].displacement - strength(speed);
  };
  for (int k = 0; k < 8; ++k) {
    left.row(k) << moved(k + 5), moved(k + 4);
    right[k] = moved(k + 6);
  }
  const Eigen::Vector2d found = left.colPivHouseholderQr().solve(right);
  const std::complex<double> z(found[0] / 2, std::sqrt(-found[1] - found[0] * found[0] / 4));
  return std::log(z) / (static_cast<double>(quarter) * step);
}

struct Cycle {
  double swing, period;
};

/// Of the last part of a path of readings `step` apart.
Cycle cycle_of(const std::vector<double>& path, double step) {
  const std::vector<double> last(path.begin() + static_cast<long>(path.size()) / 3, path.end());
  const auto [low, high] = std::ranges::minmax_element(last);
  const double middle = 0.5 * (*low + *high);
  std::vector<double> rises;
  for (std::size_t k = 1; k < last.size(); ++k)
    if (last[k - 1] < middle && last[k] >= middle)
      rises.push_back(step * (static_cast<double>(k) + (middle - last[k]) / (last[k] - last[k - 1])));
  return {*high - *low, (rises.back() - rises.front()) / static_cast<double>(rises.size() - 1)};
}

}  // namespace

TEST(FallingFriction, LetsSteadySlidingGrow) {
  for (const double speed : {0.5, 1.5}) {
    const auto expected = exact_exponent(speed), fine = found_exponent(speed, 5e-3),
               coarse = found_exponent(speed, 1e-2);
    EXPECT_GT(expected.real(), 0.03);
    EXPECT_LE(std::abs(fine - expected), 5e-5);
    const double order = std::log2(std::abs(coarse - expected) / std::abs(fine - expected));
    EXPECT_GT(order, 1.8) << speed;
    report({"One degree of freedom, m = k = 1, mu p from 1 to 0.4 over 1 m/s, T = 0.3 s, dt 5 ms",
            format("steady sliding at {:g} m/s: growth; frequency, 1/s", speed),
            format("{:.5f}; {:.5f} within 5e-5", expected.real(), expected.imag()),
            format("{:.5f}; {:.5f}", fine.real(), fine.imag()), format("{:.1f}", order),
            "root of (1 + pT)(p^2 + 1) = d p"});
  }
}

/// A memory that is long beside the period takes the falling branch away.
TEST(FallingFriction, IsTamedByItsMemory) {
  const double falls = (still - kinetic) * std::exp(-0.5);
  EXPECT_LT(exact_exponent(0.5).real(), falls / 2);
}

/// Slow: the mass sticks until the spring carries μ_s p, slips, and sticks again. A change between the two is
/// seen up to a step late.
TEST(FallingFriction, SticksAndSlips) {
  constexpr double end = 60, speed = 0.2;
  const Column column{falling_friction(memory), speed, 0, 0, 0, false};
  constexpr int count = 6000;
  const Cycle expected = cycle_of(oscillator_path(column, end, count), end / count);
  EXPECT_GT(expected.swing, 0.5);
  double errors[2];
  Cycle found{};
  for (const int halvings : {0, 1}) {
    const long steps = 12000L << halvings;
    std::vector<double> path;
    for (const ColumnReading& each : run_column(column, end / static_cast<double>(steps), steps))
      path.push_back(each.displacement);
    found = cycle_of(path, end / static_cast<double>(steps));
    errors[halvings] =
        std::max(std::abs(found.swing - expected.swing), std::abs(found.period - expected.period));
  }
  EXPECT_LE(errors[1], 5e-3);
  report({"One degree of freedom, m = k = 1, mu p from 1 to 0.4 over 1 m/s, T = 0.3 s, dt 2.5 ms",
          "stick and slip at 0.2 m/s: swing, m; period, s",
          format("{:.4f}; {:.4f} within 5e-3", expected.swing, expected.period),
          format("{:.4f}; {:.4f}", found.swing, found.period), "",
          "equations of stick and slip, Runge-Kutta"});
}
