#pragma once

#include <array>
#include <cstring>

#include "slipscale/mesh/mesh.hpp"
#include "slipscale/solid/material.hpp"

namespace slipscale {

/// What follows from the shape of a cell and what it is made of, kept for the last few that were asked for:
/// on a grid the cells beside each other are alike, to the last bit.
template <class Value>
class ByShape {
 public:
  using Shape = std::array<Vector2, 4>;

  /// `make(shape)` where it is not among the last few.
  template <class Make>
  const Value& of(const Mesh& mesh, int cell, const Solid& solid, Make&& make) {
    const Shape shape = mesh.shape_of(cell);
    const int corners = mesh.cells.corner_count(cell);
    for (const Known& known : known_)
      if (known.corners == corners && std::memcmp(&known.shape, &shape, sizeof shape) == 0 &&
          known.solid == solid)
        return known.value;
    Known& known = known_[next_++ % known_.size()];
    known = {corners, shape, solid, make(std::span(shape.data(), static_cast<std::size_t>(corners)))};
    return known.value;
  }

 private:
  struct Known {
    int corners = 0;
    Shape shape{};
    Solid solid{};
    Value value{};
  };
  std::array<Known, 4> known_{};
  std::size_t next_ = 0;
};

}  // namespace slipscale
