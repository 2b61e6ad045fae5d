#pragma once

#include <stdexcept>
#include <string>

namespace slipscale::mesh_stages {

/// What is wrong with a mesh file and how to mend it, to be put behind its name: "is cut short: …; …", or
/// ": the cell at …" where the sentence has another subject.
struct GmshFault : std::runtime_error {
  using std::runtime_error::runtime_error;
};

inline const std::string write_again = "write it again with gmsh -2 -format msh41";

}  // namespace slipscale::mesh_stages
