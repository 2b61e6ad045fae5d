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

/// How much of an energy balance, J/m, rounding may account for at an observed step n. Where a component of u
/// is rounded by δ ≤ ε|u|/2, the internal force and the loads do work along δ that the velocities do not know
/// of: the balance misses δ times the force that accelerates the node, m a. That happens in each of the n + 1
/// steps so far, whose forces are taken to be those of this one; twice that leaves room for larger ones.
/// Beside it, ½uᵀKu and the work of gravity are known to some last digits of their terms' sizes, now and at
/// the start. In a run whose increments stand clear of the last digit of u this lies far below what flowed.
/// The same on any number of ranks to rounding; collective.
double rounding_of_balance(const SlidingBody& body);

/// What is wrong with a state whose energies are `energy`, and where; then what helps. The causes are told
/// apart by the numbers: a displacement that is finite while its energy is not means loads beyond what
/// stiffness bears; without either the balance of the energies is what is missed.
struct Astray {
  std::string fault, cure;
};
Astray explain(const Energy& energy, const Extreme& extreme, const TimeStep& time, long history_every);

}  // namespace slipscale
