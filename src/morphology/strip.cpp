#include "strip.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "gaps.hpp"
#include "sides.hpp"
#include "slipscale/base/error.hpp"
#include "slipscale/base/print.hpp"

namespace slipscale::morphology {
namespace {

Room room_above(const Room& room, const Strip& strip) {
  Room above = room;
  above.block.lower[1] = strip.end;
  above.keep_out = 0;
  return above;
}

bool cuts(const Inclusion& inclusion, double height) {
  return inclusion.centre[1] - support(inclusion, {0, -1}) < height &&
         inclusion.centre[1] + support(inclusion, {0, 1}) > height;
}

/// Whether the end crosses the outline well, or passes it at a distance; with -edge inside it must pass.
bool ends_properly(const Inclusion& inclusion, const Room& room, const Strip& strip) {
  return !side_fault_or_outside(inclusion, room_below(room, strip)).found;
}

/// A row of a grid; otherwise the height, a tenth off the one asked for at most and the nearest such, that
/// ends the most inclusions properly.
void choose_end(const Recipe& recipe, const std::vector<Inclusion>& inclusions, Strip& strip) {
  const double wanted = *recipe.microstructure_height, height = recipe.room.block.height();
  if (recipe.mesh.cell == CellShape::grid) {
    const auto rows = std::lround(height / recipe.mesh.size.bulk),
               row = std::lround(wanted / height * static_cast<double>(rows));
    strip.row = static_cast<int>(std::clamp(row, 1L, rows - 1));
    strip.end = height * strip.row / static_cast<double>(rows);
    return;
  }
  strip.end = wanted;
  if (recipe.room.edge == Edge::inside || recipe.room.clearance == 0) return;
  const double step = 0.5 * recipe.room.clearance;
  auto fewest = static_cast<std::ptrdiff_t>(inclusions.size()) + 1;
  for (int k = 0; fewest > 0 && k * step <= 0.1 * wanted; ++k)
    for (const double end : {wanted - k * step, wanted + k * step}) {
      if (end > height - recipe.mesh.size.bulk) continue;
      const Strip tried{end};
      const std::ptrdiff_t improper = std::ranges::count_if(
          inclusions, [&](const Inclusion& one) { return !ends_properly(one, recipe.room, tried); });
      if (improper >= fewest) continue;
      fewest = improper;
      strip.end = end;
    }
}

/// Points along a horizontal line, by x.
std::vector<int> points_along(const Drawing& drawing, double y) {
  std::vector<int> found;
  for (std::size_t k = 0; k < drawing.points.size(); ++k)
    if (drawing.points[k][1] == y) found.push_back(static_cast<int>(k));
  std::ranges::sort(found, {}, [&](int k) { return drawing.points[k][0]; });
  return found;
}

/// Puts one drawing on top of the other, whose points and segments on the line between them are shared.
class Joint {
 public:
  Joint(Drawing lower, const Drawing& upper, double y) : drawing_(std::move(lower)), upper_(upper), y_(y) {}

  Drawing joined() {
    share_points();
    share_segments();
    for (const Drawing::Face& face : upper_.faces) {
      drawing_.faces.push_back(face);
      for (Drawing::Loop& loop : drawing_.faces.back().loops)
        for (int& segment : loop) segment = segment > 0 ? segment_[segment - 1] : -segment_[-segment - 1];
    }
    return std::move(drawing_);
  }

 private:
  void share_points() {
    const std::vector<int> ours = points_along(drawing_, y_), theirs = points_along(upper_, y_);
    if (ours.size() != theirs.size()) throw std::logic_error("the strip and what is above it do not fit");
    point_.assign(upper_.points.size(), -1);
    for (std::size_t i = 0; i < ours.size(); ++i) point_[theirs[i]] = ours[i];
    for (std::size_t k = 0; k < upper_.points.size(); ++k)
      if (point_[k] < 0) {
        point_[k] = static_cast<int>(drawing_.points.size());
        drawing_.points.push_back(upper_.points[k]);
      }
  }

  void share_segments() {
    const std::vector<int> ours = drawing_.side(top), theirs = upper_.side(bottom);
    if (ours.size() != theirs.size()) throw std::logic_error("the strip and what is above it do not fit");
    segment_.assign(upper_.segments.size(), 0);
    for (std::size_t i = 0; i < ours.size(); ++i) {
      Drawing::Segment& shared = drawing_.segments[ours[i] - 1];
      shared.sides = 0;
      const bool same_way = shared.from == point_[upper_.segments[theirs[i] - 1].from];
      segment_[theirs[i] - 1] = same_way ? ours[i] : -ours[i];
    }
    for (std::size_t k = 0; k < upper_.segments.size(); ++k)
      if (segment_[k] == 0) {
        const Drawing::Segment& segment = upper_.segments[k];
        drawing_.segments.push_back({point_[segment.from], point_[segment.to], segment.sides});
        segment_[k] = static_cast<int>(drawing_.segments.size());
      }
  }

  Drawing drawing_;
  const Drawing& upper_;
  double y_;
  std::vector<int> point_, segment_;  ///< of the upper drawing, in the joined one
};

}  // namespace

Room room_below(const Room& room, const Strip& strip) {
  Room below = room;
  below.block.upper[1] = strip.end;
  return below;
}

Strip end_strip(const Recipe& recipe, Placement& placement) {
  const double wanted = *recipe.microstructure_height;
  Strip strip;
  std::vector<Inclusion>& inclusions = placement.inclusions;
  const std::vector<Inclusion> all = inclusions;
  std::erase_if(inclusions, [&](const Inclusion& inclusion) { return inclusion.centre[1] > wanted; });
  choose_end(recipe, inclusions, strip);
  if (recipe.mesh.cell != CellShape::grid || recipe.room.edge == Edge::inside)
    std::erase_if(inclusions,
                  [&](const Inclusion& inclusion) { return !ends_properly(inclusion, recipe.room, strip); });
  const auto cut = std::ranges::count_if(all, [&](const Inclusion& one) { return cuts(one, strip.end); });
  strip.whole = across(inclusions, strip);
  strip.left_out = static_cast<int>(cut) - strip.whole;
  strip.above = static_cast<int>(all.size() - inclusions.size()) - strip.left_out;
  for (std::size_t k = 0; k < recipe.families.size(); ++k)
    if (std::ranges::count(inclusions, static_cast<int>(k), &Inclusion::family) == 0)
      throw UserError(
          format("-microstructure_height {:g} leaves no inclusion of the region '{}'; give more, or, where "
                 "the block is to be homogeneous, -shape none",
                 wanted, recipe.families[k].region));
  placement.smallest_gap = smallest_gap(inclusions, recipe.room);
  return strip;
}

int across(const std::vector<Inclusion>& inclusions, const Strip& strip) {
  return static_cast<int>(std::ranges::count_if(
      inclusions, [&](const Inclusion& inclusion) { return cuts(inclusion, strip.end); }));
}

Drawing draw_strip(const Recipe& recipe, const std::vector<Inclusion>& inclusions, const Strip& strip) {
  const double length = recipe.mesh.size.interface;
  const Room below = room_below(recipe.room, strip), above = room_above(recipe.room, strip);
  Drawing upper = draw(above.block, polygons(inclusions, above, length));
  for (Drawing::Face& face : upper.faces)
    if (face.inclusion < 0) face.region = static_cast<int>(recipe.families.size()) + 1;
  return Joint(draw(below.block, polygons(inclusions, below, length)), upper, strip.end).joined();
}

void name_above(CompositeMesh& mesh, int columns, int row) {
  const int region = static_cast<int>(mesh.regions.size()) - 1;
  for (CompositeMesh::Cell& cell : mesh.cells) {
    const int lowest = *std::min_element(cell.corners.begin(), cell.corners.begin() + cell.count);
    if (cell.region == 0 && lowest / (columns + 1) >= row) cell.region = region;
  }
}

}  // namespace slipscale::morphology
