#include "slipscale/morphology/compose.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "compose_fitted.hpp"
#include "compose_image.hpp"
#include "mend.hpp"
#include "sides.hpp"
#include "slipscale/base/error.hpp"
#include "slipscale/base/print.hpp"
#include "slipscale/morphology/drawing.hpp"
#include "slipscale/morphology/grid_file.hpp"
#include "slipscale/morphology/smooth.hpp"
#include "strip.hpp"

namespace slipscale {
namespace {

constexpr int repairs = 8;                                      ///< meshes made before a recipe is given up
constexpr double smoothed_below = 35 * std::numbers::pi / 180;  ///< a cell with such an angle costs time step

std::vector<std::string> region_names(const Recipe& recipe) {
  std::vector<std::string> names{"matrix"};
  if (recipe.composite == Composite::laminate) names.push_back("inclusion");
  for (const Family& family : recipe.families) names.push_back(family.region);
  if (recipe.microstructure_height) names.push_back(morphology::region_above);
  return names;
}

bool good_enough(const MeshQuality& quality, double allowed) {
  return std::min(quality.smallest_angle, std::numbers::pi - quality.largest_angle) >= allowed;
}

[[noreturn]] void refuse_bad_cells(const Recipe& recipe, const Composed& composed) {
  const CompositeMesh& mesh = composed.mesh;
  const auto angle = [&](const CompositeMesh::Cell& cell) { return worst_angle(mesh.corners(cell)); };
  const CompositeMesh::Cell worst = *std::ranges::min_element(mesh.cells, {}, angle);
  const Vector2& x = mesh.nodes[worst.corners[0]];
  throw UserError(format(
      "the mesh has a cell at ({:g}, {:g}) m with an angle within {:.2f} degrees of 0 or 180, and "
      "-worst_angle asks for {:g}; give a smaller -size_interface or -size, a larger -gap or "
      "-repair, or a smaller -worst_angle",
      x[0], x[1], angle(worst) * 180 / std::numbers::pi, recipe.mesh.worst_angle * 180 / std::numbers::pi));
}

void mesh_drawing(const Recipe& recipe, const Drawing& drawing, GmshModel& gmsh, Composed& composed) {
  gmsh.mesh(drawing, region_names(recipe), recipe.room, recipe.mesh);
  composed.mesh = gmsh.read();
  gmsh.move(composed.mesh, smooth(composed.mesh, smoothed_below));
  composed.quality = quality(composed.mesh);
}

void compose_grid(const Recipe& recipe, GmshModel& gmsh, Composed& composed) {
  const auto [columns, rows] = composed.grid = grid_cells(recipe, composed.block);
  gmsh.mesh_grid(composed.block, recipe.room.periodic, columns, rows, recipe.mesh.cell, {"matrix"}, {});
  composed.mesh = gmsh.read();
  composed.quality = quality(composed.mesh);
}

void compose_laminate(const Recipe& recipe, GmshModel& gmsh, Composed& composed) {
  if (recipe.mesh.cell == CellShape::grid) return fit_layers(recipe, region_names(recipe), composed);
  const std::vector<Piece> pieces = layers(recipe.laminate, recipe.room, recipe.mesh.size.interface);
  int layers_drawn = 0;
  for (const Piece& piece : pieces) layers_drawn = std::max(layers_drawn, piece.inclusion + 1);
  mesh_drawing(recipe, draw(composed.block, pieces), gmsh, composed);
  composed.drawn_area.assign(static_cast<std::size_t>(layers_drawn), 0);
  for (const Piece& piece : pieces) {
    std::vector<Vector2> corners;
    for (const Vertex& corner : piece.corners) corners.push_back(corner.x);
    composed.drawn_area[piece.inclusion] += polygon_area(corners);
  }
}

Drawing drawing_of(const Recipe& recipe, const Composed& composed) {
  const std::vector<Inclusion>& inclusions = composed.placement.inclusions;
  if (composed.strip) return morphology::draw_strip(recipe, inclusions, *composed.strip);
  return draw(composed.block, polygons(inclusions, recipe.room, recipe.mesh.size.interface));
}

void compose_inclusions(const Recipe& recipe, GmshModel& gmsh, Composed& composed) {
  Placement& placement = composed.placement;
  placement = recipe.composite == Composite::random
                  ? place_at_random(recipe.families, recipe.room, recipe.seed)
                  : place_in_array(recipe.families.front(), recipe.room, recipe.array);
  if (recipe.microstructure_height) composed.strip = morphology::end_strip(recipe, placement);
  Random random(recipe.seed);
  std::vector<Vector2> drawn;
  for (const Inclusion& inclusion : placement.inclusions) drawn.push_back(inclusion.centre);
  for (int round = 0;; ++round) {
    if (recipe.mesh.cell == CellShape::grid)
      fit_inclusions(recipe, region_names(recipe), composed);
    else
      mesh_drawing(recipe, drawing_of(recipe, composed), gmsh, composed);
    if (good_enough(composed.quality, recipe.mesh.worst_angle) || round == repairs) break;
    const Room room = composed.strip ? morphology::room_below(recipe.room, *composed.strip) : recipe.room;
    const Mending mending = mend(placement.inclusions, drawn, room, composed.mesh, recipe.mesh.worst_angle,
                                 recipe.repair, recipe.composite == Composite::random ? &random : nullptr);
    if (!mending.done()) break;
    composed.moved += mending.moved;
    composed.redrawn += mending.redrawn;
    composed.dropped += mending.dropped;
  }
  if (composed.strip) composed.strip->whole = morphology::across(placement.inclusions, *composed.strip);
  std::ranges::fill(placement.fraction, 0.0);
  composed.drawn_area.assign(placement.inclusions.size(), 0);
  for (std::size_t k = 0; k < placement.inclusions.size(); ++k) {
    const Inclusion& inclusion = placement.inclusions[k];
    composed.drawn_area[k] = morphology::area_in_block(inclusion, recipe.room);
    placement.fraction[inclusion.family] +=
        composed.drawn_area[k] / (composed.block.width() * composed.block.height());
  }
}

}  // namespace

void refuse_too_many(double cells) {
  constexpr double most_cells = 1e8;
  if (cells > most_cells)
    throw UserError(
        format("-size asks for about {:.1e} cells, beyond the {:.0e} that a mesh file holds here; give a "
               "larger one",
               cells, most_cells));
}

double expected_cells(const Recipe& recipe) {
  if (recipe.composite == Composite::image) return 0;
  const double size = recipe.mesh.size.bulk;
  return 2.3 * recipe.room.block.width() * recipe.room.block.height() / (size * size);
}

Composed compose(const Recipe& recipe, GmshModel& gmsh) {
  Composed composed;
  composed.block = recipe.room.block;
  refuse_too_many(expected_cells(recipe));
  switch (recipe.composite) {
    case Composite::homogeneous:
      if (recipe.mesh.cell == CellShape::grid)
        fit_inclusions(recipe, region_names(recipe), composed);
      else if (recipe.mesh.structured)
        compose_grid(recipe, gmsh, composed);
      else
        mesh_drawing(recipe, draw(composed.block, {}), gmsh, composed);
      break;
    case Composite::laminate:
      compose_laminate(recipe, gmsh, composed);
      break;
    case Composite::image:
      compose_image(recipe, gmsh, composed);
      break;
    case Composite::random:
    case Composite::array:
      compose_inclusions(recipe, gmsh, composed);
      break;
  }
  if (!good_enough(composed.quality, recipe.mesh.worst_angle)) refuse_bad_cells(recipe, composed);
  return composed;
}

void write_mesh(const Recipe& recipe, const Composed& composed, const GmshModel& gmsh,
                const std::string& path) {
  if (recipe.mesh.cell == CellShape::grid)
    write_grid_msh(composed.mesh, composed.block, composed.grid, recipe.room.periodic, path);
  else
    gmsh.write(path);
}

}  // namespace slipscale
