// The part of Options that sees to it that what the user wrote has an effect.
#include <algorithm>
#include <stdexcept>

#include "names.hpp"
#include "slipscale/base/error.hpp"
#include "slipscale/base/options.hpp"

namespace slipscale {

Origin Options::origin(const std::string& name) const {
  const auto found = given_.find(name);
  return found == given_.end() ? Origin{} : found->second.origin;
}

bool Options::overruled(const std::string& name, const std::vector<std::string>& by,
                        const std::string& why) const {
  const Origin own = origin(name);
  const auto later = std::find_if(by.begin(), by.end(), [&](const std::string& other) {
    return given(other) && origin(other).order > own.order;
  });
  if (later == by.end()) return false;
  aside_.insert(name);
  effective_.erase(name);
  notes_.push_back("-" + name + (own.place.empty() ? "" : " of " + own.place) + " " + why + " (" +
                   origin(*later).place + "); it is set aside");
  return true;
}

void Options::refuse_idle(const std::vector<std::string>& names, const Idle& idle) const {
  const std::string why = "has no effect " + idle.why;
  // A flag that is given as false, as it is by default, asks for nothing that could be idle.
  const auto is_off = [this](const std::string& name) {
    const Option& option = *match(name).option;
    return option.kind == Kind::flag && option.fallback == "false" && !flag(name);
  };
  for (const std::string& name : names)
    if (given(name) && !is_off(name) && !overruled(name, idle.causes, why))
      throw UserError("-" + name + " " + why + "; remove it, or " + idle.cure);
}

void Options::refuse_both(const std::string& one, const std::string& other) const {
  const bool both = given(one) & given(other);
  if (!both) return;
  if (overruled(one, {other}, "gives way to -" + other) || overruled(other, {one}, "gives way to -" + one))
    return;
  throw UserError("-" + one + " contradicts -" + other + "; give one of them");
}

/// Every declared option must be known to some reader, for one name at least that its placeholder may have.
void Options::refuse_forgotten() const {
  std::set<const Option*> known;
  for (const std::string& name : touched_) known.insert(match(name).option);
  for (const Option& option : schema_) {
    const names::Pattern parts = names::pattern(option.name);
    const auto fillings = names_.find(parts.placeholder);
    if (names::ignored(parts) || (fillings != names_.end() && fillings->second.empty())) continue;
    if (!known.contains(&option))
      throw std::logic_error("-" + option.name + " is declared, but no reader of " + program_ +
                             " asks for it or says why it is idle");
  }
}

void Options::refuse_unread() const {
  for (const std::string& name : typed_) refuse_if_unknown(name, true);
  for (const std::string& name : typed_) {
    const Option* option = match(name).option;
    if (!option || names::ignored(names::pattern(option->name))) continue;
    if (given(name) && !effective_.contains(name))
      refuse(name, "-" + name + " has no effect in this scene; remove it (" + program_ +
                       " -help says what it belongs to)");
  }
  refuse_forgotten();
}

}  // namespace slipscale
