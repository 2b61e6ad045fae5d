#pragma once

#include "slipscale/morphology/compose.hpp"

namespace slipscale {

/// Meshes the recipe's picture: its pixels as quadrilaterals, or, for -cell grid, squares fitted to the
/// contour between its two regions. Throws UserError.
void compose_image(const Recipe& recipe, GmshModel& gmsh, Composed& composed);

/// Throws UserError for more cells than a mesh file holds here.
void refuse_too_many(double cells);

}  // namespace slipscale
