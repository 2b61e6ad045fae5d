#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "gmsh_text.hpp"

namespace slipscale::mesh_stages {

struct PhysicalName {
  int dimension, tag;
  std::string name;
};

/// A gmsh file as rank 0 has read it; the other ranks know all but the mesh.
struct GmshFile {
  double version = 0;
  bool has_periodic_section = false;
  bool is_read = false;  ///< `mesh` holds it on rank 0; otherwise PETSc must read it
  std::uint64_t checksum = 0;
  std::vector<PhysicalName> names;
  std::optional<GmshMesh> mesh;
};

/// Reads the file at `path`; `fault` is set to one sentence when it is no usable gmsh file. One rank.
GmshFile read_gmsh(const std::string& path, std::string& fault);

/// Checks the physical names: at least one surface, none used twice, none that a DMPlex uses itself.
std::string fault_in_names(const std::string& path, const std::vector<PhysicalName>& names);

}  // namespace slipscale::mesh_stages
