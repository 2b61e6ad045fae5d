#include "slipscale/contact/law.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>

#include "slipscale/contact/law_at_node.hpp"

namespace slipscale {

bool FrictionChoice::of_time() const {
  return mu().of_time() || kinetic.of_time() || std::ranges::any_of(phases, [](const auto& phase) {
           return phase.coefficient.of_time() || phase.kinetic.of_time();
         });
}

double shortest_memory(const FrictionChoice& choice, double surface_speed) {
  if (!choice.remembers()) return std::numeric_limits<double>::infinity();
  double time = choice.time, length = choice.length;
  if (!choice.phases.empty()) time = length = std::numeric_limits<double>::infinity();
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
  if (choice.law == FrictionChoice::Law::exponential)
    return Exponential{mu, choice.kinetic.number, choice.slip_rate, step};
  if (choice.stored_strength) return RegularisedStrength{mu, step};
  return RegularisedInstantaneous{mu, step};
}

namespace {

double between(double first, double second, double part) { return first + (second - first) * part; }

struct Coefficients {
  double still, kinetic;
};

Coefficients coefficients_at(const FrictionChoice& choice, const ContactPlace& node, double time) {
  if (choice.phases.empty()) return {choice.mu().at(node.place, time), choice.kinetic.at(node.place, time)};
  const FrictionConstants &a = choice.phases[node.region[0]], &b = choice.phases[node.region[1]];
  const auto mean = [&](const Quantity& first, const Quantity& second) {
    return between(first.at(node.place, time), second.at(node.place, time), node.second);
  };
  return {mean(a.coefficient, b.coefficient), mean(a.kinetic, b.kinetic)};
}

}  // namespace

FrictionChoice friction_at(const FrictionChoice& choice, const ContactPlace& node, double time) {
  FrictionChoice own = choice;
  own.phases.clear();
  own.coefficient_formula = nullptr;
  const auto [still, kinetic] = coefficients_at(choice, node, time);
  own.coefficient = still;
  own.kinetic = {kinetic};
  if (choice.phases.empty()) return own;
  const FrictionConstants &a = choice.phases[node.region[0]], &b = choice.phases[node.region[1]];
  own.time = between(a.time, b.time, node.second);
  own.length = between(a.length, b.length, node.second);
  own.slip_rate = between(a.slip_rate, b.slip_rate, node.second);
  return own;
}

namespace {

/// As `friction_law`, but of one kind whatever the constants: without time or length to relax over, a
/// regularised law is Coulomb's by its weights.
template <class Law>
Law law_of(const FrictionChoice& own, double time_step) {
  if constexpr (std::is_same_v<Law, Coulomb>) {
    return {own.coefficient};
  } else if constexpr (std::is_same_v<Law, Exponential>) {
    return {own.coefficient, own.kinetic.number, own.slip_rate, relaxation(time_step / own.time)};
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
  for (const ContactPlace& node : nodes) laws.push_back(law_of<Law>(friction_at(choice, node, 0), time_step));
  return laws;
}

}  // namespace

FrictionLaws friction_laws(const FrictionChoice& choice, double time_step,
                           const std::vector<ContactPlace>& nodes) {
  if (!choice.varies())
    return std::visit([](const auto& law) -> FrictionLaws { return law; }, friction_law(choice, time_step));
  if (choice.law == FrictionChoice::Law::coulomb) return one_each<Coulomb>(choice, time_step, nodes);
  if (choice.law == FrictionChoice::Law::exponential) return one_each<Exponential>(choice, time_step, nodes);
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
        const auto [still, kinetic] = coefficients_at(choice, nodes[k], time);
        sound = sound && still >= 0 && std::isfinite(still) && kinetic >= 0 && std::isfinite(kinetic);
        each[k].coefficient = still;
        if constexpr (requires { each[k].kinetic; }) each[k].kinetic = kinetic;
      }
    }
  };
  std::visit(set, laws);
  return sound;
}

}  // namespace slipscale
