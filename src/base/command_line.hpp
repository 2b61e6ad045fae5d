#pragma once

#include <string>
#include <vector>

#include "slipscale/base/options.hpp"

namespace slipscale {

/// The command line taken apart before PETSc sees it: PETSc skips what it does not understand without a word.
struct CommandLine {
  std::vector<std::string> arguments;    ///< for PETSc, the program's own name first
  std::vector<std::string> scene_files;  ///< of `-options_file_yaml`, in their order
  bool help = false;
  bool version = false;
};

/// Throws `UserError` on stray words, `-x=y`, `--x`, `-history`, and scene files without a name.
CommandLine read_command_line(int argc, char** argv, const std::string& program, const Schema& schema);

}  // namespace slipscale
