#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "slipscale/contact/law.hpp"

using namespace slipscale;

namespace {

constexpr double mu = 0.5, infinity = std::numeric_limits<double>::infinity();

FrictionChoice regularized(bool stored, double time) {
  FrictionChoice choice;
  choice.law = FrictionChoice::Law::regularized;
  choice.coefficient = mu;
  choice.stored_strength = stored;
  choice.time = time;
  return choice;
}

FrictionChoice by_slip_rate(bool stored, double length) {
  FrictionChoice choice = regularized(stored, 0);
  choice.by_slip_rate = true;
  choice.length = length;
  choice.rate_reference = 0.25;
  return choice;
}

Friction ask(const FrictionLaw& law, const FrictionDemand& demand, FrictionMemory& memory) {
  return std::visit([&](const auto& l) { return l(demand, memory); }, law);
}

/// Demands that stick, slip and change sign, the same in every run.
class Demands {
 public:
  FrictionDemand next() {
    return {8 * size(random) * size(random) * sign(), 1 + size(random), 4 * size(random) * sign()};
  }

 private:
  double sign() { return size(random) < 0.5 ? -1 : 1; }
  std::mt19937 random{20070};
  std::uniform_real_distribution<double> size{0, 1};
};

}  // namespace

TEST(Coulomb, SticksUpToTheLimitAndSlipsBeyond) {
  const Coulomb law{mu};
  FrictionMemory memory;
  for (const double trial : {0.0, 0.99, 1.0, -1.0}) {
    const Friction friction = law({trial, 2, 0}, memory);
    EXPECT_EQ(friction.traction, trial);
    EXPECT_EQ(friction.status, ContactStatus::stick);
  }
  for (const double trial : {1.01, -1.01, 1e300}) {
    const Friction friction = law({trial, 2, 0}, memory);
    EXPECT_EQ(friction.traction, std::copysign(1, trial));
    EXPECT_EQ(friction.status, ContactStatus::slip);
  }
}

TEST(Frictionless, HasNoTraction) {
  FrictionMemory memory;
  EXPECT_EQ(Frictionless{}({7, 2, 0}, memory).traction, 0);
}

/// L* → 0 gives Coulomb, bit for bit, whatever came before: as chosen by the user, and in the laws
/// themselves.
TEST(Regularised, WithoutTimeIsCoulomb) {
  for (const bool stored : {false, true})
    for (const FrictionLaw& law :
         {friction_law(regularized(stored, 0), 1e-9), friction_law(by_slip_rate(stored, 0), 1e-9),
          stored ? FrictionLaw(RegularisedStrength{mu, relaxation(infinity)})
                 : FrictionLaw(RegularisedInstantaneous{mu, relaxation(infinity)}),
          stored ? FrictionLaw(SlipRate<RegularisedStrength>{mu, 0, 0.25, 1e-9})
                 : FrictionLaw(SlipRate<RegularisedInstantaneous>{mu, 0, 0.25, 1e-9})}) {
      Demands demands;
      FrictionMemory memory, unused;
      int stuck = 0;
      for (int n = 0; n < 10000; ++n) {
        const FrictionDemand demand = demands.next();
        const Friction found = ask(law, demand, memory), coulomb = Coulomb{mu}(demand, unused);
        ASSERT_EQ(found.traction, coulomb.traction);
        ASSERT_EQ(found.status, coulomb.status);
        stuck += found.status == ContactStatus::stick;
      }
      EXPECT_GT(stuck, 1000);
      EXPECT_LT(stuck, 9000);
    }
}

/// L* → ∞: the traction of a slipping node, or the stored strength, stays what it was.
TEST(Regularised, WithInfiniteTimeIsFrozen) {
  for (const bool stored : {false, true}) {
    const FrictionLaw law = friction_law(regularized(stored, infinity), 1e-9);
    FrictionMemory memory{0.125, 2};
    for (const double pressure : {2.0, 0.5, 7.0}) {
      const Friction friction = ask(law, {30, pressure, 0}, memory);
      EXPECT_EQ(friction.traction, 0.125);
      EXPECT_EQ(friction.status, ContactStatus::slip);
    }
  }
}

/// At the start no time has passed since the memory: it is what slips, and with no length to relax over it is
/// Coulomb's.
TEST(Regularised, AtTheStartAnswersTheMemory) {
  for (const bool stored : {false, true})
    for (const FrictionLaw& law :
         {friction_law(regularized(stored, 2), 0), friction_law(by_slip_rate(stored, 2), 0)}) {
      FrictionMemory memory{0.3, 7};
      EXPECT_EQ(ask(law, {9, 2, 1}, memory).traction, 0.3);
      EXPECT_EQ(memory.pressure, 2);
    }
  for (const FrictionLaw& law :
       {friction_law(regularized(false, 0), 0), friction_law(by_slip_rate(true, 0), 0)}) {
    FrictionMemory memory{0.3, 7};
    EXPECT_EQ(ask(law, {9, 2, 1}, memory).traction, 1);
  }
}

TEST(RegularisedInstantaneous, SticksBelowCoulombsLimitAndRemembersTheTraction) {
  const RegularisedInstantaneous law{mu, relaxation(0.1)};
  FrictionMemory memory{0.2, 5};
  const Friction friction = law({-0.9, 2, 0}, memory);
  EXPECT_EQ(friction.traction, -0.9);
  EXPECT_EQ(friction.status, ContactStatus::stick);
  EXPECT_EQ(memory.traction, -0.9);
  EXPECT_EQ(memory.pressure, 2);  // kept while sticking
}

TEST(RegularisedInstantaneous, RelaxesInSlip) {
  const Relaxation w = relaxation(0.1);
  FrictionMemory memory{-0.2, 5};
  const Friction friction = RegularisedInstantaneous{mu, w}({-9, 2, 0}, memory);
  EXPECT_DOUBLE_EQ(friction.traction, -(w.keep * 0.2 + mu * (w.now * 2 + w.before * 5)));
  EXPECT_EQ(friction.status, ContactStatus::slip);
  EXPECT_EQ(memory.traction, friction.traction);
  EXPECT_EQ(memory.pressure, 2);
}

/// A memory that opposes sign(τ*) restarts from 0, since slip must oppose the traction.
TEST(RegularisedInstantaneous, OpposingMemoryRestartsFromZero) {
  const Relaxation w = relaxation(0.1);
  FrictionMemory memory{0.8, 2};
  const Friction friction = RegularisedInstantaneous{mu, w}({-9, 2, 0}, memory);
  EXPECT_DOUBLE_EQ(friction.traction, -mu * (w.now + w.before) * 2);
}

/// Where the relaxed traction would exceed |τ*| the node sticks with τ = τ*.
TEST(RegularisedInstantaneous, NeverPullsBeyondSticking) {
  FrictionMemory memory{3, 6};
  const Friction friction = RegularisedInstantaneous{mu, relaxation(0.01)}({1.5, 2, 0}, memory);
  EXPECT_EQ(friction.traction, 1.5);
  EXPECT_EQ(friction.status, ContactStatus::stick);
  EXPECT_EQ(memory.traction, 1.5);
}

/// The stored strength relaxes to μp whether the node sticks or slips, and is what |τ*| is compared with.
TEST(RegularisedStrength, RelaxesWhileItSticks) {
  const Relaxation w = relaxation(0.1);
  const RegularisedStrength law{mu, w};
  FrictionMemory memory{0.4, 2};
  double strength = 0.4;
  for (const double trial : {0.1, -0.2, 9.0, -9.0, 0.3}) {
    strength = w.keep * strength + mu * (w.now * 2 + w.before * 2);
    const Friction friction = law({trial, 2, 0}, memory);
    const bool slips = std::abs(trial) > strength;
    EXPECT_DOUBLE_EQ(memory.traction, strength);
    EXPECT_DOUBLE_EQ(friction.traction, slips ? std::copysign(strength, trial) : trial);
    EXPECT_EQ(friction.status, slips ? ContactStatus::slip : ContactStatus::stick);
  }
}

/// A demand between the strength and μp slips here and sticks with the paper's threshold.
TEST(RegularisedStrength, DiffersFromTheInstantaneousThreshold) {
  FrictionMemory stored{0.1, 2}, traction{0.1, 2};
  const FrictionDemand demand{0.8, 2, 0};
  EXPECT_EQ((RegularisedStrength{mu, relaxation(0.1)}(demand, stored).status), ContactStatus::slip);
  EXPECT_EQ((RegularisedInstantaneous{mu, relaxation(0.1)}(demand, traction).status), ContactStatus::stick);
}

/// Help of what belongs to some laws alone says so.
TEST(Laws, HelpNamesTheLawThatAnOptionBelongsTo) {
  for (const Option& option : friction_schema()) {
    if (option.name.find('<') != std::string::npos || option.name == "friction_law" ||
        option.name == "friction_coefficient")
      continue;
    EXPECT_NE(option.help.find("law"), std::string::npos) << option.name << ": " << option.help;
  }
}

/// T = L/(|slip rate| + V*), the same for both directions of slip.
TEST(SlipRate, IsTheLawWithItsOwnTime) {
  constexpr double length = 0.3, step = 0.02;
  for (const bool stored : {false, true})
    for (const double rate : {0.0, 1.5, -1.5}) {
      const FrictionLaw fixed = friction_law(regularized(stored, length / (1.5 * (rate != 0) + 0.25)), step);
      const FrictionLaw law = friction_law(by_slip_rate(stored, length), step);
      FrictionMemory memory{0.4, 3}, expected{0.4, 3};
      EXPECT_DOUBLE_EQ(ask(law, {9, 2, rate}, memory).traction, ask(fixed, {9, 2, rate}, expected).traction);
    }
}

/// Slip of the surface past the node over the step is (τ* − τ) c A/m: friction never feeds energy, and never
/// more than sticking asks for.
TEST(Laws, AlwaysDissipate) {
  const FrictionChoice none;
  FrictionChoice coulomb;
  coulomb.law = FrictionChoice::Law::coulomb;
  coulomb.coefficient = mu;
  for (const double time : {0.0, 1e-3, 1e-2, 1.0, 1e6})
    for (const FrictionChoice& choice : {none, coulomb, regularized(false, time), regularized(true, time),
                                         by_slip_rate(false, time), by_slip_rate(true, time)}) {
      const FrictionLaw law = friction_law(choice, 1e-2);
      Demands demands;
      FrictionMemory memory;
      for (int n = 0; n < 2000; ++n) {
        const FrictionDemand demand = demands.next();
        const Friction friction = ask(law, demand, memory);
        ASSERT_GE(friction.traction * (demand.trial - friction.traction), 0);
        ASSERT_LE(std::abs(friction.traction), std::abs(demand.trial));
        if (friction.status == ContactStatus::stick) {
          ASSERT_EQ(friction.traction, demand.trial);
        }
      }
    }
}
