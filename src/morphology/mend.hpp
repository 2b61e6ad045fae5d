#pragma once

#include "slipscale/morphology/composite_mesh.hpp"
#include "slipscale/morphology/placement.hpp"

namespace slipscale {

struct Mending {
  int moved = 0, dropped = 0;
};

/// Moves the inclusions beside cells with an angle worse than `allowed` [radian] away from their neighbours,
/// by less than `reach` [m] from `drawn`, their places at first; drops those that find no better place. Both
/// lists keep the same order. Does nothing when no bad cell has an inclusion near.
Mending mend(std::vector<Inclusion>& inclusions, std::vector<Vector2>& drawn, const Room& room,
             const CompositeMesh& mesh, double allowed, double reach);

}  // namespace slipscale
