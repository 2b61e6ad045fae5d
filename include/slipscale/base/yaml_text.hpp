#pragma once

#include <optional>
#include <string>
#include <vector>

namespace slipscale {

/// One option of a YAML text.
struct YamlEntry {
  std::string name;                  ///< the keys above it joined with _
  std::optional<std::string> value;  ///< a list joined with commas; none where nothing stands behind the key
  std::string doubt;  ///< the word of the value that YAML takes for more than a text, the oddest one
  int line = 0;       ///< of the value's last key, from 1
};

/// The text of a file, read by rank 0 of MPI_COMM_WORLD and given to all. Throws `UserError` naming `option`,
/// with its dash, when it cannot be read. Collective.
std::string read_on_all(const std::string& option, const std::string& file);
/// Rank 0's text, on all ranks. Collective.
std::string text_on_all(std::string text);

/// The options of a YAML text, by the rule of `src/base/scene_file.hpp`. Throws `UserError`, which begins
/// with `file` and names the line. Time and memory are proportional to the text.
std::vector<YamlEntry> read_yaml(const std::string& file, const std::string& text);

}  // namespace slipscale
