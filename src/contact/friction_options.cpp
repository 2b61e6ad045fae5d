// Options of friction: what there is, and what a scene has chosen.
#include <algorithm>
#include <cmath>

#include "friction_text.hpp"
#include "slipscale/base/error.hpp"
#include "slipscale/base/physical_range.hpp"
#include "slipscale/contact/law.hpp"

namespace slipscale {
namespace {

/// What may differ from region to region.
const std::vector<std::string> keys{"coefficient", "kinetic", "slip_rate", "length", "time"};

std::vector<std::string> of_region(const std::string& region) {
  std::vector<std::string> names;
  for (const std::string& key : keys) names.push_back("friction_" + region + "_" + key);
  return names;
}

}  // namespace

Schema friction_schema() {
  return {
      {"friction_law", Kind::text, "", required,
       range::one_of({"none", "coulomb", "regularized", "exponential"}),
       "law of friction between body and surface; regularized is the simplified Prakash-Clifton law, "
       "exponential the same with a coefficient that goes from static to kinetic with the slip rate v, "
       "kinetic + (coefficient - kinetic) exp(-|v|/slip_rate)"},
      {"friction_coefficient", Kind::real, "1", required,
       range::or_formula(range::physical_non_negative, "xt"),
       "coefficient of friction, mu; of the exponential law that of a contact that sticks"},
      {"friction_kinetic", Kind::real, "1", required, range::or_formula(range::physical_non_negative, "xt"),
       "coefficient of fast slip, of the exponential law"},
      {"friction_slip_rate", Kind::real, "m/s", required, range::physical_positive,
       "slip rate over which the coefficient comes within 1/e of the kinetic one, of the exponential law"},
      {"friction_length", Kind::real, "m", required, range::physical_non_negative,
       "slip distance over which the traction follows the pressure, L*, of the regularised and the "
       "exponential "
       "law; T = L*/|V|"},
      {"friction_time", Kind::real, "s", absent, range::physical_non_negative,
       "relaxation time T itself of these laws, in place of the length"},
      {"friction_<region>_coefficient", Kind::real, "1", absent,
       range::or_formula(range::physical_non_negative, "xt"),
       "the coefficient of the phase of that region, in place of friction_coefficient; a node between two "
       "regions takes the mean by the lengths of their edges"},
      {"friction_<region>_kinetic", Kind::real, "1", absent,
       range::or_formula(range::physical_non_negative, "xt"),
       "the coefficient of fast slip of that phase, in place of friction_kinetic"},
      {"friction_<region>_slip_rate", Kind::real, "m/s", absent, range::physical_positive,
       "the slip rate of that phase, in place of friction_slip_rate"},
      {"friction_<region>_length", Kind::real, "m", absent, range::physical_non_negative,
       "the slip distance of that phase, in place of friction_length"},
      {"friction_<region>_time", Kind::real, "s", absent, range::physical_non_negative,
       "the relaxation time of that phase, in place of friction_time"},
      {"friction_rate", Kind::text, "", "surface", range::one_of({"surface", "slip"}),
       "of the regularised law, what T is made with: the surface's speed, T = L*/|V|, or the slip rate, T = "
       "L/(|slip rate| + V*)"},
      {"friction_rate_reference", Kind::real, "m/s", required, range::physical_positive,
       "V* of `rate: slip` of the regularised law"},
      {"friction_threshold", Kind::text, "", "instantaneous", range::one_of({"instantaneous", "regularized"}),
       "of the regularised law: a node sticks while |tau| is below mu p, as in Peillex, Baillet and Berthier "
       "(IJTC2007-44438), or "
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

/// Who has which constants as their own.
struct Owners {
  const Options& options;
  const std::vector<std::string>& regions;
  const std::vector<char>& touches;

  bool given(std::size_t r, const std::string& key) const {
    return options.given("friction_" + regions[r] + "_" + key);
  }
  /// Every region that touches has one of these as its own.
  bool all_have(const std::vector<std::string>& either) const {
    for (std::size_t r = 0; r < regions.size(); ++r)
      if (touches[r] && std::ranges::none_of(either, [&](const auto& key) { return given(r, key); }))
        return false;
    return true;
  }
};

/// Reads constants under a prefix: those that are given and those that are `needed`; the others stay as they
/// were.
class ConstantsReader {
 public:
  ConstantsReader(const Options& options, const Surface& surface, const FrictionChoice& choice)
      : options_(options), surface_(surface), choice_(choice) {}

  template <class Needed>
  void read(const std::string& prefix, const Needed& needed, FrictionConstants& constants) const {
    const auto asks = [&](const std::string& key) { return options_.given(prefix + key) || needed({key}); };
    if (asks("coefficient")) constants.coefficient = options_.quantity(prefix + "coefficient");
    if (choice_.law == FrictionChoice::Law::coulomb) return;
    if (choice_.law == FrictionChoice::Law::exponential) {
      if (asks("kinetic")) constants.kinetic = options_.quantity(prefix + "kinetic");
      if (asks("slip_rate")) constants.slip_rate = options_.real(prefix + "slip_rate");
    }
    const std::string time = prefix + "time", length = prefix + "length";
    if (choice_.by_slip_rate) {
      options_.refuse_idle(
          {time}, {"with -friction_rate slip", "give -" + length + " in its place", {"friction_rate"}});
      if (asks("length")) constants.length = options_.real(length);
      return;
    }
    options_.refuse_both(time, length);
    if (const auto found = options_.find_real(time))
      constants.time = *found;
    else if (options_.given(length) || needed({"length", "time"}))
      by_length(time, options_.real(length), constants);
    if (choice_.law == FrictionChoice::Law::exponential && constants.time == 0 &&
        (options_.given(time) || options_.given(length)))
      throw UserError("-" + (options_.given(time) ? time : length) +
                      " is 0, but a coefficient that depends on the slip rate needs a memory: without, the "
                      "shortest waves grow without bound; give a time or length above 0");
  }

 private:
  void by_length(const std::string& time_name, double length, FrictionConstants& constants) const {
    const std::string cure =
        choice_.law == FrictionChoice::Law::exponential ? "" : ", or -friction_rate slip";
    if (surface_.speed_formula)
      throw UserError("-surface_speed is a formula, so that L*/|V| is no constant; give -" + time_name +
                      " in s" + cure);
    if (surface_.speed == 0)
      throw UserError("-surface_speed is 0, so the relaxation time L*/|V| is infinite; give -" + time_name +
                      " in s" + cure);
    constants.length = length;
    constants.time = length / std::abs(surface_.speed);
  }

  const Options& options_;
  const Surface& surface_;
  const FrictionChoice& choice_;
};

void read_phases(const ConstantsReader& reader, const Owners& owners, const FrictionConstants& all,
                 FrictionChoice& choice) {
  const auto& [options, regions, touches] = owners;
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
    reader.read(
        "friction_" + regions[r] + "_", [](const std::vector<std::string>&) { return false; }, phases[r]);
    choice.phase_texts.push_back(regions[r] + ": " + constants_text(choice, phases[r]));
  }
  if (!any) return;
  const auto first = static_cast<std::size_t>(std::ranges::find(touches, char{1}) - touches.begin());
  for (std::size_t r = 0; r < regions.size(); ++r)
    if (!touches[r]) phases[r] = phases[first];
  choice.phases = phases;
  choice.each_its_own = owners.all_have({"coefficient"});
}

/// Which keys each law has; refuses the others.
void refuse_idle_constants(const Options& options, const std::string& law,
                           const std::vector<std::string>& regions) {
  std::vector<std::string> own;
  if (law != "none") own.push_back("coefficient");
  if (law == "regularized") own.insert(own.end(), {"length", "time", "rate", "rate_reference", "threshold"});
  if (law == "exponential") own.insert(own.end(), {"length", "time", "kinetic", "slip_rate"});
  const auto refuse = [&](const std::string& key, const std::string& cure) {
    if (std::ranges::find(own, key) != own.end()) return;
    std::vector<std::string> names{"friction_" + key};
    if (std::ranges::find(keys, key) != keys.end())
      for (const std::string& region : regions) names.push_back("friction_" + region + "_" + key);
    options.refuse_idle(names, {"with -friction_law " + law, "give -friction_law " + cure, {"friction_law"}});
  };
  refuse("coefficient", "coulomb");
  for (const char* key : {"length", "time", "rate", "rate_reference", "threshold"})
    refuse(key, "regularized");
  for (const char* key : {"kinetic", "slip_rate"}) refuse(key, "exponential");
}

}  // namespace

FrictionChoice read_friction(const Options& options, const Surface& surface,
                             const std::vector<std::string>& regions, const std::vector<char>& touches) {
  FrictionChoice choice;
  const std::string law = options.text("friction_law");
  refuse_idle_constants(options, law, regions);
  if (law == "none") return choice;
  choice.law = law == "coulomb"       ? FrictionChoice::Law::coulomb
               : law == "exponential" ? FrictionChoice::Law::exponential
                                      : FrictionChoice::Law::regularized;
  if (choice.law == FrictionChoice::Law::regularized) {
    choice.stored_strength = options.text("friction_threshold") == "regularized";
    choice.by_slip_rate = options.text("friction_rate") == "slip";
    if (!choice.by_slip_rate)
      options.refuse_idle({"friction_rate_reference"},
                          {"with -friction_rate surface", "give -friction_rate slip", {"friction_rate"}});
  }
  const ConstantsReader reader(options, surface, choice);
  const Owners owners{options, regions, touches};
  FrictionConstants all;
  reader.read(
      "friction_", [&](const std::vector<std::string>& either) { return !owners.all_have(either); }, all);
  if (choice.by_slip_rate) choice.rate_reference = options.real("friction_rate_reference");
  choice.coefficient = all.coefficient.number;
  choice.coefficient_formula = all.coefficient.formula;
  choice.time = all.time;
  choice.length = all.length;
  choice.kinetic = all.kinetic;
  choice.slip_rate = all.slip_rate;
  read_phases(reader, owners, all, choice);
  return choice;
}

}  // namespace slipscale
