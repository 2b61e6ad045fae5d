#include "restart_options.hpp"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>

#include "names.hpp"
#include "scene_file.hpp"
#include "slipscale/base/error.hpp"
#include "slipscale/base/parallel.hpp"
#include "slipscale/base/yaml_text.hpp"
#include "spelling.hpp"

namespace slipscale {
namespace {

constexpr int first = 1;  ///< before scenes and command line

std::vector<std::string> words_of(const std::string& list) {
  std::vector<std::string> words(1);
  for (const char letter : list) {
    if (letter == ',')
      words.emplace_back();
    else if (letter != ' ')
      words.back() += letter;
  }
  return words;
}

/// One word, or what it means where it is a flag.
std::string meaning(const std::string& word) {
  const std::string folded = spelling::fold(word);
  if (folded == "yes" || folded == "on" || folded == "true") return "1";
  if (folded == "no" || folded == "off" || folded == "false") return "0";
  return word;
}

bool same_word(const std::string& one, const std::string& other) {
  const std::string left = meaning(one), right = meaning(other);
  if (left == right) return true;
  char *end = nullptr, *other_end = nullptr;
  const double number = std::strtod(left.c_str(), &end),
               other_number = std::strtod(right.c_str(), &other_end);
  return !left.empty() && !right.empty() && *end == '\0' && *other_end == '\0' && number == other_number;
}

/// Equal lists of words, numbers and flags, however they are written.
bool same(const std::string& one, const std::string& other) {
  return std::ranges::equal(words_of(one), words_of(other), same_word);
}

bool same_folder(const std::string& one, const std::string& other) {
  std::error_code none;
  return std::filesystem::equivalent(one, other, none);
}

/// `material_*_file` stands for all of its kind.
bool among(const std::string& name, const std::vector<std::string>& names) {
  return std::ranges::any_of(names, [&](const std::string& each) {
    const std::size_t star = each.find('*');
    if (star == std::string::npos) return name == each;
    return name.size() >= each.size() && name.starts_with(each.substr(0, star)) &&
           name.ends_with(each.substr(star + 1));
  });
}

bool declared(const std::string& name, const Schema& schema) {
  return std::ranges::any_of(schema, [&](const Option& option) {
    return names::filling(names::pattern(option.name), name).has_value();
  });
}

}  // namespace

std::vector<Written> options_of_run(const RestartRule& rule, const Written& restart) {
  if (restart.in_yaml)
    throw UserError(
        "restart stands in " + restart.origin.place +
        ", but a scene describes a run, not what became of it; give -restart on the command line");
  if (!restart.value) throw UserError("-restart has no value; write the folder of a run after it");
  const std::string& folder = *restart.value;
  std::string text, fault;
  if (is_root(MPI_COMM_WORLD)) try {
      text = rule.scene(folder);
    } catch (const UserError& error) {
      fault = error.what();
    }
  throw_together(MPI_COMM_WORLD, fault);
  std::vector<Written> options = read_scene_text(folder, text_on_all(std::move(text)), first);
  std::erase_if(options, [](const Written& option) { return option.name == "output_folder"; });
  options.push_back({"output_folder", folder, {first, folder}, true});
  return options;
}

void refuse_restart_elsewhere(const std::vector<Written>& options) {
  for (const Written& option : options)
    if (option.origin.order == 0 && spelling::fold(option.name) == "restart")
      throw UserError(
          "-restart stands in " + option.origin.place +
          ", but what is to be gone on with is said for one command; give it on the command line");
}

void refuse_changes(const std::vector<Written>& before, const std::vector<Written>& now,
                    const RestartRule& rule, const Schema& schema, const std::string& folder) {
  std::map<std::string, const Written*> last;  // the last word of each name counts
  for (const Written& option : now) last[spelling::fold(option.name)] = &option;
  for (const auto& [name, option] : last) {
    if (among(name, rule.may_change) || !declared(name, schema)) continue;
    const auto had = std::ranges::find(before, name, [](const Written& o) { return spelling::fold(o.name); });
    const std::string value = option->value.value_or("");
    if (had != before.end() && same(value, had->value.value_or(""))) continue;
    if (name == "output_folder" && same_folder(value, folder)) continue;
    throw UserError("-" + option->name + " is " + (value.empty() ? "given" : value) + ", but the run in '" +
                    folder + "' has " + (had == before.end() ? "none" : had->value.value_or("none")) +
                    ", and a run goes on as it began; leave it out, or start a new run");
  }
}

}  // namespace slipscale
