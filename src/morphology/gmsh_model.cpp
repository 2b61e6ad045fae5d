#include "slipscale/morphology/gmsh_model.hpp"

#include <gmsh.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "msh_file.hpp"
#include "slipscale/base/error.hpp"
#include "slipscale/morphology/mesh_size.hpp"

namespace slipscale {
namespace {

// Straight segments need no solid modeller: gmsh's own kernel meshes them twice as fast as OpenCASCADE's.
namespace kernel = gmsh::model::geo;

const std::array<std::pair<Side, const char*>, 4> sides{
    {{bottom, "bottom"}, {right, "right"}, {top, "top"}, {left, "left"}}};

template <class Work>
auto in_gmsh(Work&& work) {
  try {
    return work();
  } catch (const std::exception&) {
    throw;
  } catch (...) {  // gmsh 4.8 throws plain numbers
    std::string message;
    gmsh::logger::getLastError(message);
    throw LibraryError("gmsh: " + message);
  }
}

void set(const char* option, double value) { gmsh::option::setNumber(option, value); }

void new_model() {
  gmsh::clear();
  gmsh::model::add("composite");
  gmsh::model::mesh::removeSizeCallback();
}

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

void make_periodic(const Drawing& drawing, const Box& block, const std::array<bool, 2>& periodic) {
  const auto shifted = [](double x, double y) {
    return std::vector<double>{1, 0, 0, x, 0, 1, 0, y, 0, 0, 1, 0, 0, 0, 0, 1};
  };
  if (periodic[0])
    gmsh::model::mesh::setPeriodic(1, drawing.side(right), drawing.side(left), shifted(block.width(), 0));
  if (periodic[1])
    gmsh::model::mesh::setPeriodic(1, drawing.side(top), drawing.side(bottom), shifted(0, block.height()));
}

/// gmsh places nodes of a periodic side to some 1e-12 of its length only: make it the last bit.
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

/// Interfaces keep the points that were drawn: the polygon's area is right only with those.
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

void set_sizes(const SizeField& field, const MeshSize& size) {
  set("Mesh.MeshSizeFromPoints", 0);
  set("Mesh.MeshSizeExtendFromBoundary", 0);
  set("Mesh.MeshSizeMax", size.bulk);
  set("Mesh.MeshSizeMin", 0);
  if (!field.uniform())
    gmsh::model::mesh::setSizeCallback([&field](int, int, double x, double y, double) {
      return field({x, y});
    });
}

/// Triangles that the size field asks for, by samples.
double expected_triangles(const SizeField& field, const Box& block) {
  constexpr int samples = 100;
  double sum = 0;
  for (int j = 0; j < samples; ++j)
    for (int i = 0; i < samples; ++i) {
      const double length = field({block.lower[0] + (i + 0.5) / samples * block.width(),
                                   block.lower[1] + (j + 0.5) / samples * block.height()});
      sum += 4 / std::sqrt(3) / (length * length);
    }
  return sum * block.width() * block.height() / (samples * samples);
}

/// gmsh's best pairing of triangles (blossom) leaves 7 % of the cells unpaired, at a cost that is quadratic
/// in their number: half a minute for 150 000, more than six for 600 000. The greedy one leaves 23 %.
void recombine(std::size_t faces, double triangles) {
  constexpr double most_for_blossom = 2e5;
  set("Mesh.RecombinationAlgorithm", triangles > most_for_blossom ? 0 : 1);
  for (std::size_t face = 1; face <= faces; ++face)
    gmsh::model::mesh::setRecombine(2, static_cast<int>(face));
}

/// Node tags of gmsh, densely numbered in their order.
struct NodeTable {
  std::vector<Vector2> x;
  std::vector<std::size_t> tags;
  std::unordered_map<std::size_t, int> number;
};

NodeTable read_nodes() {
  std::vector<std::size_t> tags;
  std::vector<double> x, parameters;
  gmsh::model::mesh::getNodes(tags, x, parameters, -1, -1, false, false);
  NodeTable table;
  for (std::size_t i = 0; i < tags.size(); ++i)
    if (table.number.emplace(tags[i], static_cast<int>(table.x.size())).second) {
      table.x.push_back({x[3 * i], x[3 * i + 1]});
      table.tags.push_back(tags[i]);
    }
  return table;
}

constexpr int gmsh_triangle = 2, gmsh_quadrilateral = 3;

/// Moves the quadrilaterals of surface 1 to one discrete surface for each region, tags 2 and up.
void part_by_pixels(const Box& block, int columns, int rows, const std::vector<int>& region,
                    std::size_t regions) {
  std::vector<std::size_t> tags, corners;
  gmsh::model::mesh::getElementsByType(gmsh_quadrilateral, tags, corners, 1);
  const NodeTable nodes = read_nodes();
  std::vector<std::vector<std::size_t>> parts(regions);
  for (std::size_t cell = 0; cell < tags.size(); ++cell) {
    Vector2 middle{};
    for (int i = 0; i < 4; ++i)
      for (int axis = 0; axis < 2; ++axis)
        middle[axis] += 0.25 * nodes.x[nodes.number.at(corners[4 * cell + i])][axis];
    const int column = static_cast<int>((middle[0] - block.lower[0]) / block.width() * columns),
              row = static_cast<int>((middle[1] - block.lower[1]) / block.height() * rows);
    auto& part = parts[region[static_cast<std::size_t>(row) * columns + column]];
    part.insert(part.end(), corners.begin() + 4 * static_cast<std::ptrdiff_t>(cell),
                corners.begin() + 4 * static_cast<std::ptrdiff_t>(cell) + 4);
  }
  for (std::size_t k = 0; k < regions; ++k) {
    const int tag = gmsh::model::addDiscreteEntity(2, static_cast<int>(k) + 2);
    gmsh::model::mesh::addElementsByType(tag, gmsh_quadrilateral, {}, parts[k]);
  }
}

}  // namespace

GmshModel::GmshModel() {
  in_gmsh([] {
    gmsh::initialize(0, nullptr, false);
    set("General.Terminal", 0);
    set("General.NumThreads", 1);
    set("Mesh.Algorithm", 6);  // frontal Delaunay: the best triangles
    set("Mesh.MshFileVersion", 4.1);
    set("Mesh.SaveAll", 0);
  });
}

GmshModel::~GmshModel() {
  try {
    gmsh::finalize();
  } catch (...) {  // nothing is left to be done for it
  }
}

std::string GmshModel::version() { return GMSH_API_VERSION; }

void GmshModel::mesh(const Drawing& drawing, const std::vector<std::string>& regions, const Room& room,
                     const MeshChoice& choice) {
  regions_ = regions;
  region_of_.assign(1, 0);
  inclusion_of_.assign(1, -1);
  for (const Drawing::Face& face : drawing.faces) {
    region_of_.push_back(face.region);
    inclusion_of_.push_back(face.inclusion);
  }
  const SizeField field(choice.size, room.block, drawing);
  in_gmsh([&] {
    new_model();
    add_segments(drawing);
    add_faces(drawing);
    kernel::synchronize();
    name_sides(drawing);
    name_regions(regions_, region_of_);
    make_periodic(drawing, room.block, room.periodic);
    divide_interfaces(drawing, choice.size.interface);
    if (choice.cell == CellShape::quadrilateral)
      recombine(drawing.faces.size(), expected_triangles(field, room.block));
    set_sizes(field, choice.size);
    gmsh::model::mesh::generate(2);
    gmsh::model::mesh::removeSizeCallback();
    match_periodic_nodes(drawing, room.block, room.periodic);
  });
}

void GmshModel::mesh_grid(const Box& block, const std::array<bool, 2>& periodic, int columns, int rows,
                          CellShape cell, const std::vector<std::string>& regions,
                          const std::vector<int>& region) {
  const Drawing drawing = draw(block, {});
  regions_ = regions;
  in_gmsh([&] {
    new_model();
    add_segments(drawing);
    add_faces(drawing);
    kernel::synchronize();
    name_sides(drawing);
    make_periodic(drawing, block, periodic);
    for (const auto& [side, name] : sides)
      for (int segment : drawing.side(side))
        gmsh::model::mesh::setTransfiniteCurve(segment, (side == bottom || side == top ? columns : rows) + 1);
    gmsh::model::mesh::setTransfiniteSurface(1, "AlternateLeft");
    if (cell == CellShape::quadrilateral) gmsh::model::mesh::setRecombine(2, 1);
    gmsh::model::mesh::generate(2);
    match_periodic_nodes(drawing, block, periodic);
  });
  region_of_.assign(2, 0);
  if (regions_.size() > 1) {
    in_gmsh([&] { part_by_pixels(block, columns, rows, region, regions_.size()); });
    region_of_[1] = -1;  // its cells are those of the others
    for (std::size_t k = 0; k < regions_.size(); ++k) region_of_.push_back(static_cast<int>(k));
  }
  inclusion_of_.assign(region_of_.size(), -1);
  in_gmsh([&] { name_regions(regions_, region_of_); });
}

CompositeMesh GmshModel::read() {
  CompositeMesh mesh;
  mesh.regions = regions_;
  in_gmsh([&] {
    NodeTable nodes = read_nodes();
    for (std::size_t tag = 1; tag < region_of_.size(); ++tag) {
      if (region_of_[tag] < 0) continue;
      for (const int type : {gmsh_triangle, gmsh_quadrilateral}) {
        const int count = type == gmsh_triangle ? 3 : 4;
        std::vector<std::size_t> tags, corners;
        gmsh::model::mesh::getElementsByType(type, tags, corners, static_cast<int>(tag));
        for (std::size_t cell = 0; cell < tags.size(); ++cell) {
          mesh.cells.push_back({{}, count, region_of_[tag], inclusion_of_[tag]});
          for (int i = 0; i < count; ++i)
            mesh.cells.back().corners[i] =
                nodes.number.at(corners[static_cast<std::size_t>(count) * cell + i]);
        }
      }
    }
    mesh.nodes = std::move(nodes.x);
    node_tags_ = std::move(nodes.tags);
  });
  return mesh;
}

void GmshModel::move(const CompositeMesh& mesh, const std::vector<int>& nodes) {
  in_gmsh([&] {
    for (int node : nodes)
      gmsh::model::mesh::setNode(node_tags_[node], {mesh.nodes[node][0], mesh.nodes[node][1], 0}, {});
  });
}

void GmshModel::write(const std::string& path) const {
  in_gmsh([&] { gmsh::write(path); });
  refuse_cut_short(path);
  sort_periodic_pairs(path);
}

}  // namespace slipscale
