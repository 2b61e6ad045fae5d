#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace slipscale::mesh_stages {

struct PhysicalName {
  int dimension, tag;
  std::string name;
};

/// What the head of a gmsh file says, read before PETSc sees it.
struct GmshFile {
  double version = 0;
  bool has_periodic_section = false;
  bool vouched = false;  ///< PETSc can read it: every number was looked at
  std::uint64_t checksum = 0;
  std::vector<PhysicalName> names;
};

/// Reads the head of `path`; `fault` is set to one sentence when it is no usable gmsh file. One rank.
GmshFile scan_gmsh(const std::string& path, std::string& fault);

/// Checks the physical names: at least one surface, none used twice, none that a DMPlex uses itself.
std::string fault_in_names(const std::string& path, const std::vector<PhysicalName>& names);

}  // namespace slipscale::mesh_stages
