#pragma once

#include <string>
#include <vector>

#include "slipscale/base/options.hpp"

namespace slipscale {

/// The command line taken apart before PETSc sees it: PETSc skips what it does not understand without a word.
struct CommandLine {
  std::string program;                    ///< the program's own name, as it was called
  std::vector<Written> options;           ///< in their order; the last of a name counts
  std::vector<std::string> scene_files;   ///< of `-options_file_yaml`, in their order
  std::vector<std::string> option_files;  ///< of `-options_file`, in PETSc's own format
  bool help = false;
  bool version = false;
};

/// Throws `UserError` on stray words, `-x=y`, `--x`, and scene files without a name.
CommandLine read_command_line(int argc, char** argv);

/// Refuses a value that PETSc could not read of an option that it reads when it starts or ends, where it
/// would stop with a dump. Throws `UserError`.
void check_petsc_values(const std::vector<Written>& options);

}  // namespace slipscale
