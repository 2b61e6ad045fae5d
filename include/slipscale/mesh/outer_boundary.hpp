#pragma once

#include <vector>

#include "slipscale/mesh/mesh.hpp"

namespace slipscale {

/// An edge with a cell on one side only, with at least one owned end.
struct OuterEdge {
  std::array<int, 2> nodes{};  ///< local, counter-clockwise around its cell
  Vector2 outward{};           ///< normal times length, m
};

/// The outer edges around the owned nodes. Every cell around an owned node is local, so nothing is exchanged.
std::vector<OuterEdge> outer_edges(const Mesh& mesh);

}  // namespace slipscale
