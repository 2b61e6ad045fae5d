#pragma once

#include "fitting.hpp"

namespace slipscale::morphology {

/// Moves nodes near the block's sides, along the sides and the interfaces, where the grid would allow a
/// shorter step than elsewhere: an interface that cuts a side leaves triangles there with one node free.
/// Returns how many nodes moved.
int relieve(Fit& fit);

/// Wave speed times the stable step that the cells around a node allow, the rest of the body held, over the
/// side of a square; from above. Poisson's ratio .3.
double step_around(const Fit& fit, const Place& place);

}  // namespace slipscale::morphology
