#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "slipscale/base/options.hpp"

namespace slipscale {

/// How a program goes on with an earlier run, of which the option `-restart <folder>` tells.
struct RestartRule {
  /// The options that were in effect, as a YAML text, from what the run left in its folder. Throws UserError.
  /// On rank 0 alone.
  std::function<std::string(const std::string& folder)> scene;
  std::vector<std::string>
      may_change;  ///< options that may differ from there on; `material_*_file` stands for all of its kind
};

/// What every executable of slipscale is made of.
struct Program {
  std::string name;
  std::string purpose;  ///< one or two sentences, printed by `-help`
  Schema schema;
  std::function<void(Options& options)> run;  ///< on PETSC_COMM_WORLD
  std::string commit = {};                    ///< of the sources; "" when unknown
  std::vector<std::string> solvers = {};      ///< prefixes of the options of its PETSc solvers: "cell_"
  std::vector<std::string> libraries = {};    ///< for `-version`, besides PETSc, MPI and HDF5: "gmsh 4.8.4"
  std::optional<RestartRule> restart = {};
};

/// To be called when the scene is read: refuses what is given and nobody has read, and prints what was set
/// aside.
void end_reading(const Options& options);

/// Wall time since the program was loaded, s.
double seconds_since_start();

/// Starts MPI and PETSc, reads the options (`-options_file_yaml` first, then the command line over it),
/// answers `-help` and `-version`, runs the program and turns errors into exit codes: 0 done, 2 a mistake of
/// the user (one sentence on rank 0), 1 anything else, which ends all ranks at once, 3
/// a run that was interrupted and can go on (`Interruption`).
int run_program(int argc, char** argv, const Program& program);

}  // namespace slipscale
