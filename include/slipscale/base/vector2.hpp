#pragma once

#include <array>

namespace slipscale {

/// A vector of the plane, (x, y).
using Vector2 = std::array<double, 2>;

}  // namespace slipscale
