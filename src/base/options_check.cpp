// The part of Options that looks for what the user wrote and nobody will read.
#include <algorithm>
#include <stdexcept>

#include "names.hpp"
#include "slipscale/base/error.hpp"
#include "slipscale/base/options.hpp"
#include "spelling.hpp"
#include "value.hpp"

namespace slipscale {
namespace {

/// Options nobody has asked PETSc for yet.
std::vector<std::string> unread() {
  PetscInt count = 0;
  char **options = nullptr, **values = nullptr;
  petsc(PetscOptionsLeftGet(nullptr, &count, &options, &values));
  const std::vector<std::string> result(options, options + count);
  petsc(PetscOptionsLeftRestore(nullptr, &count, &options, &values));
  return result;
}

bool known_as(const names::Known& known, const std::string& placeholder, const std::string& filled) {
  const auto found = known.find(placeholder);
  return found == known.end() ||
         std::find(found->second.begin(), found->second.end(), filled) != found->second.end();
}

std::string joined(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

/// The declared spelling of a name that differs from it in capitals only; empty when there is none.
std::string respelled(const std::string& name, const Schema& schema, const names::Known& known) {
  for (const Option& option : schema) {
    const names::Pattern parts = names::pattern(option.name);
    const auto found = names::filling(parts, spelling::fold(name));
    if (!found) continue;
    const std::string filled =
        name.substr(parts.placeholder.empty() ? name.size() : parts.prefix.size(), found->size());
    const auto fillings = known.find(parts.placeholder);
    if (fillings == known.end()) return parts.prefix + filled + parts.suffix;
    for (const std::string& candidate : fillings->second)
      if (spelling::fold(candidate) == *found) return parts.prefix + candidate + parts.suffix;
  }
  return "";
}

/// PETSc keeps the spelling it meets first and folds later ones into it, so that `-Time_end` behind
/// `-time_end` leaves no trace in its database.
std::vector<std::string> with_other_spellings(std::vector<std::string> names, const Origins& origins) {
  std::map<std::string, std::string> stored;
  for (const std::string& name : names) stored.emplace(spelling::fold(name), name);
  for (const auto& [written, origin] : origins) {
    const auto found = stored.find(spelling::fold(written));
    if (found != stored.end() && found->second != written) names.push_back(written);
  }
  return names;
}

void check_fallback(const Option& option) {
  if (option.fallback == required || option.fallback == absent || option.fallback.empty()) return;
  try {
    value::check(option, option.name, option.fallback);
  } catch (const UserError& error) {
    throw std::logic_error(std::string("the schema's own default is wrong: ") + error.what());
  }
}

}  // namespace

Options::Options(std::string program, Schema schema, Origins origins)
    : program_(std::move(program)), schema_(std::move(schema)), origins_(std::move(origins)) {
  for (const Option& option : schema_) check_fallback(option);
  typed_ = with_other_spellings(unread(), origins_);
  for (const std::string& name : typed_) {
    refuse_if_unknown(name);
    const Match found = match(name);
    // Asking for the value checks it, and its place in `run.yaml` has to be earned by a reader.
    if (found.option && !names::ignored(names::pattern(found.option->name))) (void)value(name);
  }
  effective_.clear();
}

Options::Match Options::match(const std::string& name) const {
  Match best;
  bool best_known = false;
  for (const Option& option : schema_) {
    const names::Pattern parts = names::pattern(option.name);
    const auto filled = names::filling(parts, name);
    if (!filled) continue;
    if (parts.placeholder.empty()) return {&option, ""};
    const bool is_known = names_.contains(parts.placeholder) && known_as(names_, parts.placeholder, *filled);
    if (best.option &&
        (best_known > is_known || (best_known == is_known && best.filled.size() >= filled->size())))
      continue;
    best = {&option, *filled};
    best_known = is_known;
  }
  return best;
}

void Options::refuse_if_unknown(const std::string& name) const {
  const Match found = match(name);
  const std::string placeholder = found.option ? names::pattern(found.option->name).placeholder : "";
  if (found.option && known_as(names_, placeholder, found.filled)) return;
  if (!found.option && (names::petsc_object(name) || names::petsc_system(name))) return;

  const std::string spelled = respelled(name, schema_, names_);
  if (!spelled.empty() && spelled != name)
    throw UserError("-" + name + " differs in capitals from the option it means; write -" + spelled);
  const std::string near = names::meant(name, schema_, names_);
  if (found.option) {
    throw UserError(
        "-" + name + " names the " + placeholder + " '" + found.filled + "', which the mesh does not have" +
        (near.empty() || near == "-" + name ? "" : "; did you mean " + near + "?") + " (the mesh has " +
        (names_.at(placeholder).empty() ? "none" : joined(names_.at(placeholder))) + ")");
  }
  throw UserError("-" + name + " is not an option of " + program_ +
                  (near.empty() ? "; see " + program_ + " -help" : "; did you mean " + near + "?"));
}

void Options::know_names(const std::string& placeholder, const std::vector<std::string>& names) {
  std::map<std::string, std::string> folded;
  for (const std::string& name : names) {
    const auto [other, is_new] = folded.emplace(spelling::fold(name), name);
    if (!is_new && other->second != name)
      throw UserError(
          "the " + placeholder + " names '" + other->second + "' and '" + name +
          "' of the mesh differ in capitals only, which options cannot tell apart; rename one of them");
  }
  names_[placeholder] = names;
  for (const std::string& name : typed_) refuse_if_unknown(name);
}

void Options::refuse_unknown() const {
  for (const std::string& name : unread()) {
    refuse_if_unknown(name);
    if (match(name).option || names::petsc_system(name)) continue;
    const std::string near = names::meant(name, schema_, names_);
    throw UserError("-" + name + " was given but neither " + program_ + " nor PETSc has read it" +
                    (near.empty() ? "; remove it, or correct its name" : "; did you mean " + near + "?"));
  }
}

}  // namespace slipscale
