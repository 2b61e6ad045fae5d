// The part of Options that takes formulas where numbers may stand.
#include <cctype>
#include <cmath>

#include "slipscale/base/error.hpp"
#include "slipscale/base/options.hpp"
#include "slipscale/base/print.hpp"
#include "value.hpp"

namespace slipscale {
namespace {

const std::string parameter_prefix = "parameters_";

/// As muParser takes names.
bool is_name(const std::string& text) {
  for (const char c : text)
    if (!std::isalnum(static_cast<unsigned char>(c)) && c != '_') return false;
  return !text.empty() && !std::isdigit(static_cast<unsigned char>(text.front()));
}

}  // namespace

Schema parameter_schema() {
  return {{parameter_prefix + "<parameter>", Kind::real, "SI unit of its own", absent, range::any,
           "a number of that name for formulas: with parameters_p0 1e6, a pressure may be p0*sin(pi*x/L). "
           "Beside parameters they know H and L, height and length of the block, and pi; functions and "
           "operators are muParser's"}};
}

std::vector<std::string> Options::parameters() const {
  std::vector<std::string> names;
  for (const std::string& name : typed_)
    if (name.starts_with(parameter_prefix)) names.push_back(name.substr(parameter_prefix.size()));
  return names;
}

void Options::know_constants(const std::map<std::string, double>& constants) {
  constants_ = constants;
  for (const std::string& name : parameters()) {
    if (!is_name(name))
      refuse(parameter_prefix + name, "-" + parameter_prefix + name + ": '" + name +
                                          "' is no name for a formula; write letters, digits and _");
    if (Formula::reserved(name, {constants_, {}, {}}))
      refuse(parameter_prefix + name, "-" + parameter_prefix + name + ": '" + name +
                                          "' has a meaning of its own in formulas; take another name");
  }
  know_names("parameter", parameters());
}

void Options::pass_over_parameters() const {
  for (const std::string& name : parameters()) (void)find_real(parameter_prefix + name);
}

Quantity Options::quantity_of(const Option& option, const std::string& name, const std::string& text) const {
  if (const auto x = value::number(text)) return {*x};
  const Formula::Names names{constants_, parameters(), [&](const std::string& parameter) {
                               return real(parameter_prefix + parameter);
                             }};
  const std::string refusal = "-" + name + " is '" + text + "', but it must be " + value::wanted(option);
  Quantity found{1, std::make_shared<const Formula>(text, option.range.variables, names, refusal)};
  if (!found.formula->is_constant()) return found;
  const double number = (*found.formula)(0);
  if (const std::string fault = outside(name, found, number); !fault.empty()) throw UserError(fault);
  return {number};
}

std::string Options::outside(const std::string& name, const Quantity& quantity, double value) const {
  const Option& option = *match(name).option;
  if (std::isfinite(value) && (!option.range.accepts || option.range.accepts(value))) return "";
  return format("-{} is '{}', which makes {:g}, but it must be {}", name,
                quantity.formula ? quantity.formula->text() : "", value, value::wanted(option));
}

Quantity Options::quantity(const std::string& name) const {
  const std::string text = needed(name);
  return quantity_of(*match(name).option, name, text);
}

std::vector<Quantity> Options::quantities(const std::string& name) const {
  std::vector<Quantity> found;
  for (const std::string& item : value::items(value(name).value_or("")))
    found.push_back(quantity_of(*match(name).option, name, item));
  return found;
}

}  // namespace slipscale
