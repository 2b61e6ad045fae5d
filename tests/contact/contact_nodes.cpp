#include "slipscale/contact/contact_nodes.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

using namespace slipscale;

namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr double mass = 3, length = 0.25, clearance = 0.5, travel = 2e-3;
constexpr ContactStep step{{5e-3, 5e-3, 2.5e-3, 1e-4}, travel, 0.2};
constexpr double push =
    mass / step.motion.displacement;  ///< force that moves the node by 1 m over the step, N

/// One node of the surface through one call of `enforce`.
struct Node {
  explicit Node(bool held = false) { contact.add(0, 0, mass, length, clearance, held); }

  template <class Law>
  void enforce(const Law& law) {
    contact.enforce(law, step, &before, &support, {&u, &v, &a});
  }

  ContactNodes contact;
  Vector2 before{0.1, -0.5}, u{0.1, -0.5}, v{0, 0}, a{0, 0}, support{0, 0};
};

/// A law that only looks.
struct Spy {
  static constexpr bool uses_slip_rate = true;
  double* seen;
  Friction operator()(const FrictionDemand& demand, FrictionMemory&) const {
    *seen = demand.slip_rate;
    return {0, ContactStatus::slip};
  }
};

}  // namespace

/// λ = max(0, −gap(û) m/c), so that gap_{n+1} = 0.
TEST(ContactNodes, ClosedNodeEndsOnTheSurface) {
  for (const double depth : {1e-12, 1e-6, 1e-3, 0.4}) {
    Node node;
    node.u[1] = -clearance - depth;
    node.enforce(Frictionless{});
    EXPECT_NEAR(node.u[1] + clearance, 0, 2 * epsilon * clearance);
    EXPECT_NEAR(node.contact.force[0][1], depth * push, 4 * epsilon * clearance * push);
    EXPECT_EQ(node.contact.pressure[0], node.contact.force[0][1] / length);
    EXPECT_DOUBLE_EQ(node.a[1], node.contact.force[0][1] / mass);
    EXPECT_DOUBLE_EQ(node.v[1], step.motion.predictor * node.a[1]);
    EXPECT_EQ(node.contact.status[0], ContactStatus::slip);
    EXPECT_EQ(node.u[0], 0.1);
  }
}

TEST(ContactNodes, OpenNodeIsLeftAloneAndForgets) {
  for (const double gap : {0.0, 1e-9, 3.0}) {
    Node node;
    node.contact.start_memory(7, 8);
    node.u[1] = -clearance + gap;
    const Vector2 free = node.u;
    node.enforce(RegularisedStrength{0.5, relaxation(0.1)});
    EXPECT_EQ(node.u, free);
    EXPECT_EQ(node.a, (Vector2{0, 0}));
    EXPECT_EQ(node.contact.force[0], (Vector2{0, 0}));
    EXPECT_EQ(node.contact.pressure[0], 0);
    EXPECT_EQ(node.contact.traction[0], 0);
    EXPECT_EQ(node.contact.status[0], ContactStatus::open);
    EXPECT_EQ(node.contact.memory[0].traction, 0);
    EXPECT_EQ(node.contact.memory[0].pressure, 0);
  }
}

TEST(ContactNodes, StickingNodeTravelsWithTheSurface) {
  Node node;
  node.u = {node.before[0] + 0.7 * travel, -clearance - 1e-2};
  node.enforce(Coulomb{0.5});
  EXPECT_EQ(node.contact.status[0], ContactStatus::stick);
  EXPECT_NEAR(node.u[0], node.before[0] + travel, epsilon);
  EXPECT_NEAR(node.contact.force[0][0], 0.3 * travel * push, 4 * epsilon * push);
}

TEST(ContactNodes, SlippingNodeStaysBehindTheSurface) {
  Node node;
  node.u = {node.before[0], -clearance - 1e-3};
  node.enforce(Coulomb{0.5});
  EXPECT_EQ(node.contact.status[0], ContactStatus::slip);
  EXPECT_NEAR(node.u[0] - node.before[0], 0.5 * 1e-3, 4 * epsilon);  // μ times the push along y
  EXPECT_DOUBLE_EQ(node.contact.traction[0], 0.5 * node.contact.pressure[0]);
}

/// Where x is prescribed and the surface moves past, the node slips: the law's traction acts, and the support
/// takes it.
TEST(ContactNodes, HeldNodeThatSlipsTakesTheLaw) {
  Node node(true);
  node.u = {node.before[0], -clearance - 1e-4};
  node.support = {11, 0};
  node.enforce(Coulomb{0.5});
  const double friction = 0.5 * node.contact.force[0][1];
  EXPECT_EQ(node.contact.status[0], ContactStatus::slip);
  EXPECT_DOUBLE_EQ(node.contact.force[0][0], friction);
  EXPECT_DOUBLE_EQ(node.support[0], 11 - friction);
  EXPECT_EQ(node.u[0], node.before[0]);
  EXPECT_EQ(node.a[0], 0);
}

/// Where x is prescribed and does not slip, the surface carries the support's reaction as far as μp goes.
TEST(ContactNodes, HeldNodeThatDoesNotSlipCarriesTheReaction) {
  const double normal = 1e-4 * push;
  for (const double part : {0.0, 0.3, -0.9, 2.0, -2.0}) {
    Node node(true);
    node.u = {node.before[0] + travel, -clearance - 1e-4};
    node.support = {part * 0.5 * normal, 0};
    node.enforce(Coulomb{0.5});
    const double carried = std::clamp(part, -1.0, 1.0) * 0.5 * normal;
    EXPECT_NEAR(node.contact.force[0][0], carried, 1e-12 * normal);
    EXPECT_NEAR(node.support[0], part * 0.5 * normal - carried, 1e-12 * normal);
    EXPECT_EQ(node.u[0], node.before[0] + travel);
  }
}

/// `rate: slip` sees V minus the predictor w_n the node came with: w_{n+1} without what a_n added to it.
TEST(ContactNodes, SlipRateIsThatBeforeTheForcesOfTheStep) {
  Node node;
  node.u[1] = -clearance - 1e-4;
  node.v[0] = 0.05;
  node.a[0] = 3;
  double seen = 0;
  node.enforce(Spy{&seen});
  EXPECT_DOUBLE_EQ(seen, step.surface_speed - (0.05 - step.motion.predictor * 3));
}
