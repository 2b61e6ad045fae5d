#include "names.hpp"

#include <algorithm>
#include <array>

#include "spelling.hpp"

namespace slipscale::names {
namespace {

// clang-format off
constexpr std::array object_words = {
    "dm", "mat", "vec", "vecscatter", "ksp", "pc", "snes", "ts", "tao", "is", "sf", "mg", "sub", "fieldsplit",
    "viewer", "petscpartitioner", "petscfe", "petscspace", "petscsection", "petscdualspace"};

// Those that PETSc reads in PetscFinalize would never count as used while the program runs.
constexpr std::array system_names = {
    "log", "log_all", "log_exclude", "log_mpe", "log_nested", "log_perfstubs", "log_summary", "log_sync",
    "log_trace", "log_view", "log_view_memory", "info", "info_exclude", "malloc", "malloc_coalesce",
    "malloc_debug", "malloc_dump", "malloc_hbw", "malloc_requested_size", "malloc_test", "malloc_view",
    "malloc_view_threshold", "memory_view", "options_file", "options_left", "options_monitor",
    "options_monitor_cancel", "options_view", "options_suppress_deprecated_warnings", "objects_dump",
    "citations", "get_total_flops", "fp_trap", "checkstack", "check_pointer_intensity", "no_signal_handler",
    "skip_petscrc", "start_in_debugger", "stop_for_debugger", "on_error_attach_debugger", "on_error_abort",
    "on_error_mpiabort", "debugger_nodes", "debugger_ranks", "debugger_pause", "debug_terminal",
    "error_output_none", "error_output_stdout", "nox", "nox_warning", "display", "tmp", "shared_tmp",
    "not_shared_tmp", "python", "use_gpu_aware_mpi", "petsc_ci", "blas_view", "prefix_push", "prefix_pop"};
// clang-format on

bool any_of(const auto& words, const std::string& word) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// The nearest name so far and how far it is.
struct Guess {
  std::string name;
  std::size_t distance = static_cast<std::size_t>(-1);

  void consider(const std::string& candidate, std::size_t candidate_distance, std::size_t length) {
    if (candidate_distance > spelling::tolerance(length) || candidate_distance >= distance) return;
    name = candidate;
    distance = candidate_distance;
  }
};

/// Which part of the name stands for the placeholder is open: try every split, count prefix and suffix only.
void consider_any_filling(Guess& guess, const Pattern& pattern, const std::string& name) {
  const std::string folded = spelling::fold(name);
  const auto front = spelling::distances(folded, pattern.prefix);
  const auto back =
      spelling::distances({folded.rbegin(), folded.rend()}, {pattern.suffix.rbegin(), pattern.suffix.rend()});
  for (std::size_t begin = 0; begin < name.size(); ++begin)
    for (std::size_t end = begin + 1; end <= name.size(); ++end)
      guess.consider(pattern.prefix + name.substr(begin, end - begin) + pattern.suffix,
                     front[begin] + back[name.size() - end], pattern.prefix.size() + pattern.suffix.size());
}

/// `young` and `history` are parts of names: the first option that ends or begins with such a word.
std::string containing(const std::string& word, const Schema& schema) {
  const std::string folded = spelling::fold(word);
  for (const Option& option : schema)
    if (option.name.ends_with("_" + folded) || option.name.starts_with(folded + "_"))
      return "-" + option.name;
  return "";
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

bool petsc_object(const std::string& name) {
  const auto first_word = [](const std::string& text) { return text.substr(0, text.find('_')); };
  const std::string folded = spelling::fold(name);
  // `-cell_ksp_rtol`: a solver of ours with its own prefix.
  return any_of(object_words, first_word(folded)) ||
         (folded.starts_with("cell_") && any_of(object_words, first_word(folded.substr(5))));
}

bool petsc_system(const std::string& name) { return any_of(system_names, spelling::fold(name)); }

std::string meant(const std::string& name, const Schema& schema, const Known& known) {
  Guess guess;
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
      consider_any_filling(guess, parts, name);
    else
      for (const std::string& filled : fillings->second) consider(parts.prefix + filled + parts.suffix);
  }
  for (const char* system_name : system_names) consider(system_name);
  return guess.name.empty() ? containing(name, schema) : "-" + guess.name;
}

}  // namespace slipscale::names
