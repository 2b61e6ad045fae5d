#include <cmath>
#include <cstdio>

#include "slipscale/solid/material.hpp"
#include "slipscale/version.hpp"

/// Prints the stiffness of a solid; 0 when it is what it must be.
int main() {
  const slipscale::Material solid{slipscale::isotropic_stiffness(45e9, 0.25), 1800, "an isotropic solid"};
  const auto waves = slipscale::wave_speeds(solid, 0, 1);
  std::printf("slipscale %s: C22 = %g Pa, waves %g and %g m/s\n", slipscale::version, solid.c22(), waves.fast,
              waves.slow);
  return std::abs(solid.c22() - 54e9) < 1 && waves.fast > waves.slow ? 0 : 1;
}
