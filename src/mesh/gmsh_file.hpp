#pragma once

#include <cstdint>
#include <string>

#include "gmsh_mesh.hpp"

namespace slipscale::mesh_stages {

/// A gmsh file as rank 0 has read it.
struct GmshFile {
  std::uint64_t checksum = 0;  ///< FNV-1a of its bytes
  GmshMesh mesh;
};

/// Reads a file of MSH 4.1, text or binary. Throws UserError for what is no such file, with the command that
/// makes it one, and for one that is damaged. One rank.
GmshFile read_gmsh(const std::string& path);

/// The sentence about a fault in the mesh file at `path`.
std::string sentence(const std::string& path, const std::string& fault);

}  // namespace slipscale::mesh_stages
