#pragma once

#include <array>

#include "slipscale/solid/material.hpp"

namespace slipscale {

/// σ_zz/(σ_xx + σ_yy) in plane strain: Poisson's ratio, C12/(C11 + C12) of an isotropic solid. NaN for a
/// stiffness that is not isotropic in the plane: what it does across the plane it does not tell. (One that is
/// isotropic in the plane alone is taken for isotropic.)
double transverse_ratio(const Material& material);

/// Von Mises' equivalent stress of (xx, yy, xy) and zz, Pa.
double von_mises(const double* stress, double zz);

/// The principal stresses in the plane, the larger first, Pa.
std::array<double, 2> principal_stresses(const double* stress);

}  // namespace slipscale
