#pragma once

#include <optional>
#include <string>
#include <vector>

#include "slipscale/base/options.hpp"
#include "slipscale/base/vector2.hpp"
#include "slipscale/cell/strain_recovery.hpp"
#include "slipscale/record/stress_comparison.hpp"

namespace slipscale {

/// What the user wants of `relocalize`.
struct RelocalizationChoice {
  std::string run, tensors, folder, progress;
  std::optional<StressComparison::Choice> reference;
  std::optional<Vector2> origin;  ///< m, a corner of one periodic cell
  Recovery recovery = Recovery::nodal;
  std::optional<double> strip;  ///< m, depth of the boundary layer that is corrected
  std::vector<Vector2> points;  ///< m
};

Schema relocalization_schema();
RelocalizationChoice read_relocalization(const Options& options);

}  // namespace slipscale
