#pragma once

#include <string>
#include <vector>

#include "slipscale/base/options.hpp"
#include "slipscale/dynamics/formulas.hpp"
#include "slipscale/mesh/mesh.hpp"
#include "slipscale/solid/material.hpp"

/// What programs that read a scene, `slide` and `modes`, do with its names.
namespace slipscale {

/// The names that options may carry: those of the mesh, and `all` for every region that has no material of
/// its own.
inline void know_names(Options& options, const Mesh& mesh) {
  auto regions = mesh.region_names();
  regions.push_back("all");
  options.know_names("region", regions);
  options.know_names("boundary", mesh.boundary_names());
  know_formula_names(options, mesh);
}

inline std::vector<std::string> descriptions(const std::vector<Material>& materials) {
  std::vector<std::string> texts;
  for (const Material& material : materials) texts.push_back(material.description);
  return texts;
}

}  // namespace slipscale
