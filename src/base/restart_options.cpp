#include "restart_options.hpp"

#include <algorithm>
#include <cstdlib>

#include "scene_file.hpp"
#include "slipscale/base/error.hpp"
#include "slipscale/base/parallel.hpp"
#include "slipscale/base/yaml_text.hpp"
#include "spelling.hpp"

namespace slipscale {
namespace {

constexpr int first = 1;  ///< before scenes and command line

/// Equal texts, or texts of equal numbers.
bool same(const std::string& one, const std::string& other) {
  if (one == other) return true;
  char *end = nullptr, *other_end = nullptr;
  const double number = std::strtod(one.c_str(), &end), other_number = std::strtod(other.c_str(), &other_end);
  return !one.empty() && !other.empty() && *end == '\0' && *other_end == '\0' && number == other_number;
}

bool among(const std::string& name, const std::vector<std::string>& names) {
  return std::ranges::any_of(names, [&](const std::string& each) {
    return each.ends_with('*') ? name.starts_with(each.substr(0, each.size() - 1)) : name == each;
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

void refuse_changes(const std::vector<Written>& before, const std::vector<Written>& now,
                    const std::vector<std::string>& may_change, const std::string& folder) {
  for (const Written& option : now) {
    const std::string name = spelling::fold(option.name);
    if (among(name, may_change)) continue;
    const auto had = std::ranges::find(before, name, [](const Written& o) { return spelling::fold(o.name); });
    const std::string value = option.value.value_or("");
    if (had != before.end() && same(value, had->value.value_or(""))) continue;
    throw UserError("-" + option.name + " is " + (value.empty() ? "given" : value) + ", but the run in '" +
                    folder + "' has " + (had == before.end() ? "none" : had->value.value_or("none")) +
                    ", and a run goes on as it began; leave it out, or start a new run");
  }
}

}  // namespace slipscale
