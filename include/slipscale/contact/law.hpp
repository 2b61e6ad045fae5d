#pragma once

#include <string>
#include <variant>

#include "slipscale/base/options.hpp"
#include "slipscale/contact/friction.hpp"
#include "slipscale/contact/surface.hpp"

namespace slipscale {

using FrictionLaw = std::variant<Frictionless, Coulomb, RegularisedInstantaneous, RegularisedStrength,
                                 SlipRate<RegularisedInstantaneous>, SlipRate<RegularisedStrength>>;

/// What the user asks of friction; independent of the time step.
struct FrictionChoice {
  enum class Law { none, coulomb, regularized } law = Law::none;
  double coefficient = 0;        ///< μ
  bool by_slip_rate = false;     ///< `rate: slip`
  bool stored_strength = false;  ///< `threshold: regularized`
  double time = 0;               ///< T, s (`rate: surface`)
  double length = 0;             ///< L, m (`rate: slip`)
  double rate_reference = 0;     ///< V*, m/s (`rate: slip`)
};

Schema friction_schema();

/// Reads the law and its constants; T = L*/|V| comes from the surface. Throws UserError for a missing or
/// contradictory constant, and for `rate: surface` with V = 0 when T itself is not given.
FrictionChoice read_friction(const Options& options, const Surface& surface);

/// The law where `time_step` [s] has passed since the memory was kept; 0 answers the memory itself. Without a
/// time or length to relax over it is Coulomb's.
FrictionLaw friction_law(const FrictionChoice& choice, double time_step);

/// The relaxation time T of a node that slips with the surface's full speed, s; infinite for a law without
/// memory.
double shortest_memory(const FrictionChoice& choice, double surface_speed);

std::string describe(const FrictionChoice& choice);

}  // namespace slipscale
