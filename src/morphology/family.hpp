#pragma once

#include "slipscale/morphology/random.hpp"
#include "slipscale/morphology/recipe.hpp"

namespace slipscale::morphology {

/// The inclusion of the family with the given long axis (m) and angle (radian), centred at the origin.
Inclusion shaped(const Family& family, int index, double diameter, double angle);

/// An inclusion with size and angle from the family's distributions. Angles and normal sizes are cut off at
/// three deviations, lognormal sizes at three deviations of their logarithm. Normal and uniform sizes also
/// stay within nine tenths of the mean from it, above as below, so that these cuts do not move the mean; that
/// of lognormal sizes moves it by less than 1 % up to a deviation of one third.
Inclusion drawn(const Family& family, int index, Random& random);

/// Size of the largest inclusion that `drawn` gives, over the mean.
double largest_size(const Family& family);

/// Largest extent along an axis of the inclusions that `drawn` gives, m.
double largest_extent(const Family& family, int axis);

}  // namespace slipscale::morphology
