#pragma once

#include <vector>

#include "gmsh_mesh.hpp"

namespace slipscale::mesh_stages {

/// What a file says of the nodes that are one a period away.
struct Periods {
  std::vector<int> original;    ///< by node, the one that it repeats, itself where there is none
  std::vector<Vector2> shifts;  ///< from the originals to the copies, m; each once
};

/// Throws GmshFault for pairs that are no shifts of one another, or go in a circle.
Periods periods_of(const GmshMesh& mesh);

}  // namespace slipscale::mesh_stages
