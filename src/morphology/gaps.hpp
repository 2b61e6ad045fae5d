#pragma once

#include <vector>

#include "slipscale/morphology/recipe.hpp"

namespace slipscale::morphology {

/// Smallest separation of any two of the inclusions, with the images across periodic sides, those of an
/// inclusion itself among them, m. Infinite when there is only one.
double smallest_gap(const std::vector<Inclusion>& inclusions, const Room& room);

}  // namespace slipscale::morphology
