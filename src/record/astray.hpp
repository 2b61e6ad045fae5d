#pragma once

#include <string>

#include "slipscale/dynamics/sliding_body.hpp"

namespace slipscale {

/// The node of the whole body that is displaced most at an observed step: where u or v is no number before
/// all others.
struct Extreme {
  double displacement = 0;  ///< larger component of u, m; infinite where u or v is no finite number
  PetscInt node = 0;        ///< whole-mesh number; the lowest of equals
  Vector2 place{};          ///< m
  std::string region;       ///< of the first cell around it
};

/// The same on every rank, whatever their number. Collective.
Extreme most_displaced(const SlidingBody& body);

/// What is wrong with a state whose energies are `energy`, and where; then what helps. The causes are told
/// apart by the numbers: a displacement that is finite while its energy is not means loads beyond what
/// stiffness bears; without either the balance of the energies is what is missed.
struct Astray {
  std::string fault, cure;
};
Astray explain(const Energy& energy, const Extreme& extreme, const TimeStep& time, long history_every);

}  // namespace slipscale
