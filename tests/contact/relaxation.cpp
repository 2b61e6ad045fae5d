#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "report.hpp"
#include "slipscale/contact/friction.hpp"

using namespace slipscale;
using namespace slipscale::testing_support;

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

struct Exact {
  long double keep, now, before;
};

/// e = exp(−x), 1 − g and g − e with g = (1 − e)/x in extended precision; Taylor series where these cancel.
Exact exact_weights(long double x) {
  const long double e = std::exp(-x);
  if (x > 1) {
    const long double g = (1 - e) / x;
    return {e, 1 - g, g - e};
  }
  Exact sum{e, 0, 0};
  long double power = 1;  // (−x)^k / (k+1)!
  for (int k = 1; k < 40; ++k) {
    power *= -x / static_cast<long double>(k + 1);
    sum.now -= power;
    sum.before -= static_cast<long double>(k) * power;
  }
  return sum;
}

/// Largest difference over one period, after the transient is gone by construction, between the relaxed
/// strength and the steady solution μp0 (1 + ε sin(ωt − atan ωT)/√(1+ω²T²)); also gain and lag by projection.
struct Response {
  double error, gain, lag;
};

template <class Law>
Response response(double omega, double time, int steps) {
  constexpr double mu = 0.4, p0 = 3, epsilon = 0.2, far = 1e30;
  const double gain = 1 / std::hypot(1, omega * time), lag = std::atan(omega * time);
  const double period = 2 * std::numbers::pi / omega, dt = period / steps;
  const Law law{mu, relaxation(dt / time)};
  const auto pressure = [&](double t) { return p0 * (1 + epsilon * std::sin(omega * t)); };
  const auto exact = [&](double t) { return mu * p0 * (1 + epsilon * gain * std::sin(omega * t - lag)); };
  FrictionMemory memory{exact(0), pressure(0)};
  double error = 0, in_phase = 0, out_of_phase = 0;
  const int settle = steps * static_cast<int>(std::ceil(40 * time / period));
  for (int n = 1; n <= settle + steps; ++n) {
    const double t = n * dt, traction = law({far, pressure(t), 0}, memory).traction;
    error = worse(error, std::abs(traction - exact(t)));
    if (n <= settle) continue;
    in_phase += traction * std::sin(omega * t) * 2 / steps;
    out_of_phase += traction * std::cos(omega * t) * 2 / steps;
  }
  return {error / (mu * p0 * epsilon), std::hypot(in_phase, out_of_phase) / (mu * p0 * epsilon),
          -std::atan2(out_of_phase, in_phase)};
}

}  // namespace

/// The weights are differences of numbers below 1, so a few units of 1 are allowed
/// relative to the smallest of them that is formed as a difference (x > ½: 1 − g ≥ .21, g − e ≥ .18, then g −
/// e ~ 1/x).
TEST(Relaxation, AgreesWithExtendedPrecision) {
  for (double exponent = -300; exponent <= 300; exponent += 0.05) {
    const double x = std::pow(10, exponent);
    const Relaxation w = relaxation(x);
    const Exact exact = exact_weights(x);
    const auto near = [](double found, long double expected) {
      return std::abs(found - expected) <=
             8 * std::numeric_limits<double>::epsilon() * expected + std::numeric_limits<double>::min();
    };
    EXPECT_TRUE(near(w.keep, exact.keep)) << "keep at x = " << x;
    EXPECT_TRUE(near(w.now, exact.now)) << "now at x = " << x;
    EXPECT_TRUE(near(w.before, exact.before)) << "before at x = " << x;
  }
}

TEST(Relaxation, IsAnAverage) {
  for (double exponent = -300; exponent <= 300; exponent += 0.01) {
    const Relaxation w = relaxation(std::pow(10, exponent));
    EXPECT_GE(w.keep, 0);
    EXPECT_GE(w.now, 0);
    EXPECT_GE(w.before, 0);
    EXPECT_NEAR(w.keep + w.now + w.before, 1, 4 * std::numeric_limits<double>::epsilon());
  }
}

TEST(Relaxation, LimitsAreCoulombAndFrozen) {
  const Relaxation coulomb = relaxation(infinity), frozen = relaxation(0);
  EXPECT_EQ(coulomb.keep, 0);
  EXPECT_EQ(coulomb.now, 1);
  EXPECT_EQ(coulomb.before, 0);
  EXPECT_EQ(frozen.keep, 1);
  EXPECT_EQ(frozen.now, 0);
  EXPECT_EQ(frozen.before, 0);
}

/// The law alone: gain 1/√(1+ω²T²) and lag atan ωT in slip. The only error is that of the
/// straight line through the pressure: relative (ωΔt)²/12 in amplitude, 8e-5 at 200 steps a period.
TEST(Relaxation, FollowsAnOscillatingPressure) {
  for (const double time : {0.02, 0.3, 2.0}) {
    constexpr double omega = 5;
    const Response found = response<RegularisedInstantaneous>(omega, time, 200);
    EXPECT_NEAR(found.gain * std::hypot(1, omega * time), 1, 1e-4) << "T = " << time;
    EXPECT_NEAR(found.lag, std::atan(omega * time), 1e-4) << "T = " << time;
  }
}

TEST(Relaxation, IsSecondOrderInTheTimeStep) {
  for (const double time : {0.1, 0.3, 1.0}) {
    const auto order = [](const Response& coarse, const Response& fine) {
      return std::log2(coarse.error / fine.error);
    };
    EXPECT_GT(order(response<RegularisedInstantaneous>(5, time, 100),
                    response<RegularisedInstantaneous>(5, time, 200)),
              1.9);
    EXPECT_GT(order(response<RegularisedStrength>(5, time, 100), response<RegularisedStrength>(5, time, 200)),
              1.9);
  }
}
