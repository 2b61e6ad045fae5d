#pragma once

#include <string>
#include <variant>

#include "slipscale/base/options.hpp"
#include "slipscale/contact/friction.hpp"
#include "slipscale/contact/surface.hpp"

namespace slipscale {

using FrictionLaw = std::variant<Frictionless, Coulomb, RegularisedInstantaneous, RegularisedStrength,
                                 SlipRate<RegularisedInstantaneous>, SlipRate<RegularisedStrength>>;

/// The law of all contact nodes, or one for each where its constants vary along the contact.
using FrictionLaws =
    std::variant<Frictionless, Coulomb, RegularisedInstantaneous, RegularisedStrength,
                 SlipRate<RegularisedInstantaneous>, SlipRate<RegularisedStrength>, std::vector<Coulomb>,
                 std::vector<RegularisedInstantaneous>, std::vector<RegularisedStrength>,
                 std::vector<SlipRate<RegularisedInstantaneous>>, std::vector<SlipRate<RegularisedStrength>>>;

/// What the user asks of friction; independent of the time step.
struct FrictionChoice {
  enum class Law { none, coulomb, regularized } law = Law::none;
  double coefficient = 0;                  ///< μ
  bool by_slip_rate = false;               ///< `rate: slip`
  bool stored_strength = false;            ///< `threshold: regularized`
  double time = 0;                         ///< T, s (`rate: surface`)
  double length = 0;                       ///< L, m (`rate: slip`)
  double rate_reference = 0;               ///< V*, m/s (`rate: slip`)
  SharedFormula coefficient_formula = {};  ///< then μ is the coefficient, 1, times it

  Quantity mu() const { return {coefficient, coefficient_formula}; }
  bool varies() const { return coefficient_formula != nullptr; }  ///< along the contact or in time
};

Schema friction_schema();

/// Reads the law and its constants; T = L*/|V| comes from the surface. Throws UserError for a missing or
/// contradictory constant, and for `rate: surface` with V = 0 when T itself is not given.
FrictionChoice read_friction(const Options& options, const Surface& surface);

/// The law where `time_step` [s] has passed since the memory was kept; 0 answers the memory itself. Without a
/// time or length to relax over it is Coulomb's.
FrictionLaw friction_law(const FrictionChoice& choice, double time_step);

/// The same for contact nodes; one law each where the choice varies, with its constants at t = 0.
FrictionLaws friction_laws(const FrictionChoice& choice, double time_step, const std::vector<Vector2>& nodes);
/// Gives laws that follow a formula of time the coefficients of `time`. False where one is no coefficient.
bool follow(const FrictionChoice& choice, double time, const std::vector<Vector2>& nodes, FrictionLaws& laws);

/// The relaxation time T of a node that slips with the surface's full speed, s; infinite for a law without
/// memory.
double shortest_memory(const FrictionChoice& choice, double surface_speed);

std::string describe(const FrictionChoice& choice);

}  // namespace slipscale
