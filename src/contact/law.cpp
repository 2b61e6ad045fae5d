#include "slipscale/contact/law.hpp"

#include <cmath>
#include <limits>

#include "slipscale/base/error.hpp"
#include "slipscale/base/physical_range.hpp"
#include "slipscale/base/print.hpp"

namespace slipscale {

Schema friction_schema() {
  return {
      {"friction_law", Kind::text, "", required, range::one_of({"none", "coulomb", "regularized"}),
       "law of friction between body and surface; regularized is the simplified Prakash-Clifton law"},
      {"friction_coefficient", Kind::real, "1", required,
       range::or_formula(range::physical_non_negative, "xt"), "coefficient of friction, mu"},
      {"friction_length", Kind::real, "m", required, range::physical_non_negative,
       "slip distance over which the traction follows the pressure, L*; T = L*/|V|"},
      {"friction_time", Kind::real, "s", absent, range::physical_non_negative,
       "relaxation time T itself, in place of the length"},
      {"friction_rate", Kind::text, "", "surface", range::one_of({"surface", "slip"}),
       "what T is made with: the surface's speed, T = L*/|V|, or the slip rate, T = L/(|slip rate| + V*)"},
      {"friction_rate_reference", Kind::real, "m/s", required, range::physical_positive,
       "V* of `rate: slip`"},
      {"friction_threshold", Kind::text, "", "instantaneous", range::one_of({"instantaneous", "regularized"}),
       "a node sticks while |tau| is below mu p, as in Peillex, Baillet and Berthier (IJTC2007-44438), or "
       "below a strength that itself relaxes to mu p"},
  };
}

FrictionChoice read_friction(const Options& options, const Surface& surface) {
  FrictionChoice choice;
  const std::string law = options.text("friction_law");
  if (law == "none")
    options.refuse_idle({"friction_coefficient"},
                        {"with -friction_law none", "give -friction_law coulomb", {"friction_law"}});
  if (law != "regularized") {
    auto memory = names_in(friction_schema());  // all that the other laws do not have
    std::erase(memory, "friction_law");
    std::erase(memory, "friction_coefficient");
    options.refuse_idle(memory,
                        {"with -friction_law " + law, "give -friction_law regularized", {"friction_law"}});
  }
  if (law == "none") return choice;
  choice.law = law == "coulomb" ? FrictionChoice::Law::coulomb : FrictionChoice::Law::regularized;
  const Quantity coefficient = options.quantity("friction_coefficient");
  choice.coefficient = coefficient.number;
  choice.coefficient_formula = coefficient.formula;
  if (choice.law == FrictionChoice::Law::coulomb) return choice;
  choice.stored_strength = options.text("friction_threshold") == "regularized";
  choice.by_slip_rate = options.text("friction_rate") == "slip";
  if (choice.by_slip_rate) {
    options.refuse_idle(
        {"friction_time"},
        {"with -friction_rate slip", "give -friction_length in its place", {"friction_rate"}});
    choice.length = options.real("friction_length");
    choice.rate_reference = options.real("friction_rate_reference");
    return choice;
  }
  options.refuse_idle({"friction_rate_reference"},
                      {"with -friction_rate surface", "give -friction_rate slip", {"friction_rate"}});
  options.refuse_both("friction_time", "friction_length");
  if (const auto time = options.find_real("friction_time")) {
    choice.time = *time;
  } else {
    choice.length = options.real("friction_length");
    if (surface.speed_formula)
      throw UserError(
          "-surface_speed is a formula, so that L*/|V| is no constant; give -friction_time in s, or "
          "-friction_rate slip");
    if (surface.speed == 0)
      throw UserError(
          "-surface_speed is 0, so the relaxation time L*/|V| is infinite; give -friction_time in s, "
          "or -friction_rate slip");
    choice.time = choice.length / std::abs(surface.speed);
  }
  return choice;
}

double shortest_memory(const FrictionChoice& choice, double surface_speed) {
  if (choice.law != FrictionChoice::Law::regularized) return std::numeric_limits<double>::infinity();
  if (!choice.by_slip_rate) return choice.time;
  return choice.length / (std::abs(surface_speed) + choice.rate_reference);
}

FrictionLaw friction_law(const FrictionChoice& choice, double time_step) {
  const double mu = choice.coefficient;
  if (choice.law == FrictionChoice::Law::none) return Frictionless{};
  const bool relaxes = (choice.by_slip_rate ? choice.length : choice.time) > 0;
  if (choice.law == FrictionChoice::Law::coulomb || !relaxes) return Coulomb{mu};
  if (choice.by_slip_rate) {
    if (choice.stored_strength)
      return SlipRate<RegularisedStrength>{mu, choice.length, choice.rate_reference, time_step};
    return SlipRate<RegularisedInstantaneous>{mu, choice.length, choice.rate_reference, time_step};
  }
  const Relaxation step = relaxation(time_step / choice.time);
  if (choice.stored_strength) return RegularisedStrength{mu, step};
  return RegularisedInstantaneous{mu, step};
}

FrictionLaws friction_laws(const FrictionChoice& choice, double time_step,
                           const std::vector<Vector2>& nodes) {
  const auto one_each = [&](const auto& law) -> FrictionLaws {
    if constexpr (requires { law.coefficient; }) {
      if (choice.varies()) return std::vector(nodes.size(), law);
    }
    return law;
  };
  FrictionLaws laws = std::visit(one_each, friction_law(choice, time_step));
  if (choice.varies()) (void)follow(choice, 0, nodes, laws);
  return laws;
}

bool follow(const FrictionChoice& choice, double time, const std::vector<Vector2>& nodes,
            FrictionLaws& laws) {
  bool sound = true;
  const auto set = [&](auto& each) {
    if constexpr (requires { each.begin(); }) {
      for (std::size_t k = 0; k < nodes.size(); ++k) {
        const double mu = choice.mu().at(nodes[k], time);
        sound = sound && mu >= 0 && std::isfinite(mu);
        each[k].coefficient = mu;
      }
    }
  };
  std::visit(set, laws);
  return sound;
}

std::string describe(const FrictionChoice& choice) {
  if (choice.law == FrictionChoice::Law::none) return "none";
  const std::string mu = choice.coefficient_formula ? "mu " + choice.coefficient_formula->text()
                                                    : format("mu {:g}", choice.coefficient);
  if (choice.law == FrictionChoice::Law::coulomb) return "coulomb, " + mu;
  const std::string relaxation =
      choice.by_slip_rate
          ? format("T = L/(|slip rate| + V*), L {:g} m, V* {:g} m/s", choice.length, choice.rate_reference)
          : "T " + engineering(choice.time, "s");
  return "regularized, " + mu + ", " + relaxation + ", threshold " +
         (choice.stored_strength ? "regularized" : "instantaneous");
}

}  // namespace slipscale
