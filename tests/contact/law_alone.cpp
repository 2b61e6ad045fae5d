#include <gtest/gtest.h>

#include <cmath>

#include "slipscale/contact/contact_nodes.hpp"

using namespace slipscale;

namespace {

/// One mass on one spring, m = k = 1, dragged by a friction that builds up from 0 to μp = 1 in the time T =
/// .3 and always slips. Central difference; the node is pressed anew with p = 1 in every step.
double displacement_at(double end, int steps) {
  const double dt = end / steps, time = 0.3;
  const ContactStep step{{dt, dt, 0.5 * dt, dt * dt}, 1e6 * dt, 1e6};
  const RegularisedInstantaneous law{1, relaxation(dt / time)};
  ContactNodes contact;
  contact.add(0, 0, 1, 1, 0, false);
  contact.start_memory(0, 1);
  // At rest without traction at t = 0: u_1 = 0 as well, and the first traction to find is that at t_1.
  Vector2 u{0, 0}, w{0, 0}, a{0, 0}, support{0, 0};
  for (int n = 1; n < steps; ++n) {
    const Vector2 before{u[0], 0};
    a = {-u[0], 0};
    u = {u[0] + dt * w[0] + dt * dt * a[0], -dt * dt};
    w[0] += dt * a[0];
    contact.enforce(law, step, &before, &support, {&u, &w, &a});
    EXPECT_NEAR(contact.pressure[0], 1, 1e-12);
    EXPECT_EQ(contact.status[0], ContactStatus::slip);
  }
  return u[0];
}

/// ẍ + x = 1 − exp(−t/T) from rest.
double exact(double t) {
  const double time = 0.3, part = time * time / (1 + time * time);
  return 1 - part * std::exp(-t / time) + (part - 1) * std::cos(t) - part / time * std::sin(t);
}

}  // namespace

/// Exact solution: x(5) = 1.003683570, x(10) = 1.919520975, second order in Δt. Central difference shifts
/// the phase by (ωΔt)²/24 a radian, that is 4e-9 at x(10) with Δt = 1e-4.
TEST(LawAlone, MovesAMassOnASpring) {
  EXPECT_NEAR(displacement_at(5, 50000), 1.003683570, 1e-8);
  EXPECT_NEAR(displacement_at(10, 100000), 1.919520975, 1e-8);
}

TEST(LawAlone, IsSecondOrder) {
  for (const double end : {5.0, 10.0}) {
    const double coarse = std::abs(displacement_at(end, 400) - exact(end)),
                 fine = std::abs(displacement_at(end, 800) - exact(end));
    EXPECT_GT(std::log2(coarse / fine), 1.9) << "at t = " << end;
  }
}
