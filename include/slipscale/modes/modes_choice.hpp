#pragma once

#include <optional>
#include <string>
#include <vector>

#include "slipscale/base/options.hpp"

namespace slipscale {

/// Values of a sweep, a:d:b, ascending.
struct SweepChoice {
  std::string what;  ///< coefficient, time or load_speed
  std::vector<double> values;
};

/// What the user asks of the modes.
struct ModesChoice {
  int count = 10;            ///< how many are reported
  double to = 0;             ///< highest frequency, Hz
  double tolerance = 1e-10;  ///< of the residual, relative
  int basis = 0;             ///< real modes to start from; 0: all below twice `to`
  bool scheme = false;
  int shapes = 6, frames = 12;
  std::string folder;
};

Schema modes_schema();
ModesChoice read_modes(const Options& options);

}  // namespace slipscale
