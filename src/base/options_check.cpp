// The part of Options that looks for what the user wrote and nobody will read.
#include <algorithm>
#include <stdexcept>

#include "names.hpp"
#include "places_of_petsc.hpp"
#include "slipscale/base/error.hpp"
#include "slipscale/base/options.hpp"
#include "slipscale/base/plain_yaml.hpp"
#include "spelling.hpp"
#include "value.hpp"

namespace slipscale {
namespace {

/// Options nobody has asked PETSc for yet, with their values.
std::vector<Written> unread() {
  PetscInt count = 0;
  char **options = nullptr, **values = nullptr;
  petsc(PetscOptionsLeftGet(nullptr, &count, &options, &values));
  std::vector<Written> result;
  for (PetscInt k = 0; k < count; ++k) {
    result.push_back({options[k]});
    if (values[k]) result.back().value = values[k];
  }
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
    const auto fillings = known.find(parts.placeholder);
    if (fillings == known.end()) {
      if (parts.placeholder.empty()) return parts.prefix;
      continue;  // until the mesh is read
    }
    for (const std::string& candidate : fillings->second)
      if (spelling::fold(candidate) == *found) return parts.prefix + candidate + parts.suffix;
  }
  return "";
}

/// What a reader of YAML 1.1 makes of a word that the option takes as it stands; empty when it is the same.
std::string other_meaning(const Option& option, const Written& entry) {
  const std::string& word = entry.doubt;
  if (word.empty()) return "";
  const PlainYaml meaning = plain_yaml(word);
  const bool free_text = option.kind == Kind::text && option.range.words.empty();
  // 1.50 is printed as 1.5.
  const bool changes = meaning == PlainYaml::number && !value::printed_alike(word);
  const bool harmless = meaning == PlainYaml::other    ? false
                        : meaning == PlainYaml::number ? !(free_text && changes)
                        : meaning == PlainYaml::flag   ? option.kind != Kind::text || !free_text
                                                       : false;
  return harmless ? ""
                  : "-" + entry.name + " is " + word + ", which YAML takes for " + plain_yaml_words(word) +
                        "; " + (free_text ? "put it in quotes" : "write " + value::wanted(option));
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

Options::Options(std::string program, Schema schema, const std::vector<Written>& written,
                 std::vector<std::string> solvers)
    : program_(std::move(program)), schema_(std::move(schema)), solvers_(std::move(solvers)) {
  for (const Option& option : schema_) check_fallback(option);
  const PlacesOfPetsc places;
  for (Written entry : unread()) {
    entry.origin.place = places.of(entry.name);
    take(entry);
  }
  for (const Written& entry : written) take(entry);
  tell_of(places.all(), written);
  for (const std::string& name : typed_) {
    refuse_if_unknown(name, false);
    const Match found = match(name);
    // With a placeholder, a name that does not exist is to be named before its value.
    if (found.option && names::pattern(found.option->name).placeholder.empty()) check(given_.at(name));
  }
}

/// What PETSc collects by itself is not in sight of the user: it is named, and so is what overrules it.
void Options::tell_of(const std::vector<Written>& collected, const std::vector<Written>& written) {
  for (const Written& entry : collected) {
    const auto later = std::find_if(written.rbegin(), written.rend(), [&](const Written& other) {
      return spelling::fold(other.name) == spelling::fold(entry.name);
    });
    notes_.push_back("-" + entry.name + (entry.value ? " " + *entry.value : "") + " stands in " +
                     entry.origin.place +
                     (later == written.rend()       ? ""
                      : later->origin.place.empty() ? " and gives way to what is written elsewhere"
                                                    : " and gives way to that of " + later->origin.place));
  }
}

void Options::take(const Written& entry) {
  if (is_petsc(entry.name)) return;
  const auto [place, is_new] = given_.insert_or_assign(entry.name, entry);
  if (is_new) typed_.push_back(entry.name);
}

bool Options::is_petsc(const std::string& name) const {
  return !match(name).option && (names::petsc_object(name, solvers_) || names::petsc_system(name));
}

void Options::check(const Written& entry) const {
  const Option& option = *match(entry.name).option;
  try {
    const bool bare_flag = option.kind == Kind::flag && !entry.in_yaml;
    if (!entry.value && !bare_flag)
      throw UserError("-" + entry.name + " has no value; write after it " + value::wanted(option));
    const std::string odd = other_meaning(option, entry);
    if (!odd.empty()) throw UserError(odd);
    value::check(option, entry.name, entry.value.value_or("true"));
  } catch (const UserError& error) {
    refuse(entry.name, error.what());
  }
}

void Options::refuse(const std::string& name, const std::string& sentence) const {
  const Origin from = origin(name);
  throw UserError(sentence +
                  (from.order == 0 && !from.place.empty() ? " (it stands in " + from.place + ")" : ""));
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

/// `at_last`: no more names will be known. Before that, an option that is meant may depend on them.
void Options::refuse_if_unknown(const std::string& name, bool at_last) const {
  const Match found = match(name);
  const std::string placeholder = found.option ? names::pattern(found.option->name).placeholder : "";
  if (found.option && known_as(names_, placeholder, found.filled)) return;
  if (is_petsc(name)) return;

  const std::string spelled = respelled(name, schema_, names_);
  if (!spelled.empty() && spelled != name)
    refuse(name, "-" + name + " differs in capitals from the option it means; write -" + spelled);
  const names::Guess near = names::meant(name, schema_, names_);
  if (near.open && !at_last) return;
  const std::string hint =
      near.name.empty() || near.name == "-" + name ? "" : "; did you mean " + near.name + "?";
  if (found.option)
    refuse(name, "-" + name + " names the " + placeholder + " '" + found.filled +
                     "', which the mesh does not have" + hint + " (the mesh has " +
                     (names_.at(placeholder).empty() ? "none" : joined(names_.at(placeholder))) + ")");
  refuse(name, "-" + name + " is not an option of " + program_ +
                   (hint.empty() ? "; see " + program_ + " -help" : hint));
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
  for (const std::string& name : typed_) refuse_if_unknown(name, false);
  for (const std::string& name : typed_) {
    const Match found = match(name);
    if (found.option && names::pattern(found.option->name).placeholder == placeholder &&
        known_as(names_, placeholder, found.filled))
      check(given_.at(name));
  }
}

void Options::refuse_unknown() const {
  for (const std::string& name : typed_) refuse_if_unknown(name, true);
  for (const Written& entry : unread()) {
    refuse_if_unknown(entry.name, true);
    if (match(entry.name).option || names::petsc_system(entry.name)) continue;
    const std::string near = names::meant(entry.name, schema_, names_).name;
    const std::string place = PlacesOfPetsc().of(entry.name);
    throw UserError("-" + entry.name + " was given" + (place.empty() ? "" : " in " + place) +
                    " but neither " + program_ + " nor PETSc has read it" +
                    (near.empty() ? "; remove it, or correct its name" : "; did you mean " + near + "?"));
  }
}

}  // namespace slipscale
