#pragma once

#include "slipscale/morphology/composite_mesh.hpp"
#include "slipscale/morphology/placement.hpp"
#include "slipscale/morphology/random.hpp"

namespace slipscale {

struct Mending {
  int moved = 0;    ///< by less than the reach
  int redrawn = 0;  ///< taken out and put in another free place
  int dropped = 0;
  bool done() const { return moved + redrawn + dropped > 0; }
};

/// Moves the inclusions beside cells with an angle worse than `allowed` [radian] away from their neighbours,
/// by less than `reach` [m] from `drawn`, their places at first. One that finds no better place, or did not
/// mend its cell, is drawn anew elsewhere when there is a `random` for it, so that the fraction stays, and
/// dropped otherwise. Both lists keep the same order. Does nothing when no bad cell has an inclusion near.
Mending mend(std::vector<Inclusion>& inclusions, std::vector<Vector2>& drawn, const Room& room,
             const CompositeMesh& mesh, double allowed, double reach, Random* random);

}  // namespace slipscale
