#include "slipscale/dynamics/scheme.hpp"

#include <cmath>

namespace slipscale {

double stable_step(double frequency, double beta2, const Damping& damping) {
  const double quadratic = beta2 * frequency * frequency;
  const double linear = damping.mass + 2 * damping.stiffness * quadratic;
  // The positive root of quadratic Δt² + linear Δt − 2 in the form that does not cancel.
  return 4 / (linear + std::sqrt(linear * linear + 8 * quadratic));
}

}  // namespace slipscale
