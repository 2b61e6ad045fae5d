#include "slipscale/relocalize/run_record.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>
#include <string_view>

#include "slipscale/base/parallel.hpp"

namespace slipscale {
namespace {

/// The text of a file on rank 0, given to all; empty where there is none.
std::string text_on_all(MPI_Comm comm, const std::filesystem::path& path) {
  std::string text;
  if (is_root(comm)) {
    std::ostringstream all;
    if (std::ifstream file(path); file) all << file.rdbuf();
    text = all.str();
  }
  auto size = static_cast<long>(text.size());
  MPI_Bcast(&size, 1, MPI_LONG, 0, comm);
  text.resize(static_cast<std::size_t>(size));
  MPI_Bcast(text.data(), static_cast<int>(size), MPI_CHAR, 0, comm);
  return text;
}

/// A plain scalar as `Yaml` writes it, without its comment.
std::string value_of(std::string text) {
  text.erase(0, text.find_first_not_of(' '));
  if (text.starts_with('"')) return text.substr(1, text.rfind('"') - 1);
  text.erase(std::min(text.find(" #"), text.size()));
  text.erase(text.find_last_not_of(' ') + 1);
  return text;
}

bool is_of_scene(const std::string& option) {
  constexpr std::array<std::string_view, 6> groups{"surface_", "friction_", "boundary_",
                                                   "body_",    "initial_",  "damping_"};
  return std::ranges::any_of(groups, [&](std::string_view group) { return option.starts_with(group); });
}

}  // namespace

RunRecord read_run_record(MPI_Comm comm, const std::string& folder) {
  RunRecord record;
  std::istringstream lines(text_on_all(comm, std::filesystem::path(folder) / "run.yaml"));
  std::string group;  // the key that the indented lines belong to
  for (std::string line; std::getline(lines, line);) {
    const std::size_t begin = line.find_first_not_of(' '), colon = line.find(':');
    if (begin == std::string::npos || line[begin] == '#' || colon == std::string::npos) continue;
    const std::string key = line.substr(begin, colon - begin), value = value_of(line.substr(colon + 1));
    if (begin == 0) group = key;
    if (!value.empty()) record[begin == 0 ? key : group + "_" + key] = value;
  }
  return record;
}

std::vector<std::string> differences_of_scene(const RunRecord& one, const RunRecord& other) {
  std::vector<std::string> found;
  if (one.empty() || other.empty()) return found;
  std::set<std::string> names;
  for (const RunRecord* record : {&one, &other})
    for (const auto& [name, value] : *record)
      if (is_of_scene(name)) names.insert(name);
  const auto shown = [](const RunRecord& record, const std::string& name) {
    const auto at = record.find(name);
    return at == record.end() ? std::string("not given") : at->second;
  };
  for (const std::string& name : names)
    if (const std::string a = shown(one, name), b = shown(other, name); a != b)
      found.push_back("-" + name + " (" + a + " and " + b + ")");
  return found;
}

std::vector<std::string> doubts_of(const RunRecord& record) {
  constexpr std::string_view beginning = "run_doubt_";
  std::vector<std::string> found;
  for (const auto& [name, value] : record)
    if (name.starts_with(beginning))
      found.push_back("of region '" + name.substr(beginning.size()) + "': " + value);
  return found;
}

}  // namespace slipscale
