#pragma once

#include "slipscale/modes/modes_basis.hpp"

namespace slipscale {

/// Which modes are looked for.
struct SearchAim {
  double to = 0;             ///< highest frequency, Hz
  int count = 10;            ///< so many that grow fastest
  double tolerance = 1e-10;  ///< of the residual
  int looks = 4;             ///< at most, for modes that a larger basis shows and a smaller one did not
};

struct ModesFound {
  std::vector<SlidingMode> modes;  ///< growth descending; one of each conjugate pair
  std::size_t in_window = 0;       ///< modes up to the highest frequency, in the basis at the end
  int rounds = 0, solves = 0;      ///< of the improvement
  std::vector<std::string> notes;  ///< what is not as asked for
};

/// Brings modes of a basis to a residual on the whole body by letting the basis grow (H. Voss, BIT Numer.
/// Math. 44 (2004) 387): by K⁻¹ of what is left of N(p) u, real and imaginary part, for all of the modes
/// together; then each is found again in the larger basis. `vector` of modes that come from a smaller basis
/// is filled up. Those that leave for another one or nowhere have p that is not a number. Collective.
ModesFound improve(ModesBasis& basis, const SlidingLaw& law, std::vector<SlidingMode> modes,
                   double tolerance);

/// Finds those that grow fastest: all eigenvalues of the basis, each improved, and once more until the larger
/// basis shows no new one. What dies away before a period is over is no vibration: with Re p < −Im p it is
/// the memory of friction, or damping. Collective.
ModesFound find_modes(ModesBasis& basis, const SlidingLaw& law, const SearchAim& aim);

}  // namespace slipscale
