#include "slipscale/contact/surface.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace slipscale;

namespace {

/// Simpson's rule; its error at 400 intervals over a ramp is below 1e-10 of the travel.
double integral(const Surface& surface, double from, double to) {
  constexpr int intervals = 400;
  const double h = (to - from) / intervals;
  double sum = surface.velocity(from) + surface.velocity(to);
  for (int k = 1; k < intervals; ++k) sum += (k % 2 ? 4 : 2) * surface.velocity(from + k * h);
  return sum * h / 3;
}

}  // namespace

TEST(Surface, TravelIsTheIntegralOfVelocity) {
  const Surface ramped{"bottom", 0, -2.5, 0.3};
  EXPECT_EQ(ramped.travel(0), 0);
  for (const auto& [from, to] : {std::pair{0.0, 0.1}, {0.05, 0.29}, {0.1, 0.3}, {0.3, 2.0}})
    EXPECT_NEAR(ramped.travel(to) - ramped.travel(from), integral(ramped, from, to), 1e-9);
}

TEST(Surface, ReachesItsSpeedAlongACosine) {
  const Surface ramped{"bottom", 0, 4, 0.2};
  EXPECT_EQ(ramped.velocity(0), 0);
  EXPECT_NEAR(ramped.velocity(0.05), 4 * 0.5 * (1 - std::sqrt(0.5)), 1e-15);
  EXPECT_NEAR(ramped.velocity(0.1), 2, 1e-15);
  EXPECT_EQ(ramped.velocity(0.2), 4);
  EXPECT_EQ(ramped.velocity(7), 4);
}

TEST(Surface, WithoutRampIsAtFullSpeedFromTheStart) {
  const Surface surface{"bottom", 0, 4, 0};
  EXPECT_EQ(surface.velocity(0), 4);
  EXPECT_EQ(surface.travel(3), 12);
}
