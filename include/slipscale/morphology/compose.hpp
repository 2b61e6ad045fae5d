#pragma once

#include <array>
#include <optional>
#include <vector>

#include "slipscale/morphology/composite_mesh.hpp"
#include "slipscale/morphology/gmsh_model.hpp"
#include "slipscale/morphology/placement.hpp"
#include "slipscale/morphology/quality.hpp"

namespace slipscale {

/// The microstructure ends at a height above which the block is one homogeneous region.
struct Strip {
  double end = 0;    ///< m
  int row = 0;       ///< of a grid, whose cells begin there
  int whole = 0;     ///< inclusions that reach across the end
  int left_out = 0;  ///< that would have been cut by it
  int above = 0;     ///< that would have lain above it
};

/// A composite, drawn and meshed.
struct Composed {
  Box block;
  Placement placement;             ///< without inclusions for laminates, images and homogeneous blocks
  std::vector<double> drawn_area;  ///< of each inclusion or layer in the block, m²
  CompositeMesh mesh;
  MeshQuality quality;
  std::array<int, 2> grid{};    ///< columns and rows of a grid, fitted or not; zero in other meshes
  int squeezed = 0;             ///< edges of a fitted grid between two interfaces less than a cell apart
  int blunted = 0;              ///< its nodes on the sides where an interface cuts too flat for it
  int relieved = 0;             ///< moves of its nodes near the sides of the block for a longer step
  std::array<int, 2> pixels{};  ///< columns and rows of the picture
  int unresolved = 0;           ///< edges of a grid fitted to it with two interfaces, left out there
  double pixel_fraction = 0;    ///< of the pixels in its bright region, of that grid
  double level_shift = 0;       ///< of the grey level, that gives the grid this fraction
  bool coloured = false;        ///< the picture's levels are the luma of its colours
  long filtered = 0;            ///< pixels of the picture that the median filter brought to another region
  long despeckled = 0;          ///< and those of small islands after it
  /// Inclusions moved by less than the recipe's reach, drawn anew elsewhere, or dropped, because of bad
  /// cells.
  int moved = 0, redrawn = 0, dropped = 0;
  std::optional<Strip> strip;
};

/// Cells that the recipe will have at least, nearly; 0 for pictures, which tell it themselves.
double expected_cells(const Recipe& recipe);

/// Draws the recipe and meshes it in `gmsh`, from where it can be written. Throws UserError for a recipe that
/// cannot be drawn, and for cells that are worse than the recipe allows and cannot be mended.
Composed compose(const Recipe& recipe, GmshModel& gmsh);

/// Writes the mesh as MSH 4.1 text. Throws UserError when it cannot be written.
void write_mesh(const Recipe& recipe, const Composed& composed, const GmshModel& gmsh,
                const std::string& path);

}  // namespace slipscale
