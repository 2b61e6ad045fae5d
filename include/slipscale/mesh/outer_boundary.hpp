#pragma once

#include <optional>
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

/// A place, m, where the two sides of a torus's seam differ, though the mesh file pairs them: an edge whose
/// two cells see it with different ends. Of this rank's edges; empty when all match, and on a mesh without
/// seam.
std::optional<Vector2> unmatched_edge(const Mesh& mesh);

/// Number of parts of the mesh that share no node. Collective.
int connected_parts(MPI_Comm comm, const Mesh& mesh);

}  // namespace slipscale
