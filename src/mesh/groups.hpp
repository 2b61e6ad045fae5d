#pragma once

#include <string>
#include <vector>

#include "gmsh_mesh.hpp"
#include "slipscale/mesh/mesh.hpp"

namespace slipscale::mesh_stages {

/// Regions and boundaries without their sizes, and what is to be said about their names.
struct Groups {
  std::vector<Region> regions;       ///< physical surfaces: those with a name as the file lists them, the
  std::vector<Boundary> boundaries;  ///< others by tag; physical curves likewise
  std::vector<std::string> notes;
};

/// Finds the physical groups of a file. One without a name, or whose name is a number, is called surface_7 or
/// curve_7 by its tag. Throws GmshFault when there is no surface and for names that no option can bear.
Groups find_groups(const GmshMesh& mesh);

}  // namespace slipscale::mesh_stages
