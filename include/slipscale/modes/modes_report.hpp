#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "slipscale/modes/mode_measures.hpp"
#include "slipscale/modes/mode_search.hpp"
#include "slipscale/modes/modes_sweep.hpp"

namespace slipscale {

/// All that is told of a mode.
struct ReportedMode {
  SlidingMode mode;
  ModeMeasures measures;
  std::optional<SlidingMode> scheme{};  ///< that of the time scheme

  double frequency() const;                       ///< Hz
  double growth_rate() const;                     ///< 1/s
  double damping_ratio() const;                   ///< −Re p/|p|
  std::optional<double> time_to_tenfold() const;  ///< s; none where it decays
};

/// What the program has found.
struct ModesReport {
  std::vector<std::string> regions;
  std::vector<ReportedMode> modes;
  std::vector<ModesSweep> sweeps{};
  ModesFound search;             ///< how, without the modes
  double time = 0;               ///< T, s
  std::optional<double> step{};  ///< of the scheme, s
  PetscInt unknowns = 0, basis_start = 0, basis_end = 0;
  int ranks = 1;
  double seconds = 0, memory = 0;  ///< B, of all ranks
};

/// The table for the terminal.
std::string describe(const ModesReport& report, const SteadySliding& state);

/// The text of modes.yaml.
std::string modes_yaml(const ModesReport& report, const SteadySliding& state, const Mesh& mesh,
                       const std::map<std::string, std::string>& effective);

}  // namespace slipscale
