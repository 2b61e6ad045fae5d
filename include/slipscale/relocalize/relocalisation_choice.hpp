#pragma once

#include <optional>
#include <string>
#include <vector>

#include "slipscale/base/options.hpp"
#include "slipscale/base/vector2.hpp"
#include "slipscale/files/interface_choice.hpp"
#include "slipscale/relocalize/strain_recovery.hpp"
#include "slipscale/relocalize/stress_comparison.hpp"

namespace slipscale {

/// What the user wants of `relocalize`.
struct RelocalisationChoice {
  std::string run, tensors, folder, progress;
  std::optional<StressComparison::Choice> reference;
  std::optional<Vector2> origin;  ///< m, a corner of one periodic cell
  Recovery recovery = Recovery::nodal;
  std::optional<double> strip;  ///< m, depth of the boundary layer that is corrected
  std::vector<Vector2> points;  ///< m
  std::optional<InterfaceChoice> interfaces;
};

Schema relocalisation_schema();
RelocalisationChoice read_relocalisation(const Options& options);

}  // namespace slipscale
