#pragma once

#include "slipscale/morphology/inclusion.hpp"

namespace slipscale::morphology {

/// Radius of the circle around an inclusion, m.
double bounding_radius(const Inclusion& inclusion);

/// Separation of two inclusions where only those closer than `reach` matter: for those further apart any
/// lower bound above it may come back. `normal` is tried first, unless it is zero; where the inclusions are
/// closer it becomes the separating direction.
double separation_within(double reach, const Inclusion& a, const Inclusion& b, Vector2* normal = nullptr);

}  // namespace slipscale::morphology
