#include "friction_text.hpp"

#include "slipscale/base/print.hpp"

namespace slipscale {
namespace {

std::string text_of(const Quantity& number) {
  return number.formula ? number.formula->text() : format("{:g}", number.number);
}

std::string mu_text(const FrictionChoice& choice, const FrictionConstants& constants) {
  const std::string text = "mu " + text_of(constants.coefficient);
  if (choice.law != FrictionChoice::Law::exponential) return text;
  return text + " falling to " + text_of(constants.kinetic) + format(" over {:g} m/s", constants.slip_rate);
}

}  // namespace

std::string constants_text(const FrictionChoice& choice, const FrictionConstants& constants) {
  const std::string text = mu_text(choice, constants);
  if (!choice.remembers()) return text;
  return text + (choice.by_slip_rate ? format(", L {:g} m", constants.length)
                                     : ", T " + engineering(constants.time, "s"));
}

std::string describe(const FrictionChoice& choice) {
  if (choice.law == FrictionChoice::Law::none) return "none";
  const FrictionConstants all{choice.mu(), choice.time, choice.length, choice.kinetic, choice.slip_rate};
  std::string text = choice.each_its_own ? "" : ", " + constants_text(choice, all);
  for (const std::string& phase : choice.phase_texts) text += ", in " + phase;
  if (choice.law == FrictionChoice::Law::coulomb) return "coulomb" + text;
  if (choice.law == FrictionChoice::Law::exponential) return "exponential" + text;
  if (choice.by_slip_rate) text += format(", T = L/(|slip rate| + V*), V* {:g} m/s", choice.rate_reference);
  return "regularized" + text + ", threshold " + (choice.stored_strength ? "regularized" : "instantaneous");
}

}  // namespace slipscale
