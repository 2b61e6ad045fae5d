#pragma once

#include <string>
#include <variant>

#include "slipscale/base/options.hpp"
#include "slipscale/contact/friction.hpp"
#include "slipscale/contact/surface.hpp"

namespace slipscale {

using FrictionLaw =
    std::variant<Frictionless, Coulomb, RegularisedInstantaneous, RegularisedStrength,
                 SlipRate<RegularisedInstantaneous>, SlipRate<RegularisedStrength>, Exponential>;

/// The law of all contact nodes, or one for each where its constants vary along the contact.
using FrictionLaws =
    std::variant<Frictionless, Coulomb, RegularisedInstantaneous, RegularisedStrength,
                 SlipRate<RegularisedInstantaneous>, SlipRate<RegularisedStrength>, Exponential,
                 std::vector<Coulomb>, std::vector<RegularisedInstantaneous>,
                 std::vector<RegularisedStrength>, std::vector<SlipRate<RegularisedInstantaneous>>,
                 std::vector<SlipRate<RegularisedStrength>>, std::vector<Exponential>>;

/// Constants of a law, which may differ from region to region.
struct FrictionConstants {
  Quantity coefficient;   ///< μ; of the exponential law the static one
  double time = 0;        ///< T, s (`rate: surface`)
  double length = 0;      ///< L, m (`rate: slip`)
  Quantity kinetic = {};  ///< μ_k of the exponential law
  double slip_rate = 0;   ///< V_c of the same, m/s
};

/// A contact node: where it is, and the regions of the one or two edges that meet in it.
struct ContactPlace {
  Vector2 place{};              ///< undeformed, m
  std::array<int, 2> region{};  ///< index into Mesh::regions; of one edge both the same
  double second = 0;            ///< part of the tributary length that is of the second region
};

/// What the user asks of friction; independent of the time step.
struct FrictionChoice {
  enum class Law { none, coulomb, regularized, exponential } law = Law::none;
  double coefficient = 0;                  ///< μ
  bool by_slip_rate = false;               ///< `rate: slip`
  bool stored_strength = false;            ///< `threshold: regularized`
  double time = 0;                         ///< T, s (`rate: surface`)
  double length = 0;                       ///< L, m (`rate: slip`)
  double rate_reference = 0;               ///< V*, m/s (`rate: slip`)
  SharedFormula coefficient_formula = {};  ///< then μ is the coefficient, 1, times it

  /// By region, where some have constants of their own; else empty. A node between two regions has the mean
  /// of theirs by tributary length. Those of regions that do not touch the surface stand for nothing: they
  /// are those of one that does.
  std::vector<FrictionConstants> phases = {};
  std::vector<std::string> phase_texts = {};  ///< of those, for the terminal
  bool each_its_own = false;  ///< every region that touches has all constants, so that there are no others
  Quantity kinetic = {};      ///< μ_k of the exponential law
  double slip_rate = 0;       ///< V_c of the same, m/s

  Quantity mu() const { return {coefficient, coefficient_formula}; }
  bool varies() const {  ///< along the contact or in time
    return coefficient_formula || kinetic.formula || !phases.empty();
  }
  bool of_time() const;  ///< some coefficient follows a formula of time
  bool remembers() const { return law == Law::regularized || law == Law::exponential; }
  bool asks_slip_rate() const { return by_slip_rate || law == Law::exponential; }
};

Schema friction_schema();

/// The names of all options of friction, for those who refuse them.
std::vector<std::string> friction_options(const std::vector<std::string>& regions);

/// Reads the law and its constants; T = L*/|V| comes from the surface. `regions`: those of the mesh, and
/// whether each touches the surface. A constant that every region which touches has as its own need not be
/// given for all. Throws UserError for a missing or contradictory constant, for one of a region that does not
/// touch the surface, for `rate: surface` with V = 0 when T itself is not given, and for the exponential law
/// without memory.
FrictionChoice read_friction(const Options& options, const Surface& surface,
                             const std::vector<std::string>& regions, const std::vector<char>& touches);

/// The law where `time_step` [s] has passed since the memory was kept; 0 answers the memory itself. Without a
/// time or length to relax over it is Coulomb's.
FrictionLaw friction_law(const FrictionChoice& choice, double time_step);

/// The same for contact nodes; one law each where the choice varies, with its constants at t = 0.
FrictionLaws friction_laws(const FrictionChoice& choice, double time_step,
                           const std::vector<ContactPlace>& nodes);
/// Gives laws that follow a formula of time the coefficients of `time`. False where one is no coefficient.
bool follow(const FrictionChoice& choice, double time, const std::vector<ContactPlace>& nodes,
            FrictionLaws& laws);

/// The relaxation time T of a node that slips with the surface's full speed, s; infinite for a law without
/// memory.
double shortest_memory(const FrictionChoice& choice, double surface_speed);

std::string describe(const FrictionChoice& choice);

}  // namespace slipscale
