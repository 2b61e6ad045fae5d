#include <gtest/gtest.h>

#include <cmath>

#include "slipscale/contact/contact_nodes.hpp"
#include "slipscale/dynamics/scheme.hpp"

using namespace slipscale;

namespace {

constexpr double mass = 2, speed = 3, dt = 0.01;

/// A free node that falls on the surface.
struct FallingNode {
  explicit FallingNode(double b) : beta2(b) { contact.add(0, 0, mass, 0.5, 0.105, false); }

  /// Returns the momentum passed to the surface over the step.
  double advance() {
    const StepCoefficients step = beta2_step(dt, beta2);
    const Vector2 before = u;
    u[1] += dt * w[1];
    contact.enforce(Frictionless{}, {step, 0, 0}, &before, &support, {&u, &w, nullptr});
    return contact.force[0][1] * dt;
  }

  /// The velocity with which the node goes on: the predictor of the next step.
  double velocity() const { return w[1]; }

  double beta2;
  ContactNodes contact;
  Vector2 u{0, 0}, w{0, -speed}, support{0, 0};
};

}  // namespace

/// The position constraint makes the impact of a node plastic: its momentum m|v| passes
/// exactly, it never rebounds, and once it lies on the surface what velocity is left shrinks by (β2−½)/(β2+½)
/// in each step.
TEST(NodeImpact, IsPlastic) {
  for (const double beta2 : {0.5, 0.6, 0.8, 1.0}) {
    FallingNode node(beta2);
    double impulse = 0;
    while (impulse == 0) impulse += node.advance();
    const double ratio = (beta2 - 0.5) / (beta2 + 0.5);
    for (int n = 0; n < 5; ++n) {
      const double before = node.velocity();
      impulse += node.advance();
      EXPECT_NEAR(node.velocity(), ratio * before, 1e-13 * speed) << "beta2 " << beta2;
    }
    for (int n = 0; n < 100; ++n) impulse += node.advance();
    EXPECT_NEAR(impulse, mass * speed, 1e-13 * mass * speed);
    EXPECT_NEAR(node.velocity(), 0, 1e-13 * speed);
    EXPECT_NEAR(node.u[1], -0.105, 1e-15);
  }
}

TEST(NodeImpact, HasTheQuotedRatios) {
  for (const auto& [beta2, ratio] : {std::pair{0.5, 0.0}, {0.8, 0.2308}}) {
    FallingNode node(beta2);
    while (node.advance() == 0) {
    }
    const double before = node.velocity();
    node.advance();
    if (ratio != 0) {
      EXPECT_NEAR(node.velocity() / before, ratio, 5e-5);
    } else {
      EXPECT_NEAR(node.velocity(), 0, 1e-13 * speed);
    }
  }
}
