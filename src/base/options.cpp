#include "slipscale/base/options.hpp"

#include <stdexcept>

#include "names.hpp"
#include "slipscale/base/error.hpp"
#include "value.hpp"

namespace slipscale {
namespace {

[[noreturn]] void missing(const std::string& name, const Option& option) {
  const std::string what = option.help.substr(0, option.help.find_last_not_of('.') + 1);
  throw UserError("-" + name + " is needed here but not given (" + what + "); it must be " +
                  value::wanted(option));
}

}  // namespace

Schema operator+(Schema left, const Schema& right) {
  left.insert(left.end(), right.begin(), right.end());
  return left;
}

std::vector<std::string> names_in(const Schema& schema, const std::string& beginning,
                                  const std::string& filling) {
  std::vector<std::string> found;
  for (const Option& option : schema) {
    const names::Pattern parts = names::pattern(option.name);
    if (!option.name.starts_with(beginning) || names::ignored(parts)) continue;
    found.push_back(parts.placeholder.empty() ? option.name : parts.prefix + filling + parts.suffix);
  }
  return found;
}

const Written* Options::find(const std::string& name) const {
  const auto found = given_.find(name);
  return found == given_.end() || aside_.contains(name) ? nullptr : &found->second;
}

std::optional<std::string> Options::value(const std::string& name) const {
  const Match found = match(name);
  if (!found.option) throw std::logic_error("option '" + name + "' is read but no schema declares it");
  const Option& option = *found.option;
  touched_.insert(name);
  if (const Written* entry = find(name)) {
    check(*entry);
    return effective_[name] = entry->value.value_or("true");
  }
  if (option.fallback == required) missing(name, option);
  if (option.fallback == absent) return std::nullopt;
  if (!option.fallback.empty()) effective_[name] = option.fallback;
  return option.fallback;
}

std::string Options::needed(const std::string& name) const {
  const auto text = value(name);
  if (!text) missing(name, *match(name).option);
  return *text;
}

bool Options::given(const std::string& name) const {
  touched_.insert(name);
  return find(name) != nullptr;
}

double Options::real(const std::string& name) const {
  const auto x = find_real(name);
  if (!x) missing(name, *match(name).option);
  return *x;
}

std::optional<double> Options::find_real(const std::string& name) const {
  const auto text = value(name);
  if (!text) return std::nullopt;
  const auto x = value::number(*text);
  // `auto` of a text that may be a number as well: the caller has to ask for the text first.
  if (!x) throw std::logic_error("option '" + name + "' is read as a number but holds '" + *text + "'");
  return x;
}

PetscInt Options::integer(const std::string& name) const {
  const auto n = find_integer(name);
  if (!n) missing(name, *match(name).option);
  return *n;
}

std::optional<PetscInt> Options::find_integer(const std::string& name) const {
  const auto text = value(name);
  if (!text) return std::nullopt;
  const auto n = value::integer(*text);
  if (!n) throw std::logic_error("option '" + name + "' is read as a whole number but holds '" + *text + "'");
  return n;
}

std::string Options::text(const std::string& name) const { return needed(name); }

std::optional<std::string> Options::find_text(const std::string& name) const { return value(name); }

bool Options::flag(const std::string& name) const {
  const auto truth = value::truth(needed(name));
  if (!truth) throw std::logic_error("option '" + name + "' is read as a flag but is declared otherwise");
  return *truth;
}

std::vector<double> Options::reals(const std::string& name) const {
  std::vector<double> numbers;
  for (const std::string& item : value::items(value(name).value_or(""))) {
    const auto x = value::number(item);
    if (!x) throw std::logic_error("option '" + name + "' is read as numbers but is declared otherwise");
    numbers.push_back(*x);
  }
  return numbers;
}

}  // namespace slipscale
