#pragma once

#include <cmath>
#include <numbers>

namespace slipscale {

/// The cosine ramp ½(1 − cos(πt/duration)), held at 1 afterwards; duration 0 is at once. Loads, prescribed
/// displacements and the speed of the surface follow it.
inline double cosine_ramp(double time, double duration) {
  if (time >= duration) return 1;
  return time <= 0 ? 0 : 0.5 * (1 - std::cos(std::numbers::pi * time / duration));
}

}  // namespace slipscale
