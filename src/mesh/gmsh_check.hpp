#pragma once

#include <string>
#include <string_view>

namespace slipscale::mesh_stages {

/// PETSc reads a gmsh file on rank 0 and fails there alone, or follows numbers that lead nowhere; so the file
/// is looked through before. One rank.
struct GmshCheck {
  std::string
      fault;  ///< what is wrong and how to mend it, to be put behind the file's name; empty when nothing is
  bool vouched = false;  ///< every number was looked at: a text file of version 4.1 with no unusual sections
};
GmshCheck check_gmsh(std::string_view bytes);

}  // namespace slipscale::mesh_stages
