// The part of Options that sees to it that what the user wrote has an effect.
#include <algorithm>

#include "names.hpp"
#include "slipscale/base/error.hpp"
#include "slipscale/base/options.hpp"

namespace slipscale {

Origin Options::origin(const std::string& name) const {
  const auto found = origins_.find(name);
  return found == origins_.end() ? Origin{} : found->second;
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
  notes_.push_back("note: -" + name + (own.place.empty() ? "" : " of " + own.place) + " " + why + " (" +
                   origin(*later).place + "); it is set aside");
  return true;
}

void Options::refuse_idle(const std::vector<std::string>& names, const Idle& idle) const {
  const std::string why = "has no effect " + idle.why;
  for (const std::string& name : names)
    if (given(name) && !overruled(name, idle.causes, why))
      throw UserError("-" + name + " " + why + "; remove it, or " + idle.cure);
}

void Options::refuse_both(const std::string& one, const std::string& other) const {
  if (!given(one) || !given(other)) return;
  if (overruled(one, {other}, "gives way to -" + other) || overruled(other, {one}, "gives way to -" + one))
    return;
  throw UserError("-" + one + " contradicts -" + other + "; give one of them");
}

void Options::refuse_unread() const {
  for (const std::string& name : typed_) {
    const Option* option = match(name).option;
    if (!option || names::ignored(names::pattern(option->name))) continue;
    if (given(name) && !effective_.contains(name))
      throw UserError("-" + name + " has no effect in this scene; remove it (" + program_ +
                      " -help says what it belongs to)");
  }
}

}  // namespace slipscale
