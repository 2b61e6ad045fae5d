#include <cmath>

#include "slipscale/base/print.hpp"
#include "slipscale/solid/material.hpp"
#include "slipscale/version.hpp"

/// Prints the stiffness of a solid (through fmt, which comes with the library); 0 when it is what it must be.
int main() {
  const slipscale::Material solid{slipscale::isotropic_stiffness(45e9, 0.25), 1800, "an isotropic solid"};
  const auto waves = slipscale::wave_speeds(solid, 0, 1);
  fmt::print("{}", slipscale::format("slipscale {}: C22 = {:g} Pa, waves {:.0f} and {:.0f} m/s\n",
                                     slipscale::version, solid.c22(), waves.fast, waves.slow));
  return std::abs(solid.c22() - 54e9) < 1 && waves.fast > waves.slow ? 0 : 1;
}
