#include "slipscale/contact/law.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "slipscale/base/error.hpp"
#include "slipscale/base/physical_range.hpp"
#include "slipscale/base/print.hpp"

namespace slipscale {
namespace {

std::string mu_text(const Quantity& coefficient) {
  return coefficient.formula ? "mu " + coefficient.formula->text() : format("mu {:g}", coefficient.number);
}

std::string constants_text(const FrictionChoice& choice, const FrictionConstants& constants) {
  std::string text = mu_text(constants.coefficient);
  if (choice.law != FrictionChoice::Law::regularized) return text;
  return text + (choice.by_slip_rate ? format(", L {:g} m", constants.length)
                                     : ", T " + engineering(constants.time, "s"));
}

std::vector<std::string> of_region(const std::string& region) {
  const std::string prefix = "friction_" + region + "_";
  return {prefix + "coefficient", prefix + "length", prefix + "time"};
}

}  // namespace

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
      {"friction_<region>_coefficient", Kind::real, "1", absent,
       range::or_formula(range::physical_non_negative, "xt"),
       "the coefficient of the phase of that region, in place of friction_coefficient; a node between two "
       "regions "
       "takes the mean by the lengths of their edges"},
      {"friction_<region>_length", Kind::real, "m", absent, range::physical_non_negative,
       "the slip distance of that phase, in place of friction_length"},
      {"friction_<region>_time", Kind::real, "s", absent, range::physical_non_negative,
       "the relaxation time of that phase, in place of friction_time"},
      {"friction_rate", Kind::text, "", "surface", range::one_of({"surface", "slip"}),
       "what T is made with: the surface's speed, T = L*/|V|, or the slip rate, T = L/(|slip rate| + V*)"},
      {"friction_rate_reference", Kind::real, "m/s", required, range::physical_positive,
       "V* of `rate: slip`"},
      {"friction_threshold", Kind::text, "", "instantaneous", range::one_of({"instantaneous", "regularized"}),
       "a node sticks while |tau| is below mu p, as in Peillex, Baillet and Berthier (IJTC2007-44438), or "
       "below a strength that itself relaxes to mu p"},
  };
}

std::vector<std::string> friction_options(const std::vector<std::string>& regions) {
  std::vector<std::string> names;
  for (const Option& option : friction_schema())
    if (option.name.find('<') == std::string::npos) names.push_back(option.name);
  for (const std::string& region : regions)
    for (const std::string& name : of_region(region)) names.push_back(name);
  return names;
}

namespace {

/// The constants written under a prefix; those that are not are `others`.
FrictionConstants read_constants(const Options& options, const std::string& prefix, const Surface& surface,
                                 const FrictionChoice& choice, const FrictionConstants* others) {
  FrictionConstants constants = others ? *others : FrictionConstants{};
  if (!others || options.given(prefix + "coefficient"))
    constants.coefficient = options.quantity(prefix + "coefficient");
  if (choice.law == FrictionChoice::Law::coulomb) return constants;
  const std::string time_name = prefix + "time", length_name = prefix + "length";
  if (choice.by_slip_rate) {
    options.refuse_idle(
        {time_name},
        {"with -friction_rate slip", "give -" + length_name + " in its place", {"friction_rate"}});
    if (!others || options.given(length_name)) constants.length = options.real(length_name);
    return constants;
  }
  options.refuse_both(time_name, length_name);
  if (const auto time = options.find_real(time_name)) {
    constants.time = *time;
  } else if (!others || options.given(length_name)) {
    constants.length = options.real(length_name);
    if (surface.speed_formula)
      throw UserError("-surface_speed is a formula, so that L*/|V| is no constant; give -" + time_name +
                      " in s, or -friction_rate slip");
    if (surface.speed == 0)
      throw UserError("-surface_speed is 0, so the relaxation time L*/|V| is infinite; give -" + time_name +
                      " in s, or -friction_rate slip");
    constants.time = constants.length / std::abs(surface.speed);
  }
  return constants;
}

void read_phases(const Options& options, const Surface& surface, const std::vector<std::string>& regions,
                 const std::vector<char>& touches, FrictionChoice& choice) {
  const FrictionConstants all{choice.mu(), choice.time, choice.length};
  bool any = false;
  std::vector<FrictionConstants> phases(regions.size(), all);
  for (std::size_t r = 0; r < regions.size(); ++r) {
    const auto names = of_region(regions[r]);
    if (!touches[r])
      options.refuse_idle(
          names,
          {"since no edge of region '" + regions[r] + "' meets the surface", "name a region that does", {}});
    if (std::ranges::none_of(names, [&](const auto& name) { return options.given(name); })) continue;
    any = true;
    phases[r] = read_constants(options, "friction_" + regions[r] + "_", surface, choice, &all);
    choice.phase_texts.push_back(regions[r] + ": " + constants_text(choice, phases[r]));
  }
  if (any) choice.phases = phases;
}

}  // namespace

FrictionChoice read_friction(const Options& options, const Surface& surface,
                             const std::vector<std::string>& regions, const std::vector<char>& touches) {
  FrictionChoice choice;
  const std::string law = options.text("friction_law");
  const auto idle = [&](const std::string& suffix, const std::string& with, const std::string& cure) {
    auto names = friction_options(regions);
    std::erase_if(names, [&](const auto& name) {
      return name == "friction_law" ||
             (suffix.empty() ? name.ends_with("coefficient") : !name.ends_with(suffix));
    });
    options.refuse_idle(names,
                        {"with -friction_law " + with, "give -friction_law " + cure, {"friction_law"}});
  };
  if (law == "none") idle("coefficient", law, "coulomb");
  if (law != "regularized") idle("", law, "regularized");  // all that the other laws do not have
  if (law == "none") return choice;
  choice.law = law == "coulomb" ? FrictionChoice::Law::coulomb : FrictionChoice::Law::regularized;
  if (choice.law == FrictionChoice::Law::regularized) {
    choice.stored_strength = options.text("friction_threshold") == "regularized";
    choice.by_slip_rate = options.text("friction_rate") == "slip";
    if (!choice.by_slip_rate)
      options.refuse_idle({"friction_rate_reference"},
                          {"with -friction_rate surface", "give -friction_rate slip", {"friction_rate"}});
  }
  const FrictionConstants constants = read_constants(options, "friction_", surface, choice, nullptr);
  if (choice.by_slip_rate) choice.rate_reference = options.real("friction_rate_reference");
  choice.coefficient = constants.coefficient.number;
  choice.coefficient_formula = constants.coefficient.formula;
  choice.time = constants.time;
  choice.length = constants.length;
  read_phases(options, surface, regions, touches, choice);
  return choice;
}

bool FrictionChoice::of_time() const {
  return mu().of_time() ||
         std::ranges::any_of(phases, [](const auto& phase) { return phase.coefficient.of_time(); });
}

double shortest_memory(const FrictionChoice& choice, double surface_speed) {
  if (choice.law != FrictionChoice::Law::regularized) return std::numeric_limits<double>::infinity();
  double time = choice.time, length = choice.length;
  for (const FrictionConstants& phase : choice.phases) {
    time = std::min(time, phase.time);
    length = std::min(length, phase.length);
  }
  return choice.by_slip_rate ? length / (std::abs(surface_speed) + choice.rate_reference) : time;
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

namespace {

double between(double first, double second, double part) { return first + (second - first) * part; }

/// A node's own constants, with the coefficient at a time.
FrictionChoice at_place(const FrictionChoice& choice, const ContactPlace& node, double time) {
  FrictionChoice own = choice;
  own.phases.clear();
  own.coefficient_formula = nullptr;
  if (choice.phases.empty()) {
    own.coefficient = choice.mu().at(node.place, time);
    return own;
  }
  const FrictionConstants &a = choice.phases[node.region[0]], &b = choice.phases[node.region[1]];
  own.coefficient =
      between(a.coefficient.at(node.place, time), b.coefficient.at(node.place, time), node.second);
  own.time = between(a.time, b.time, node.second);
  own.length = between(a.length, b.length, node.second);
  return own;
}

/// As `friction_law`, but of one kind whatever the constants: without time or length to relax over, a
/// regularised law is Coulomb's by its weights.
template <class Law>
Law law_of(const FrictionChoice& own, double time_step) {
  if constexpr (std::is_same_v<Law, Coulomb>) {
    return {own.coefficient};
  } else if constexpr (Law::uses_slip_rate) {
    constexpr double least = 1e-200;  // m
    return {own.coefficient, std::max(own.length, least), own.rate_reference, time_step};
  } else {
    const double x = own.time > 0 ? time_step / own.time : std::numeric_limits<double>::infinity();
    return {own.coefficient, relaxation(x)};
  }
}

template <class Law>
FrictionLaws one_each(const FrictionChoice& choice, double time_step,
                      const std::vector<ContactPlace>& nodes) {
  std::vector<Law> laws;
  for (const ContactPlace& node : nodes) laws.push_back(law_of<Law>(at_place(choice, node, 0), time_step));
  return laws;
}

}  // namespace

FrictionLaws friction_laws(const FrictionChoice& choice, double time_step,
                           const std::vector<ContactPlace>& nodes) {
  if (!choice.varies())
    return std::visit([](const auto& law) -> FrictionLaws { return law; }, friction_law(choice, time_step));
  if (choice.law == FrictionChoice::Law::coulomb) return one_each<Coulomb>(choice, time_step, nodes);
  if (choice.by_slip_rate)
    return choice.stored_strength ? one_each<SlipRate<RegularisedStrength>>(choice, time_step, nodes)
                                  : one_each<SlipRate<RegularisedInstantaneous>>(choice, time_step, nodes);
  return choice.stored_strength ? one_each<RegularisedStrength>(choice, time_step, nodes)
                                : one_each<RegularisedInstantaneous>(choice, time_step, nodes);
}

bool follow(const FrictionChoice& choice, double time, const std::vector<ContactPlace>& nodes,
            FrictionLaws& laws) {
  bool sound = true;
  const auto set = [&](auto& each) {
    if constexpr (requires { each.begin(); }) {
      for (std::size_t k = 0; k < nodes.size(); ++k) {
        double mu = 0;
        if (choice.phases.empty()) {
          mu = choice.mu().at(nodes[k].place, time);
        } else {
          const auto& [place, region, second] = nodes[k];
          mu = between(choice.phases[region[0]].coefficient.at(place, time),
                       choice.phases[region[1]].coefficient.at(place, time), second);
        }
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
  std::string mu = mu_text(choice.mu());
  for (const std::string& text : choice.phase_texts) mu += ", in " + text;
  if (choice.law == FrictionChoice::Law::coulomb) return "coulomb, " + mu;
  const std::string relaxation =
      choice.by_slip_rate
          ? format("T = L/(|slip rate| + V*), L {:g} m, V* {:g} m/s", choice.length, choice.rate_reference)
          : "T " + engineering(choice.time, "s");
  return "regularized, " + mu + ", " + relaxation + ", threshold " +
         (choice.stored_strength ? "regularized" : "instantaneous");
}

}  // namespace slipscale
