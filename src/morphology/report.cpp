#include "slipscale/morphology/report.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "slipscale/base/print.hpp"
#include "slipscale/files/yaml.hpp"
#include "slipscale/version.hpp"

namespace slipscale {
namespace {

constexpr double degree = std::numbers::pi / 180;

/// A grid fitted to a picture.
bool contoured(const Recipe& recipe) {
  return recipe.composite == Composite::image && recipe.mesh.cell == CellShape::grid;
}

/// Largest relative difference between an inclusion's meshed and drawn area.
double area_error(const Composed& composed) {
  const auto meshed = inclusion_areas(composed.mesh, composed.drawn_area.size());
  double most = 0;
  for (std::size_t k = 0; k < meshed.size(); ++k)
    if (composed.drawn_area[k] > 0) most = std::max(most, std::abs(meshed[k] / composed.drawn_area[k] - 1));
  return most;
}

long triangles(const CompositeMesh& mesh) {
  return std::ranges::count(mesh.cells, 3, &CompositeMesh::Cell::count);
}

std::string place(const CompositeMesh& mesh, int cell) {
  Vector2 middle{};
  const std::vector<Vector2> corners = mesh.corners(mesh.cells[cell]);
  for (const Vector2& x : corners)
    for (int axis = 0; axis < 2; ++axis) middle[axis] += x[axis] / static_cast<double>(corners.size());
  return "(" + engineering(middle[0], "m") + ", " + engineering(middle[1], "m") + ")";
}

std::string region_table(const Recipe& recipe, const Composed& composed) {
  const CompositeMesh& mesh = composed.mesh;
  const std::vector<double> areas = region_areas(mesh);
  std::vector<std::vector<std::string>> rows{
      {"region", "cells", "area [m2]", "fraction", "asked", "inclusions"}};
  for (std::size_t k = 0; k < mesh.regions.size(); ++k) {
    const auto number = static_cast<int>(k);
    const bool family = k > 0 && k <= recipe.families.size();
    const double asked = family                                         ? recipe.families[k - 1].fraction
                         : recipe.composite == Composite::laminate && k ? recipe.laminate.fraction
                                                                        : 0;
    rows.push_back({mesh.regions[k],
                    format("{}", static_cast<long>(
                                     std::ranges::count(mesh.cells, number, &CompositeMesh::Cell::region))),
                    format("{:.6e}", areas[k]),
                    format("{:.5f}", areas[k] / (composed.block.width() * composed.block.height())),
                    asked > 0 ? format("{:.5f}", asked) : "-",
                    family ? format("{}", static_cast<long>(std::ranges::count(
                                              composed.placement.inclusions, number - 1, &Inclusion::family)))
                           : "-"});
  }
  return table(rows);
}

std::string placement_line(const Composed& composed) {
  const Placement& placement = composed.placement;
  std::string text =
      "smallest gap " + (std::isfinite(placement.smallest_gap) ? engineering(placement.smallest_gap, "m")
                                                               : std::string("none"));
  if (placement.relaxed)
    text += format("; {} inclusions found room only after others had moved", placement.relaxed);
  const int moved = placement.moved + composed.moved, dropped = placement.dropped + composed.dropped;
  if (moved + composed.redrawn + dropped)
    text += format("; repaired: {} moved, {} drawn anew, {} dropped", moved, composed.redrawn, dropped);
  return text + "\n";
}

std::string strip_line(const Composed& composed) {
  const Strip& strip = *composed.strip;
  double area = 0;
  for (const double inclusion : composed.drawn_area) area += inclusion;
  return "microstructure up to " + engineering(strip.end, "m") +
         format(
             " above the contact, {:.4f} of which is inclusions; of the others {} would be cut by its end "
             "and {} "
             "lie above it; {} reach across it\n",
             area / (composed.block.width() * strip.end), strip.left_out, strip.above, strip.whole);
}

double part_of_picture(const Composed& composed, long pixels) {
  return static_cast<double>(pixels) / composed.pixels[0] / composed.pixels[1];
}

std::string changed(const std::string& option, long value, const Composed& composed, long pixels) {
  return value == 0 ? ""
                    : format("-{} {} changed the region of {} pixels, {:.3g} of the area\n", option, value,
                             pixels, part_of_picture(composed, pixels));
}

std::string fit_line(const Composed& composed) {
  std::string text = "fitted to the interfaces";
  if (composed.relieved)
    text += format("; {} moves along sides and interfaces for a longer step", composed.relieved);
  if (composed.squeezed)
    text += format("; {} cells are narrower, between interfaces less than a cell apart", composed.squeezed);
  if (composed.blunted)
    text += format("; {} nodes on the sides bound wedges that are thinner than half a cell and left out",
                   composed.blunted);
  return text + "\n";
}

std::string contour_line(const Recipe& recipe, const Composed& composed) {
  const double meshed = region_areas(composed.mesh)[1] / (composed.block.width() * composed.block.height());
  std::string text =
      format("'{}' has {:.5f} of the pixels and {:.5f} of the mesh, with the level {:+.4f} off its own\n",
             recipe.image.regions[1], composed.pixel_fraction, meshed, composed.level_shift);
  if (composed.unresolved)
    text += format(
        "-size {:g} is too coarse for the grid in {} places: two interfaces pass through one cell and are "
        "left "
        "out there; a smaller one shows them, -image_median or -image_despeckle takes them away\n",
        recipe.mesh.size.bulk, composed.unresolved);
  return text;
}

std::string histogram(const MeshQuality& quality) {
  std::string text = "cells by smallest angle:";
  for (std::size_t bin = 0; bin < quality.histogram.size(); ++bin)
    if (quality.histogram[bin])
      text += format("  {}-{}: {}", 10 * bin, 10 * bin + 10, quality.histogram[bin]);
  return text + " (degrees)\n";
}

}  // namespace

std::string describe(const Recipe& recipe, const Composed& composed) {
  const CompositeMesh& mesh = composed.mesh;
  const MeshQuality& quality = composed.quality;
  std::string text = "block " + engineering(composed.block.width(), "m") + " x " +
                     engineering(composed.block.height(), "m") +
                     format(", {} nodes, {} triangles, {} quadrilaterals\n", mesh.nodes.size(),
                            triangles(mesh), static_cast<long>(mesh.cells.size()) - triangles(mesh));
  if (composed.grid[0] > 0)
    text += format("{} columns and {} rows of cells, ", composed.grid[0], composed.grid[1]) +
            engineering(composed.block.width() / composed.grid[0], "m") + " x " +
            engineering(composed.block.height() / composed.grid[1], "m") + "\n";
  if (composed.coloured) text += "the picture is coloured: its grey is the luma .299 R + .587 G + .114 B\n";
  text += changed("image_median", recipe.image.median, composed, composed.filtered) +
          changed("image_despeckle", recipe.image.despeckle, composed, composed.despeckled);
  if (recipe.mesh.cell == CellShape::grid) text += fit_line(composed);
  if (contoured(recipe)) text += contour_line(recipe, composed);
  text += region_table(recipe, composed);
  if (!composed.placement.inclusions.empty()) text += placement_line(composed);
  if (composed.strip) text += strip_line(composed);
  if (!composed.drawn_area.empty())
    text += format("meshed against drawn area of an inclusion: at most {:.1e} apart\n", area_error(composed));
  text += histogram(quality);
  text += format("angles {:.2f} to {:.2f} degrees\n", quality.smallest_angle / degree,
                 quality.largest_angle / degree);
  text += format("the step is set by cell {} at ", quality.step_cell) + place(mesh, quality.step_cell) +
          ": dilatational speed times stable step " + engineering(quality.step_length, "m") +
          format(", {:.2f} of the median cell's (Poisson's ratio .3)\n",
                 quality.step_length / quality.typical_step_length);
  return text;
}

std::string morphology_yaml(const std::map<std::string, std::string>& effective, const Recipe& recipe,
                            const Composed& composed) {
  return run_yaml(effective, [&](Yaml& yaml) {
    const MeshQuality& quality = composed.quality;
    yaml.text("program", "morphology").text("version", version).text("gmsh", GmshModel::version());
    yaml.integer("nodes", static_cast<long>(composed.mesh.nodes.size()));
    yaml.integer("triangles", triangles(composed.mesh));
    yaml.integer("quadrilaterals", static_cast<long>(composed.mesh.cells.size()) - triangles(composed.mesh));
    const std::vector<double> areas = region_areas(composed.mesh);
    yaml.begin("fraction", "achieved in the mesh");
    for (std::size_t k = 0; k < areas.size(); ++k)
      yaml.exact(composed.mesh.regions[k], areas[k] / (composed.block.width() * composed.block.height()));
    yaml.end();
    if (const auto& inclusions = composed.placement.inclusions; !inclusions.empty()) {
      yaml.integer("inclusions", static_cast<long>(inclusions.size()));
      if (std::isfinite(composed.placement.smallest_gap))
        yaml.exact("smallest_gap", composed.placement.smallest_gap, "m");
      yaml.integer("relaxed", composed.placement.relaxed,
                   "inclusions that found room only after others had moved");
      yaml.integer("moved", composed.placement.moved + composed.moved, "repaired");
      yaml.integer("redrawn", composed.redrawn, "repaired");
      yaml.integer("dropped", composed.placement.dropped + composed.dropped, "repaired");
      if (composed.strip) {
        yaml.exact("microstructure_end", composed.strip->end, "m, above it is the region homogenized");
        yaml.integer("across_end", composed.strip->whole, "inclusions that stay whole there");
        yaml.integer("left_out", composed.strip->left_out, "inclusions that it would have cut");
      }
      if (recipe.composite == Composite::array)
        yaml.exact("drawn_diameter", 2 * inclusions.front().half_length, "m");
    }
    if (!composed.drawn_area.empty())
      yaml.number("area_error", area_error(composed), "largest, of an inclusion, meshed against drawn");
    if (recipe.image.median > 0)
      yaml.exact("median_filtered", part_of_picture(composed, composed.filtered),
                 "of the area, that went to another region");
    if (recipe.image.despeckle > 0)
      yaml.exact("despeckled", part_of_picture(composed, composed.despeckled),
                 "of the area, that went to another region after it");
    if (contoured(recipe)) {
      yaml.exact("pixel_fraction", composed.pixel_fraction,
                 "of the pixels, in '" + recipe.image.regions[1] +
                     "'; the mesh has it to 1e-4 or as near as it can");
      yaml.exact("level_shift", composed.level_shift, "of the grey level, which makes it so");
      yaml.integer("unresolved", composed.unresolved, "edges with two interfaces, left out there");
    }
    yaml.number("smallest_angle", quality.smallest_angle / degree, "degree");
    yaml.number("largest_angle", quality.largest_angle / degree, "degree");
    yaml.number("step_length", quality.step_length,
                "m, dilatational speed times stable step at Poisson's ratio .3");
    yaml.number("median_step_length", quality.typical_step_length, "m");
  });
}

}  // namespace slipscale
