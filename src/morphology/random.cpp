#include "slipscale/morphology/random.hpp"

#include <cmath>
#include <numbers>

namespace slipscale {

double quantised(double x) { return std::ldexp(std::nearbyint(std::ldexp(x, 40)), -40); }

double Random::uniform() { return std::ldexp(static_cast<double>(engine_() >> 24), -40); }

/// Box and Muller, Ann. Math. Stat. 29 (1958) 610. The second number of the pair is not kept: a state would
/// make the numbers depend on the order of calls.
double Random::normal() {
  const double radius = std::sqrt(-2 * std::log(1 - uniform()));
  return quantised(radius * std::cos(2 * std::numbers::pi * uniform()));
}

}  // namespace slipscale
