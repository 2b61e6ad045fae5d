#include "names.hpp"

#include <petscviewer.h>

#include <algorithm>
#include <array>

#include "spelling.hpp"
#include "value.hpp"

namespace slipscale::names {
namespace {

// clang-format off
constexpr std::array object_words = {
    "dm", "mat", "vec", "vecscatter", "ksp", "pc", "snes", "ts", "tao", "is", "sf", "mg", "sub", "fieldsplit",
    "viewer", "petscpartitioner", "petscfe", "petscspace", "petscsection", "petscdualspace"};

// Those that PETSc reads in PetscFinalize would never count as used while the program runs. By what stands
// behind them: a text or nothing, a flag or nothing, a number, a viewer (type:file:format) or nothing.
constexpr std::array system_texts = {
    "log", "log_all", "log_exclude", "log_mpe", "log_nested", "log_perfstubs", "log_summary", "log_trace", "info",
    "info_exclude", "malloc_view", "memory_view", "options_file", "options_monitor", "options_monitor_cancel",
    "objects_dump", "citations", "get_total_flops", "start_in_debugger", "on_error_attach_debugger",
    "debugger_nodes", "debugger_ranks", "debug_terminal", "nox", "nox_warning", "display", "tmp", "python",
    "petsc_ci", "blas_view", "prefix_push", "prefix_pop"};
constexpr std::array system_flags = {
    "log_sync", "log_view_memory", "malloc", "malloc_coalesce", "malloc_debug", "malloc_dump", "malloc_hbw",
    "malloc_requested_size", "malloc_test", "options_left", "options_suppress_deprecated_warnings", "fp_trap",
    "checkstack", "no_signal_handler", "skip_petscrc", "stop_for_debugger", "on_error_abort",
    "on_error_mpiabort", "error_output_none", "error_output_stdout", "shared_tmp", "not_shared_tmp",
    "use_gpu_aware_mpi"};
constexpr std::array system_numbers = {"malloc_view_threshold", "check_pointer_intensity", "debugger_pause"};
constexpr std::array system_viewers = {"log_view", "options_view"};
// clang-format on

bool any_of(const auto& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

bool is_truth(const std::string& text) {
  constexpr std::array words = {"", "true", "yes", "on", "1", "false", "no", "off", "0"};
  return any_of(words, spelling::fold(text));
}

/// "ascii", ":file", "ascii:file:ascii_xml".
bool is_viewer(const std::string& text) {
  const std::size_t first = std::min(text.find(':'), text.size());
  const std::size_t second = std::min(text.find(':', first + 1), text.size());
  const std::string type = spelling::fold(text.substr(0, first));
  const std::string format =
      second < text.size() ? text.substr(second + 1, text.find(':', second + 1) - second - 1) : "";
  if (!type.empty() && type != "ascii") return false;
  if (format.empty()) return true;
  for (const char* const* known = PetscViewerFormats; *known; ++known)
    if (spelling::fold(*known) == spelling::fold(format)) return true;
  return false;
}

/// The nearest name so far and how far it is.
struct Nearest {
  std::string name;
  std::size_t distance = static_cast<std::size_t>(-1);

  void consider(const std::string& candidate, std::size_t candidate_distance, std::size_t length) {
    if (candidate_distance > spelling::tolerance(length) || candidate_distance >= distance) return;
    name = candidate;
    distance = candidate_distance;
  }
};

/// How far the name is at least from one of the pattern, whatever stands for the placeholder: the least over
/// every split, which counts prefix and suffix only.
std::size_t least_distance(const Pattern& pattern, const std::string& name) {
  const std::string folded = spelling::fold(name);
  const auto front = spelling::distances(folded, pattern.prefix);
  const auto back =
      spelling::distances({folded.rbegin(), folded.rend()}, {pattern.suffix.rbegin(), pattern.suffix.rend()});
  std::size_t least = static_cast<std::size_t>(-1);
  for (std::size_t begin = 0; begin < name.size(); ++begin)
    for (std::size_t end = begin + 1; end <= name.size(); ++end)
      least = std::min(least, front[begin] + back[name.size() - end]);
  return least;
}

/// `young` and `history` are parts of names: the first option that ends or begins with such a word.
Guess containing(const std::string& word, const Schema& schema, const Known& known) {
  const std::string folded = spelling::fold(word);
  bool open = false;
  for (const Option& option : schema) {
    if (!option.name.ends_with("_" + folded) && !option.name.starts_with(folded + "_")) continue;
    const Pattern parts = pattern(option.name);
    if (parts.placeholder.empty()) return {"-" + option.name};
    const auto fillings = known.find(parts.placeholder);
    if (fillings == known.end())
      open = open || !ignored(parts);
    else if (!fillings->second.empty())
      return {"-" + parts.prefix + fillings->second.front() + parts.suffix};
  }
  return {"", open};
}

}  // namespace

Pattern pattern(const std::string& declared) {
  const auto open = declared.find('<'), close = declared.find('>');
  if (open == std::string::npos || close == std::string::npos) return {declared, "", ""};
  return {declared.substr(0, open), declared.substr(open + 1, close - open - 1), declared.substr(close + 1)};
}

std::optional<std::string> filling(const Pattern& pattern, const std::string& name) {
  if (pattern.placeholder.empty())
    return name == pattern.prefix ? std::optional<std::string>("") : std::nullopt;
  const std::size_t fixed = pattern.prefix.size() + pattern.suffix.size();
  if (name.size() <= fixed || !name.starts_with(pattern.prefix) || !name.ends_with(pattern.suffix))
    return std::nullopt;
  return name.substr(pattern.prefix.size(), name.size() - fixed);
}

bool ignored(const Pattern& pattern) { return pattern.placeholder == "entry"; }

bool petsc_object(const std::string& name, const std::vector<std::string>& solvers) {
  const auto is_object = [](const std::string& text) {
    return any_of(object_words, text.substr(0, text.find('_')));
  };
  const std::string folded = spelling::fold(name);
  return is_object(folded) || std::any_of(solvers.begin(), solvers.end(), [&](const std::string& prefix) {
           return folded.starts_with(prefix) && is_object(folded.substr(prefix.size()));
         });
}

bool petsc_system(const std::string& name) {
  const std::string folded = spelling::fold(name);
  return any_of(system_texts, folded) || any_of(system_flags, folded) || any_of(system_numbers, folded) ||
         any_of(system_viewers, folded);
}

std::string petsc_wants(const std::string& name, const std::optional<std::string>& value) {
  const std::string folded = spelling::fold(name);
  if (any_of(system_flags, folded) && !is_truth(value.value_or(""))) return "true or false";
  if (any_of(system_numbers, folded) && !value::number(value.value_or(""))) return "a number";
  if (any_of(system_viewers, folded) && !is_viewer(value.value_or("")))
    return "left out, or ascii:file:format, such as ':profile.txt' or ':profile.xml:ascii_xml'";
  return "";
}

std::string petsc_file(const std::string& name, const std::optional<std::string>& value) {
  const std::string folded = spelling::fold(name), text = value.value_or("");
  if (folded == "citations") return text;
  const std::size_t first = text.find(':');
  if (!any_of(system_viewers, folded) || first == std::string::npos) return "";
  return text.substr(first + 1, text.find(':', first + 1) - first - 1);
}

Guess meant(const std::string& name, const Schema& schema, const Known& known) {
  Nearest guess;
  std::size_t open = static_cast<std::size_t>(-1);  // how near a name may be that is not known yet
  const std::string folded = spelling::fold(name);
  const auto consider = [&](const std::string& candidate) {
    guess.consider(candidate, spelling::distances(spelling::fold(candidate), folded).back(), name.size());
  };
  for (const Option& option : schema) {
    const Pattern parts = pattern(option.name);
    if (ignored(parts)) continue;
    const auto fillings = known.find(parts.placeholder);
    if (parts.placeholder.empty())
      consider(option.name);
    else if (fillings == known.end())
      open = std::min(open, least_distance(parts, name));
    else
      for (const std::string& filled : fillings->second) consider(parts.prefix + filled + parts.suffix);
  }
  for (const char* system : system_texts) consider(system);
  for (const char* system : system_flags) consider(system);
  for (const char* system : system_numbers) consider(system);
  for (const char* system : system_viewers) consider(system);
  const bool may_be_nearer = open <= spelling::tolerance(name.size()) && open < guess.distance;
  if (!guess.name.empty()) return {"-" + guess.name, may_be_nearer};
  Guess part = containing(name, schema, known);
  part.open = part.open || may_be_nearer;
  return part;
}

}  // namespace slipscale::names
