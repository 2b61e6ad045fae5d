#include <algorithm>
#include <cmath>
#include <vector>

#include "gmsh_fault.hpp"
#include "slipscale/base/print.hpp"
#include "stages.hpp"

namespace slipscale::mesh_stages {
namespace {

/// Two vertices of one cell and the way between them.
struct Link {
  std::array<PetscInt, 2> vertices;  ///< ascending
  Vector2 way, place;
  double size;  ///< of the cell, m
};

Link link(const CellGeometry& cell, std::size_t a, std::size_t b, double size) {
  if (cell.vertices[a] > cell.vertices[b]) std::swap(a, b);
  const Vector2 &x = cell.corners[a], &y = cell.corners[b];
  return {{cell.vertices[a], cell.vertices[b]}, {y[0] - x[0], y[1] - x[1]}, x, size};
}

/// By vertex, whether it is a corner of a cell that sees one of its corners elsewhere than the vertex is.
std::vector<char> near_seam(const PlainMesh& mesh) {
  std::vector<char> near(mesh.position.size(), 0);
  for (std::size_t k = 0; k < mesh.cells.size(); ++k) {
    if (mesh.own[k] < 0) continue;
    const CellGeometry cell = mesh.cell(static_cast<PetscInt>(k));
    bool across = false;
    for (std::size_t c = 0; c < cell.size(); ++c)
      across = across || cell.corners[c] != mesh.position[cell.vertices[c]];
    if (across)
      for (const PetscInt vertex : cell.points()) near[vertex] = 1;
  }
  return near;
}

[[noreturn]] void too_narrow(const Vector2& place) {
  throw GmshFault(format("has fewer than three cells across a period near ({:g}, {:g}) m; mesh it finer",
                         place[0], place[1]));
}

}  // namespace

void check_torus(const PlainMesh& mesh) {
  if (!mesh.is_torus()) return;
  const std::vector<char> near = near_seam(mesh);
  std::vector<Link> links;
  for (std::size_t k = 0; k < mesh.cells.size(); ++k) {
    const auto corners = corners_of(mesh.cells[k]);
    if (std::ranges::count_if(corners, [&](PetscInt v) { return near[v] == 1; }) < 2) continue;
    const CellGeometry cell = mesh.cell(static_cast<PetscInt>(k));
    const double size = std::sqrt(std::abs(cell.area()));
    for (std::size_t a = 0; a < cell.size(); ++a)
      for (std::size_t b = a + 1; b < cell.size(); ++b) {
        if (cell.vertices[a] == cell.vertices[b]) too_narrow(cell.corners[a]);
        if (near[cell.vertices[a]] && near[cell.vertices[b]]) links.push_back(link(cell, a, b, size));
      }
  }
  // Two vertices that are linked in two different ways lie across a period from each other as well; one of
  // the two links is of a cell across the seam.
  std::ranges::sort(links, {}, &Link::vertices);
  for (std::size_t k = 1; k < links.size(); ++k) {
    const Link &one = links[k - 1], &two = links[k];
    if (one.vertices == two.vertices &&
        std::hypot(one.way[0] - two.way[0], one.way[1] - two.way[1]) > 0.5 * two.size)
      too_narrow(two.place);
  }
}

}  // namespace slipscale::mesh_stages
