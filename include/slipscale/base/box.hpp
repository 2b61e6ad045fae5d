#pragma once

#include "slipscale/base/vector2.hpp"

namespace slipscale {

/// A rectangle with sides along the axes, m.
struct Box {
  Vector2 lower{}, upper{};
  double extent(int axis) const { return upper[axis] - lower[axis]; }
  double width() const { return extent(0); }
  double height() const { return extent(1); }
};

}  // namespace slipscale
