#pragma once

#include <optional>
#include <string>
#include <vector>

#include "slipscale/base/options.hpp"
#include "slipscale/dynamics/scene.hpp"

namespace slipscale {

/// Values that take the place of one of the scene's.
struct SweepChoice {
  enum class Of { coefficient, time, speed } of;
  std::string name;  ///< coefficient, time or load_speed
  std::string unit;
  std::vector<double> values;  ///< ascending
};

/// What the user asks of the modes.
struct ModesChoice {
  int count = 10;            ///< how many are reported
  double to = 0;             ///< highest frequency, Hz
  double tolerance = 1e-10;  ///< of the residual, relative
  int basis = 0;             ///< real modes to start from; 0: all below twice `to`
  bool scheme = false;
  int shapes = 6, frames = 12;
  std::vector<SweepChoice> sweeps;
  std::string folder;
};

Schema modes_schema();
ModesChoice read_modes(const Options& options);
/// The sweeps, after the scene, which says what can be varied in it. Throws UserError for a text that is not
/// a:d:b, and for values out of their range.
void read_sweeps(const Options& options, const Scene& scene, ModesChoice& choice);

}  // namespace slipscale
