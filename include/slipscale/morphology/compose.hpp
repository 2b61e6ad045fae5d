#pragma once

#include <array>
#include <vector>

#include "slipscale/morphology/composite_mesh.hpp"
#include "slipscale/morphology/gmsh_model.hpp"
#include "slipscale/morphology/placement.hpp"
#include "slipscale/morphology/quality.hpp"

namespace slipscale {

/// A composite, drawn and meshed.
struct Composed {
  Box block;
  Placement placement;             ///< without inclusions for laminates, images and homogeneous blocks
  std::vector<double> drawn_area;  ///< of each inclusion or layer in the block, m²
  CompositeMesh mesh;
  MeshQuality quality;
  std::array<int, 2> grid{};  ///< columns and rows of equal cells; zero in other meshes
  /// Inclusions moved by less than the recipe's reach, drawn anew elsewhere, or dropped, because of bad
  /// cells.
  int moved = 0, redrawn = 0, dropped = 0;
};

/// Draws the recipe and meshes it in `gmsh`, from where it can be written. Throws UserError for a recipe that
/// cannot be drawn, and for cells that are worse than the recipe allows and cannot be mended.
Composed compose(const Recipe& recipe, GmshModel& gmsh);

}  // namespace slipscale
