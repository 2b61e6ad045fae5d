#include "compose_fitted.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "sides.hpp"
#include "slipscale/base/error.hpp"
#include "slipscale/base/print.hpp"
#include "slipscale/morphology/drawing.hpp"
#include "strip.hpp"

namespace slipscale {

using namespace morphology;

namespace {

Lattice lattice_of(const Recipe& recipe, Composed& composed) {
  composed.grid = grid_cells(recipe, composed.block);
  return {composed.block, recipe.room.periodic, composed.grid};
}

std::string inclusion_at(const Composed& composed, int part) {
  const Inclusion& inclusion = composed.placement.inclusions[part];
  return format("the inclusion at ({:g}, {:g}) m", inclusion.centre[0], inclusion.centre[1]);
}

/// Distance of two inclusions, images included, m.
double gap_between(const Inclusion& a, const Inclusion& b, const Room& room) {
  double least = 1e300;
  for (const Inclusion& one : images(a, room))
    for (const Inclusion& other : images(b, room)) least = std::min(least, separation(one, other));
  return least;
}

/// Names the worst of what the grid cannot resolve, and a size that does.
[[noreturn]] void refuse_unresolved(const FittedGrid& grid, const Recipe& recipe, const Composed& composed) {
  const double size = recipe.mesh.size.bulk;
  int places = 0;
  for (const auto& [parts, count] : grid.unresolved) places += count;
  const auto [parts, count] =
      *std::ranges::max_element(grid.unresolved, {}, [](const auto& entry) { return entry.second; });
  const auto& inclusions = composed.placement.inclusions;
  std::string what;
  double fits = 0.5 * size;
  if (inclusions.empty()) {
    what = "a layer";
  } else if (parts[1] == nobody) {
    what = "a tip of " + inclusion_at(composed, parts[0]);
    const Inclusion& one = inclusions[parts[0]];
    const double sharpest =
        one.shape == Shape::rectangle ? one.half_width : one.half_width * one.half_width / one.half_length;
    fits = std::min(0.7 * size, std::max(sharpest, 0.25 * size));
  } else {
    const double gap = gap_between(inclusions[parts[0]], inclusions[parts[1]], recipe.room);
    what = inclusion_at(composed, parts[0]) + " and " + inclusion_at(composed, parts[1]) +
           format(", {:.3g} m apart", gap);
    fits = std::min(0.9 * size, std::max(gap, 0.25 * size));
  }
  throw UserError(format(
      "-size {:g} is too coarse for the grid in {} places of {} inclusions or pairs of them, most often "
      "at {} ({}): two interfaces pass through one cell; give at most about {:.2g}, a larger -gap, or "
      "-cell triangle",
      size, places, grid.unresolved.size(), what, count, fits));
}

}  // namespace

std::array<int, 2> grid_cells(const Recipe& recipe, const Box& block) {
  std::array<int, 2> cells{};
  for (int axis = 0; axis < 2; ++axis)
    cells[axis] = std::max(1, static_cast<int>(std::lround(block.extent(axis) / recipe.mesh.size.bulk)));
  return cells;
}

void take(FittedGrid&& grid, Composed& composed) {
  composed.mesh = std::move(grid.mesh);
  composed.squeezed = grid.squeezed;
  composed.blunted = grid.blunted;
  composed.relieved = grid.relieved;
  composed.quality = quality(composed.mesh);
}

void fit_inclusions(const Recipe& recipe, const std::vector<std::string>& regions, Composed& composed) {
  const std::vector<Inclusion>& inclusions = composed.placement.inclusions;
  std::vector<Body> bodies;
  std::vector<double> drawn;
  for (std::size_t k = 0; k < inclusions.size(); ++k) {
    for (const Inclusion& image : images(inclusions[k], recipe.room))
      bodies.emplace_back(image, static_cast<int>(k));
    drawn.push_back(area_in_block(inclusions[k], recipe.room));
  }
  const Lattice lattice = lattice_of(recipe, composed);
  FittedGrid grid = fitted_grid(lattice, bodies, drawn, regions);
  if (!grid.unresolved.empty()) refuse_unresolved(grid, recipe, composed);
  if (composed.strip) name_above(grid.mesh, composed.grid[0], composed.strip->row);
  take(std::move(grid), composed);
}

void fit_layers(const Recipe& recipe, const std::vector<std::string>& regions, Composed& composed) {
  const LayerStack stack = slipscale::stack(recipe.laminate, recipe.room, recipe.mesh.size.interface);
  // Layers that continue one another across periodic sides are one part.
  int turn = 0;
  for (int axis = 0; axis < 2; ++axis)
    if (recipe.room.periodic[axis])
      turn = std::gcd(
          turn, static_cast<int>(std::lround(composed.block.extent(axis) * std::abs(stack.normal[axis]) /
                                             recipe.laminate.period)));
  const auto part_of = [&](int number) { return turn > 0 ? number % turn : number; };
  std::vector<Body> bodies;
  int parts = 0;
  for (const LayerStack::Layer& layer : stack.layers) {
    bodies.emplace_back(stack.normal, layer.low, layer.high, part_of(layer.number));
    parts = std::max(parts, part_of(layer.number) + 1);
  }
  composed.drawn_area.assign(static_cast<std::size_t>(parts), 0);
  for (const Piece& piece : layers(recipe.laminate, recipe.room, recipe.mesh.size.interface)) {
    std::vector<Vector2> corners;
    for (const Vertex& corner : piece.corners) corners.push_back(corner.x);
    composed.drawn_area[part_of(piece.inclusion)] += polygon_area(corners);
  }
  const Lattice lattice = lattice_of(recipe, composed);
  FittedGrid grid = fitted_grid(lattice, bodies, composed.drawn_area, regions);
  if (!grid.unresolved.empty()) refuse_unresolved(grid, recipe, composed);
  take(std::move(grid), composed);
}

}  // namespace slipscale
