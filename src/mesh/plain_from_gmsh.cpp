#include <algorithm>
#include <numeric>
#include <tuple>
#include <unordered_map>

#include "plain_mesh.hpp"

namespace slipscale::mesh_stages {
namespace {

/// Vertex of each node; -1 for nodes that no cell uses.
std::vector<PetscInt> number_vertices(const GmshMesh& file, const std::vector<int>& original) {
  std::vector<PetscInt> vertex(file.nodes.size(), -1);
  for (const GmshMesh::Cell& cell : file.cells)
    for (const int node : cell.nodes)
      if (node >= 0) vertex[node] = vertex[original[node]] = 0;
  PetscInt count = 0;
  for (std::size_t node = 0; node < vertex.size(); ++node)
    if (vertex[node] >= 0 && original[node] == static_cast<int>(node)) vertex[node] = count++;
  for (std::size_t node = 0; node < vertex.size(); ++node)
    if (vertex[node] >= 0) vertex[node] = vertex[original[node]];
  return vertex;
}

/// Cells with a vertex on the seam keep their own corners.
void keep_corners(const GmshMesh& file, const std::vector<int>& original, const std::vector<PetscInt>& vertex,
                  PlainMesh& mesh) {
  std::vector<char> on_seam(mesh.position.size(), 0);
  for (std::size_t node = 0; node < vertex.size(); ++node)
    if (vertex[node] >= 0 && original[node] != static_cast<int>(node)) on_seam[vertex[node]] = 1;
  mesh.own.assign(mesh.cells.size(), -1);
  for (std::size_t k = 0; k < mesh.cells.size(); ++k) {
    const auto corners = corners_of(mesh.cells[k]);
    if (std::ranges::none_of(corners, [&](PetscInt v) { return on_seam[v] == 1; })) continue;
    mesh.own[k] = static_cast<PetscInt>(mesh.own_corners.size());
    auto& own = mesh.own_corners.emplace_back();
    for (std::size_t c = 0; c < corners.size(); ++c) own[c] = file.nodes[file.cells[k].nodes[c]];
  }
  settle_seam(mesh);
}

/// The groups of each entity: indices into `groups`, which are all that have elements, ascending.
template <class Group>
std::vector<std::vector<std::size_t>> groups_of(const std::vector<std::vector<int>>& tags,
                                                const std::vector<Group>& groups) {
  std::unordered_map<int, std::size_t> index;
  for (std::size_t g = 0; g < groups.size(); ++g) index.emplace(groups[g].tag, g);
  std::vector<std::vector<std::size_t>> found(tags.size());
  for (std::size_t entity = 0; entity < tags.size(); ++entity) {
    for (const int tag : tags[entity])
      if (const auto group = index.find(tag); group != index.end()) found[entity].push_back(group->second);
    std::ranges::sort(found[entity]);
    found[entity].erase(std::ranges::unique(found[entity]).begin(), found[entity].end());
  }
  return found;
}

/// A side of a cell and its vertices, ascending.
struct SeenSide {
  PetscInt low, high;
  CellSide side;
};

/// All sides of cells that may lie on a named line, those of one edge together, the first cell's first.
std::vector<SeenSide> sides_between(const std::vector<char>& on_line, const PlainMesh& mesh) {
  std::vector<SeenSide> seen;
  for (std::size_t k = 0; k < mesh.cells.size(); ++k) {
    const auto corners = corners_of(mesh.cells[k]);
    for (std::size_t c = 0; c < corners.size(); ++c) {
      const PetscInt a = corners[c], b = corners[(c + 1) % corners.size()];
      if (on_line[a] && on_line[b])
        seen.push_back({std::min(a, b), std::max(a, b), {static_cast<PetscInt>(k), static_cast<int>(c)}});
    }
  }
  std::ranges::sort(seen, {}, [](const SeenSide& s) { return std::tuple(s.low, s.high, s.side.cell); });
  return seen;
}

void find_boundaries(const GmshMesh& file, const std::vector<PetscInt>& vertex,
                     const std::vector<Boundary>& boundaries, PlainMesh& mesh) {
  const auto groups = groups_of(file.curve_groups, boundaries);
  std::vector<char> on_line(mesh.position.size(), 0);
  for (const GmshMesh::Line& line : file.lines)
    if (!groups[line.curve].empty())
      for (const int node : line.nodes)
        if (vertex[node] >= 0) on_line[vertex[node]] = 1;
  const std::vector<SeenSide> seen = sides_between(on_line, mesh);
  mesh.boundaries.resize(boundaries.size());
  for (const GmshMesh::Line& line : file.lines) {
    if (groups[line.curve].empty()) continue;
    const PetscInt a = vertex[line.nodes[0]], b = vertex[line.nodes[1]];
    const auto edge = std::ranges::equal_range(seen, std::pair(std::min(a, b), std::max(a, b)), {},
                                               [](const SeenSide& s) { return std::pair(s.low, s.high); });
    if (edge.empty())
      throw GmshFault("has a curve of the group '" + boundaries[groups[line.curve].front()].name +
                      "' that belongs to no cell; save only the physical groups that bound a meshed surface");
    for (const std::size_t g : groups[line.curve]) {
      mesh.boundaries[g].sides.push_back(edge.front().side);
      if (edge.size() > 1) mesh.boundaries[g].interior = true;
    }
  }
  const auto place = [](const CellSide& side) { return std::pair(side.cell, side.corner); };
  for (auto& [sides, interior] : mesh.boundaries) {
    std::ranges::sort(sides, {}, place);
    sides.erase(std::ranges::unique(sides, {}, place).begin(), sides.end());  // both sides of a seam
  }
}

}  // namespace

std::vector<int> turn_clockwise_surfaces(GmshMesh& file) {
  std::vector<char> clockwise(file.surface_tags.size(), 1);
  const auto corners = [](const GmshMesh::Cell& cell) { return cell.nodes[3] < 0 ? 3 : 4; };
  const auto is_clockwise = [&](const GmshMesh::Cell& cell) {
    CellGeometry shape;
    if (corners(cell) == 4) shape.vertices.fill(0);
    for (int k = 0; k < corners(cell); ++k) shape.corners[k] = file.nodes[cell.nodes[k]];
    return shape.area() < 0;
  };
  for (const GmshMesh::Cell& cell : file.cells)
    if (clockwise[cell.surface] && !is_clockwise(cell)) clockwise[cell.surface] = 0;
  std::vector<char> turned(clockwise.size(), 0);
  for (GmshMesh::Cell& cell : file.cells) {
    if (!clockwise[cell.surface]) continue;
    turned[cell.surface] = 1;
    std::reverse(cell.nodes.begin() + 1, cell.nodes.begin() + corners(cell));
  }
  std::vector<int> tags;
  for (std::size_t k = 0; k < turned.size(); ++k)
    if (turned[k]) tags.push_back(file.surface_tags[k]);
  return tags;
}

PlainMesh plain_mesh(const GmshMesh& file, const std::vector<int>& original_or_none,
                     const std::vector<Region>& regions, const std::vector<Boundary>& boundaries) {
  std::vector<int> original = original_or_none;
  if (original.empty()) {
    original.resize(file.nodes.size());
    std::iota(original.begin(), original.end(), 0);
  }
  const std::vector<PetscInt> vertex = number_vertices(file, original);
  PlainMesh mesh;
  for (std::size_t node = 0; node < vertex.size(); ++node)
    if (vertex[node] >= 0 && original[node] == static_cast<int>(node))
      mesh.position.push_back(file.nodes[node]);
  mesh.cells.reserve(file.cells.size());
  const auto groups = groups_of(file.surface_groups, regions);
  mesh.region_cells.resize(regions.size());
  for (const GmshMesh::Cell& cell : file.cells) {
    for (const std::size_t g : groups[cell.surface])
      mesh.region_cells[g].push_back(static_cast<PetscInt>(mesh.cells.size()));
    CellVertices& corners = mesh.cells.emplace_back(CellVertices{-1, -1, -1, -1});
    for (std::size_t c = 0; c < 4 && cell.nodes[c] >= 0; ++c) corners[c] = vertex[cell.nodes[c]];
  }
  if (!original_or_none.empty()) keep_corners(file, original, vertex, mesh);
  find_boundaries(file, vertex, boundaries, mesh);
  return mesh;
}

}  // namespace slipscale::mesh_stages
