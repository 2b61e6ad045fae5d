#include "compose_image.hpp"

#include <algorithm>
#include <cmath>

#include "compose_fitted.hpp"
#include "fitted_grid.hpp"
#include "slipscale/base/error.hpp"
#include "slipscale/base/print.hpp"

namespace slipscale {

using namespace morphology;

namespace {

/// A picture after its filters, and the region of each pixel, row by row from the bottom.
struct Filtered {
  GreyPicture picture;
  std::vector<int> region;
};

void refuse_narrow(const Recipe& recipe, const GreyPicture& picture) {
  for (int axis = 0; axis < 2; ++axis)
    if (const int across = axis == 0 ? picture.columns : picture.rows;
        recipe.room.periodic[axis] && across < 3)
      throw UserError(format(
          "-image_file '{}' has {} {}, and -periodic {} needs three at least; give a larger "
          "picture, or another -periodic",
          recipe.image.file, across, axis == 0 ? "columns" : "rows", recipe.room.periodic[1] ? "xy" : "x"));
}

Filtered read_filtered(const Recipe& recipe, Composed& composed) {
  const GreyImage& image = recipe.image;
  GreyPicture picture = read_grey(image.file);
  refuse_too_many(static_cast<double>(picture.columns) * picture.rows);
  refuse_narrow(recipe, picture);
  composed.pixels = {picture.columns, picture.rows};
  composed.block.upper = {picture.columns * image.pixel, picture.rows * image.pixel};
  const std::vector<int> unfiltered = regions_of(picture, image);
  median_filter(picture, recipe.room.periodic, image.median);
  std::vector<int> region = regions_of(picture, image);
  for (std::size_t k = 0; k < region.size(); ++k) composed.filtered += region[k] != unfiltered[k];
  composed.coloured = picture.coloured;
  composed.despeckled =
      despeckle(region, picture.columns, picture.rows, recipe.room.periodic, image.despeckle);
  for (std::size_t k = 0; k < image.regions.size(); ++k)
    if (std::ranges::count(region, static_cast<int>(k)) == 0)
      throw UserError("no pixel of -image_file '" + image.file + "' has the grey of region '" +
                      image.regions[k] + "'; change -image_levels");
  return {std::move(picture), std::move(region)};
}

/// Pixels that went to another region get a grey of it: their own, mirrored at the level.
void take_despeckled(Filtered& filtered, double level) {
  constexpr double least = 1e-3;  // off the level
  const std::ptrdiff_t columns = filtered.picture.columns, rows = filtered.picture.rows;
  for (std::ptrdiff_t row = 0; row < rows; ++row)
    for (std::ptrdiff_t column = 0; column < columns; ++column) {
      double& grey = filtered.picture.grey[(rows - 1 - row) * columns + column];
      const bool bright = filtered.region[row * columns + column] == 1;
      if (bright == (grey >= level)) continue;
      grey = bright ? std::max(2 * level - grey, level + least) : std::min(2 * level - grey, level - least);
    }
}

void refuse_coarse_grid(const Recipe& recipe, const Composed& composed) {
  const auto most = [&](int axis) {
    return composed.block.extent(axis) / (recipe.room.periodic[axis] ? 3 : 1);
  };
  const int axis = most(0) < most(1) ? 0 : 1;  // the one that asks for more
  if (recipe.mesh.size.bulk <= most(axis) * (1 + 1e-9)) return;
  throw UserError(format(
      "-size {:g} {} {} of the picture ({:g} m); give a few pixels, of {:g} m each", recipe.mesh.size.bulk,
      recipe.room.periodic[axis] ? "leaves fewer than three cells across the periodic" : "is more than the",
      axis == 0 ? "width" : "height", composed.block.extent(axis), recipe.image.pixel));
}

/// Shapes of a cell or two across lie between the nodes, and no level brings their area back.
void refuse_lost_area(const Recipe& recipe, const Composed& composed) {
  constexpr double most = 0.01;  // of the block
  const double meshed = region_areas(composed.mesh)[1] / (composed.block.width() * composed.block.height());
  if (std::abs(meshed - composed.pixel_fraction) > most)
    throw UserError(
        format("-size {:g} is too coarse for the picture: '{}' has {:.3f} of the pixels and would "
               "have {:.3f} of the mesh; give a smaller one, or leave out -cell grid",
               recipe.mesh.size.bulk, recipe.image.regions[1], composed.pixel_fraction, meshed));
}

/// Bisects the level until the meshed area of the bright region is that of its pixels: a chord is shorter
/// than its arc, corners of single pixels are cut off. The area jumps where a square changes sides; the level
/// that comes nearest is kept. Returns how far it is off its own.
double set_level_by_area(const Lattice& lattice, Contour& contour, const std::vector<std::string>& regions,
                         double wanted) {
  constexpr int halvings = 14;
  constexpr double enough = 1e-5;    // of the block
  constexpr double farthest = 0.75;  // of the way to black or white
  const double level = contour.level(), block = lattice.block().width() * lattice.block().height();
  const double reach = farthest * std::min(level, 1 - level);
  double low = level - reach, high = level + reach, best = level, least = INFINITY;
  for (int k = 0; k <= halvings && least > enough; ++k) {
    const double excess = (region_areas(fitted_grid(lattice, contour, regions).mesh)[1] - wanted) / block;
    if (std::abs(excess) < least) {
      least = std::abs(excess);
      best = contour.level();
    }
    (excess > 0 ? low : high) = contour.level();
    contour.set_level(0.5 * (low + high));
  }
  contour.set_level(best);
  return best - level;
}

void fit_contour(const Recipe& recipe, Filtered& filtered, Composed& composed) {
  refuse_coarse_grid(recipe, composed);
  composed.grid = grid_cells(recipe, composed.block);
  refuse_too_many(1.0 * composed.grid[0] * composed.grid[1]);
  take_despeckled(filtered, recipe.image.levels[0]);
  Contour contour(filtered.picture, recipe.room.periodic, recipe.image.pixel, recipe.image.levels[0]);
  const Lattice lattice(composed.block, recipe.room.periodic, composed.grid);
  composed.pixel_fraction = static_cast<double>(std::ranges::count(filtered.region, 1)) /
                            static_cast<double>(filtered.region.size());
  const double wanted = composed.pixel_fraction * composed.block.width() * composed.block.height();
  composed.level_shift = set_level_by_area(lattice, contour, recipe.image.regions, wanted);
  FittedGrid grid = fitted_grid(lattice, contour, recipe.image.regions, wanted);
  for (const auto& [parts, count] : grid.unresolved) composed.unresolved += count;
  take(std::move(grid), composed);
  refuse_lost_area(recipe, composed);
}

}  // namespace

void compose_image(const Recipe& recipe, GmshModel& gmsh, Composed& composed) {
  Filtered filtered = read_filtered(recipe, composed);
  if (recipe.mesh.cell == CellShape::grid) return fit_contour(recipe, filtered, composed);
  composed.grid = composed.pixels;
  gmsh.mesh_grid(composed.block, recipe.room.periodic, composed.grid[0], composed.grid[1],
                 CellShape::quadrilateral, recipe.image.regions, filtered.region);
  composed.mesh = gmsh.read();
  composed.quality = quality(composed.mesh);
}

}  // namespace slipscale
