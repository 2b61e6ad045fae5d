#pragma once

#include <string>
#include <vector>

namespace slipscale {

struct EffectiveFile {
  std::vector<double> stiffness;  ///< c11,c22,c12,c66,c16,c26, Pa
  double density = 0;             ///< kg/m³
  std::string doubt;              ///< what the homogenisation was not content with; or empty
};

/// Reads `stiffness` and `density` of a homogenised material from a YAML file; `option` is named in errors.
EffectiveFile read_effective_file(const std::string& path, const std::string& option);

}  // namespace slipscale
