#include "gmsh_geometry.hpp"

#include <gmsh.h>

#include <algorithm>
#include <cmath>

namespace slipscale::in_gmsh_model {
namespace {

// Straight segments need no solid modeller: gmsh's own kernel meshes them twice as fast as OpenCASCADE's.
namespace kernel = gmsh::model::geo;

const std::array<std::pair<Side, const char*>, 4> sides{
    {{bottom, "bottom"}, {right, "right"}, {top, "top"}, {left, "left"}}};

void add_segments(const Drawing& drawing) {
  for (std::size_t i = 0; i < drawing.points.size(); ++i)
    kernel::addPoint(drawing.points[i][0], drawing.points[i][1], 0, 0, static_cast<int>(i) + 1);
  for (std::size_t k = 0; k < drawing.segments.size(); ++k)
    kernel::addLine(drawing.segments[k].from + 1, drawing.segments[k].to + 1, static_cast<int>(k) + 1);
}

void add_faces(const Drawing& drawing) {
  for (std::size_t f = 0; f < drawing.faces.size(); ++f) {
    std::vector<int> loops;
    for (const Drawing::Loop& loop : drawing.faces[f].loops) loops.push_back(kernel::addCurveLoop(loop));
    kernel::addPlaneSurface(loops, static_cast<int>(f) + 1);
  }
}

void name_sides(const Drawing& drawing) {
  for (const auto& [side, name] : sides)
    gmsh::model::setPhysicalName(1, gmsh::model::addPhysicalGroup(1, drawing.side(side)), name);
}

}  // namespace

void add_geometry(const Drawing& drawing) {
  add_segments(drawing);
  add_faces(drawing);
  kernel::synchronize();
  name_sides(drawing);
}

void new_model() {
  gmsh::clear();
  gmsh::model::add("composite");
  gmsh::model::mesh::removeSizeCallback();
}

void make_periodic(const Drawing& drawing, const Box& block, const std::array<bool, 2>& periodic) {
  const auto shifted = [](double x, double y) {
    return std::vector<double>{1, 0, 0, x, 0, 1, 0, y, 0, 0, 1, 0, 0, 0, 0, 1};
  };
  if (periodic[0])
    gmsh::model::mesh::setPeriodic(1, drawing.side(right), drawing.side(left), shifted(block.width(), 0));
  if (periodic[1])
    gmsh::model::mesh::setPeriodic(1, drawing.side(top), drawing.side(bottom), shifted(0, block.height()));
}

void match_periodic_nodes(const Drawing& drawing, const Box& block, const std::array<bool, 2>& periodic) {
  for (int axis = 0; axis < 2; ++axis) {
    if (!periodic[axis]) continue;
    for (int segment : drawing.side(axis == 0 ? right : top)) {
      int master = 0;
      std::vector<std::size_t> nodes, masters;
      std::vector<double> affine, x, parameters;
      gmsh::model::mesh::getPeriodicNodes(1, segment, master, nodes, masters, affine);
      for (std::size_t i = 0; i < nodes.size(); ++i) {
        gmsh::model::mesh::getNode(masters[i], x, parameters);
        x[axis] = block.upper[axis];
        gmsh::model::mesh::setNode(nodes[i], x, {});
      }
    }
  }
}

void divide_interfaces(const Drawing& drawing, double length) {
  for (std::size_t k = 0; k < drawing.segments.size(); ++k) {
    const Drawing::Segment& segment = drawing.segments[k];
    if (segment.sides) continue;
    const Vector2 &a = drawing.points[segment.from], &b = drawing.points[segment.to];
    const double parts = std::round(std::hypot(b[0] - a[0], b[1] - a[1]) / length);
    gmsh::model::mesh::setTransfiniteCurve(static_cast<int>(k) + 1, std::max(1, static_cast<int>(parts)) + 1);
  }
}

void name_regions(const std::vector<std::string>& regions, const std::vector<int>& region_of) {
  for (std::size_t region = 0; region < regions.size(); ++region) {
    std::vector<int> faces;
    for (std::size_t tag = 1; tag < region_of.size(); ++tag)
      if (region_of[tag] == static_cast<int>(region)) faces.push_back(static_cast<int>(tag));
    if (!faces.empty())
      gmsh::model::setPhysicalName(2, gmsh::model::addPhysicalGroup(2, faces), regions[region]);
  }
}

}  // namespace slipscale::in_gmsh_model
