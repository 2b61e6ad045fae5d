#pragma once

#include <array>

namespace slipscale {

/// (xx, yy, xy): strain with engineering shear, or stress in Pa.
using PlaneTensor = std::array<double, 3>;
/// Of its components: (xx.xx, yy.yy, xy.xy, yy.xy, xx.xy, xx.yy).
using PlaneCovariance = std::array<double, 6>;

}  // namespace slipscale
