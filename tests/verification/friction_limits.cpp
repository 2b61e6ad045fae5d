#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "friction_column.hpp"
#include "report.hpp"
#include "slipscale/base/error.hpp"
#include "slipscale/base/print.hpp"

using namespace slipscale;
using namespace slipscale::testing_support;

namespace {

constexpr double mu = 0.5, nominal_pressure = 15e6, slow = 0.5, step = 5e-9;

/// Scene R made harsher: undamped, a quarter of the speed, pressed down within 2 µs. Its contact opens,
/// sticks and slips in less than 20 µs.
Simulation harsh(const FrictionChoice& friction, double speed) {
  Block block;
  block.width = block.height = 5e-3;
  block.nx = block.ny = 20;
  block.shape = Shape::quadrilaterals;
  const std::string path = scratch("harsh.msh");
  write_block(block, path);
  Scene scene = scene_r();
  scene.damping = {};
  scene.conditions[0].ramp = 2e-6;
  scene.surface->speed = speed;
  scene.friction = friction;
  return {PETSC_COMM_WORLD, {path}, {scene_r_material()}, scene, step};
}

FrictionChoice coulomb() {
  FrictionChoice choice;
  choice.law = FrictionChoice::Law::coulomb;
  choice.coefficient = mu;
  return choice;
}

struct Ended {
  std::vector<Vector2> displacement;  ///< of all nodes
  StatusCount statuses;
};

Ended run(const FrictionChoice& friction, double speed) {
  Simulation simulation = harsh(friction, speed);
  Ended ended;
  for (int n = 0; n < 12000; ++n) {
    simulation.body.advance(false);
    ended.statuses.add(simulation.body.contact());
  }
  ended.displacement = whole_field(PETSC_COMM_WORLD, simulation.mesh, simulation.body.next_displacement());
  ended.statuses = ended.statuses.over_ranks(PETSC_COMM_WORLD);
  return ended;
}

/// Nodes at which two runs differ in any bit.
long differing(const Ended& one, const Ended& other) {
  long count = 0;
  for (std::size_t i = 0; i < one.displacement.size(); ++i)
    count += !(one.displacement[i] == other.displacement[i]);
  return count;
}

/// Largest number of nodes at which one of the four laws differs from the one that it must become.
long most_differing(double time, const Ended& limit, double speed) {
  long most = 0;
  for (const LawName& law : regularized_laws) {
    const long count = differing(run(law.choice(mu, time, speed), speed), limit);
    EXPECT_EQ(count, 0) << law.text;
    most = std::max(most, count);
  }
  return most;
}

void report_limit(const char* quantity, long most, const char* source) {
  report({"Limits of the regularized law, scene R pressed down in 2 us, t = 60 us", quantity, "0 of 441",
          format("{} of 441", most), "", source});
}

/// Dissipation of friction, node by node and step by step, over a run.
class Dissipation {
 public:
  explicit Dissipation(const SlidingBody& body)
      : body_(body), past_(static_cast<std::size_t>(body.contact().size()), 0) {}

  /// After every step t_n → t_{n+1}. The law acts on the slip that this step makes, so that
  /// u̇ = (u_{n+1} − u_n)/Δt is the velocity with which τ_n (V − u̇) ≥ 0 holds at every node. The ledger, for
  /// which work is ½(f_n + f_{n+1}) Δu, meets the slip of a step with the traction at its end as well: its
  /// terms can be negative where a node reverses, only their sum is the heat.
  void add() {
    const ContactNodes& contact = body_.contact();
    for (int k = 0; k < contact.size(); ++k) {
      const double before = body_.boundary_nodes().displacement[contact.slot[k]][0],
                   slip = body_.surface_travel() - (body_.next_displacement()[contact.node[k]][0] - before);
      smallest = std::min(smallest, contact.traction[k] * slip / (mu * nominal_pressure * slow * step));
      largest_displacement = std::max(largest_displacement, std::abs(before));
      largest_traction = std::max(largest_traction, std::abs(contact.traction[k]));
      heat += 0.5 * contact.force[k][0] * past_[static_cast<std::size_t>(k)] + waiting_;
      waiting_ = 0;
      past_[static_cast<std::size_t>(k)] = slip;
    }
    for (int k = 0; k < contact.size(); ++k)
      waiting_ += 0.5 * contact.force[k][0] * past_[static_cast<std::size_t>(k)];
    statuses.add(contact);
  }

  void over_ranks() {
    statuses = statuses.over_ranks(PETSC_COMM_WORLD);
    MPI_Allreduce(MPI_IN_PLACE, &smallest, 1, MPI_DOUBLE, MPI_MIN, PETSC_COMM_WORLD);
    for (double* largest : {&largest_displacement, &largest_traction})
      MPI_Allreduce(MPI_IN_PLACE, largest, 1, MPI_DOUBLE, MPI_MAX, PETSC_COMM_WORLD);
    MPI_Allreduce(MPI_IN_PLACE, &heat, 1, MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD);
  }

  double smallest = std::numeric_limits<double>::infinity();  ///< τ (V − u̇) over μ p V
  double largest_displacement = 0, largest_traction = 0;      ///< m, Pa
  double heat = 0;                                            ///< of the steps that are closed, J/m
  StatusCount statuses;

 private:
  const SlidingBody& body_;
  std::vector<double> past_;  ///< slip of the step before, m
  double waiting_ = 0;        ///< J/m
};

}  // namespace

TEST(FrictionLimits, WithoutLengthItIsCoulomb) {
  const Ended limit = run(coulomb(), slow);
  ASSERT_TRUE(limit.statuses.all_seen());
  ASSERT_EQ(limit.displacement.size(), 441U);
  report_limit("L* = 0 and L* = 5e-61 m: nodes whose u differs from Coulomb's in any bit",
               std::max(most_differing(0, limit, slow), most_differing(1e-60, limit, slow)),
               "the same run with Coulomb's law");
}

/// The memory never leaves 0. With the instantaneous threshold a node that comes to rest on the surface still
/// sticks, hence a speed that no node reaches; the stored strength holds nothing at any speed.
TEST(FrictionLimits, WithInfiniteLengthItIsFrictionless) {
  constexpr double infinity = std::numeric_limits<double>::infinity(), fast = 20;
  report_limit("L* infinite, V = 20 m/s: nodes whose u differs from the frictionless run in any bit",
               most_differing(infinity, run({}, fast), fast), "the same run without friction");
  const Ended frictionless = run({}, slow);
  for (const LawName& law : regularized_laws)
    if (law.stored_strength) {
      EXPECT_EQ(differing(run(law.choice(mu, infinity, slow), slow), frictionless), 0) << law.text;
    }
}

/// A resting surface has no relaxation time L*/|V|: a sentence of the user's, not a division by zero.
TEST(FrictionLimits, RestingSurfaceNeedsATime) {
  const auto sentence = [](const char* name, const char* value) -> std::string {
    petsc(PetscOptionsClear(nullptr));
    for (const auto& [option, text] : {std::pair{"-friction_law", "regularized"},
                                       {"-friction_coefficient", "0.5"},
                                       {"-friction_rate", "surface"},
                                       {name, value}})
      petsc(PetscOptionsSetValue(nullptr, option, text));
    std::string said = "none";
    try {
      (void)read_friction(Options("slide", friction_schema()), Surface{"bottom", 0, 0, 0}, {}, {});
    } catch (const UserError& error) {
      said = error.what();
    }
    petsc(PetscOptionsClear(nullptr));
    return said;
  };
  EXPECT_EQ(sentence("-friction_time", "1e-6"), "none");
  const std::string fault = sentence("-friction_length", "1e-6");
  bool names_both = true;
  for (const char* part : {"-surface_speed is 0", "-friction_time"})
    names_both = names_both && fault.find(part) != std::string::npos;
  EXPECT_TRUE(names_both) << fault;
  report({"Limits of the regularized law, V = 0 with rate surface", "refusal of L* without T",
          "names -surface_speed and -friction_time", names_both ? "names both" : "does not", "",
          "T = L*/V has no value"});
}

/// Friction never feeds energy. Sticking is slip 0 up to the rounding of u, a few ε |u|/VΔt times τ/μp.
TEST(FrictionDissipation, IsNeverNegative) {
  std::vector<std::pair<std::string, FrictionChoice>> laws{{"Coulomb", coulomb()}};
  for (const LawName& law : regularized_laws) laws.emplace_back(law.text, law.choice(mu, 0.6e-6, slow));
  double smallest = 0, bound = 0;
  for (const auto& [name, choice] : laws) {
    Simulation simulation = harsh(choice, slow);
    Dissipation found(simulation.body);
    constexpr int steps = 20000;
    for (int n = 0; n < steps; ++n) {
      simulation.body.advance(n == steps - 1);
      found.add();
    }
    found.over_ranks();
    EXPECT_TRUE(found.statuses.all_seen()) << name;
    const double rounding = 4 * std::numeric_limits<double>::epsilon() * found.largest_displacement /
                            (slow * step) * found.largest_traction / (mu * nominal_pressure);
    EXPECT_LE(rounding, 2e-11) << name;
    EXPECT_GE(found.smallest, -rounding) << name;
    const Energy energy = simulation.body.energy();
    EXPECT_GT(energy.friction_heat, 0) << name;
    EXPECT_NEAR(found.heat / energy.friction_heat, 1, 1e-10) << name;
    smallest = std::min(smallest, found.smallest);
    bound = std::max(bound, rounding);
  }
  report(
      {"Dissipation tau (V - du_x/dt) over mu p V, every contact node and step of 100 us of chaotic contact",
       "smallest, of Coulomb and the regularized law with both rates and thresholds",
       format(">= -{:.0e} (rounding of u)", bound), format("{:.1e}", smallest), "", "second law"});
}
