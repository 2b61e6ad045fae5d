#pragma once

#include "slipscale/modes/mode_search.hpp"
#include "slipscale/modes/modes_choice.hpp"
#include "slipscale/modes/steady_sliding.hpp"

namespace slipscale {

/// A mode followed along a sweep; not a number where it is lost.
struct ModePath {
  std::vector<Complex> exponent;  ///< [values] p, 1/s
  std::vector<double> residual;   ///< [values] on the whole body, relative; no finer than 1e-8 can be told
};

/// Where a path crosses from decay into growth, or back.
struct StabilityLimit {
  std::size_t path = 0;
  double value = 0;      ///< between two of the sweep, by linear interpolation
  double frequency = 0;  ///< Hz
  bool grows = false;    ///< beyond it
};

/// Where two modes come nearest to one another and their growth rates part: flutter.
struct Coupling {
  std::size_t paths[2] = {0, 0};
  double value = 0;
  double frequency = 0;  ///< mean of the two, Hz
  double distance = 0;   ///< |p_a − p_b|/|p|
};

struct ModesSweep {
  SweepChoice choice;
  std::vector<ModePath> paths;
  std::vector<StabilityLimit> limits;
  std::vector<Coupling> couplings;
  PetscInt basis = 0;                  ///< vectors that serve the whole sweep
  std::vector<double> places;          ///< where modes were found on the whole body
  double worst = 0;                    ///< residual of all points
  std::vector<double> same_contact{};  ///< first and last value at which the same nodes touch; empty: at none
  std::vector<std::string> notes{};    ///< what is not as asked for
};

/// Follows the modes that grow fastest at the ends and in the middle, both ways, in a basis of their own
/// vectors at these places. Where a point's residual on the whole body is too large, the modes are found
/// there as well and all is followed anew. The closed nodes are those of the scene's own values: where a
/// coefficient opens or closes others, that is told. Collective.
ModesSweep sweep_modes(ModesBasis& basis, const SteadySliding& state, const Scene& scene,
                       const SweepChoice& choice, const SearchAim& aim);

/// The limits and couplings of paths, from their exponents.
void find_events(ModesSweep& sweep);

/// The table of a sweep for the terminal.
std::string describe(const ModesSweep& sweep);

}  // namespace slipscale
