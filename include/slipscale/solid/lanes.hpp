#pragma once

#include <cstring>

#include "slipscale/base/vector2.hpp"

namespace slipscale {

/// Both components of a plane vector, computed together: the vector type of GCC and Clang, which every
/// processor has in some form. Its arithmetic is that of two separate doubles, to the last bit.
using Lanes = double __attribute__((vector_size(16)));

inline Lanes load(const Vector2& x) {
  Lanes lanes;
  std::memcpy(&lanes, x.data(), sizeof lanes);
  return lanes;
}

inline void store(Vector2& x, Lanes lanes) { std::memcpy(x.data(), &lanes, sizeof lanes); }

inline void add(Vector2& x, Lanes lanes) { store(x, load(x) + lanes); }

}  // namespace slipscale
