#pragma once

#include <functional>
#include <string>

#include "slipscale/base/options.hpp"

namespace slipscale {

/// What every executable of slipscale is made of.
struct Program {
  std::string name;
  std::string purpose;  ///< one or two sentences, printed by `-help`
  Schema schema;
  std::function<void(Options& options)> run;  ///< on PETSC_COMM_WORLD
};

/// Starts MPI and PETSc, reads the options (`-options_file_yaml` first, then the command line over it),
/// answers `-help` and `-version`, runs the program and turns errors into exit codes: 0 done, 2 a mistake of
/// the user (one sentence on rank 0), 1 anything else, which ends all ranks at once.
int run_program(int argc, char** argv, const Program& program);

}  // namespace slipscale
