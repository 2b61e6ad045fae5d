#include "slipscale/morphology/gmsh_model.hpp"

#include <gmsh.h>

#include <unordered_map>

#include "gmsh_geometry.hpp"
#include "msh_file.hpp"
#include "slipscale/base/error.hpp"
#include "slipscale/morphology/mesh_size.hpp"

namespace slipscale {
namespace {

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

using namespace in_gmsh_model;

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
    add_geometry(drawing);
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
    add_geometry(drawing);
    make_periodic(drawing, block, periodic);
    for (const Side side : {bottom, right, top, left})
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
