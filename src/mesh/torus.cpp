#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "slipscale/base/print.hpp"
#include "stages.hpp"

namespace slipscale::mesh_stages {
namespace {

std::string too_narrow(const MeshSource& source, const Vector2& place) {
  return "mesh '" + source.file + "' has fewer than three cells across a period near " +
         format("(%g, %g) m", place[0], place[1]) + "; mesh it finer";
}

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

}  // namespace

void settle_seam(DM dm) {
  PetscBool is_torus = PETSC_FALSE;
  petsc(DMGetCoordinatesLocalized(dm, &is_torus));
  if (!is_torus) return;
  PetscInt begin = 0, end = 0;
  petsc(DMPlexGetHeightStratum(dm, 0, &begin, &end));
  PetscInt first = 0, last = 0;
  petsc(DMPlexGetDepthStratum(dm, 0, &first, &last));
  constexpr double nowhere = std::numeric_limits<double>::infinity();
  std::vector<Vector2> lowest(static_cast<std::size_t>(last - first), {nowhere, nowhere});
  for (PetscInt cell = begin; cell < end; ++cell) {
    const auto geometry = cell_geometry(dm, cell);
    for (std::size_t k = 0; k < geometry.vertices.size() && k < geometry.corners.size(); ++k) {
      Vector2& known = lowest[geometry.vertices[k] - first];
      known = std::min(known, geometry.corners[k]);
    }
  }
  Vec old = nullptr;
  OwnedVec moved;
  PetscSection section = nullptr;
  petsc(DMGetCoordinatesLocal(dm, &old));
  petsc(DMGetCoordinateSection(dm, &section));
  petsc(VecDuplicate(old, moved.put()));
  petsc(VecCopy(old, moved));
  PetscScalar* values = nullptr;
  petsc(VecGetArray(moved, &values));
  for (PetscInt vertex = first; vertex < last; ++vertex) {
    const Vector2& position = lowest[vertex - first];
    if (position[0] == nowhere) continue;  // it belongs to no cell
    PetscInt offset = 0;
    petsc(PetscSectionGetOffset(section, vertex, &offset));
    std::copy(position.begin(), position.end(), values + offset);
  }
  petsc(VecRestoreArray(moved, &values));
  petsc(DMSetCoordinatesLocal(dm, moved));
}

std::string fault_in_torus(DM dm, const MeshSource& source) {
  PetscBool is_torus = PETSC_FALSE;
  petsc(DMGetCoordinatesLocalizedLocal(dm, &is_torus));
  if (!is_torus) return "";
  PetscInt begin = 0, end = 0;
  petsc(DMPlexGetHeightStratum(dm, 0, &begin, &end));
  std::vector<Link> links;
  for (PetscInt cell = begin; cell < end; ++cell) {
    const auto geometry = cell_geometry(dm, cell);
    const std::size_t corners = geometry.corners.size(), vertices = geometry.vertices.size();
    if (vertices < corners && corners <= 4) return too_narrow(source, geometry.corners[0]);
    if (vertices != corners) continue;
    const double size = std::sqrt(std::abs(geometry.area()));
    for (std::size_t a = 0; a < vertices; ++a)
      for (std::size_t b = a + 1; b < vertices; ++b) {
        if (geometry.vertices[a] == geometry.vertices[b]) return too_narrow(source, geometry.corners[a]);
        links.push_back(link(geometry, a, b, size));
      }
  }
  // Two vertices that are linked in two different ways lie across a period from each other as well.
  std::ranges::sort(links, {}, &Link::vertices);
  for (std::size_t k = 1; k < links.size(); ++k) {
    const Link &one = links[k - 1], &two = links[k];
    if (one.vertices == two.vertices &&
        std::hypot(one.way[0] - two.way[0], one.way[1] - two.way[1]) > 0.5 * two.size)
      return too_narrow(source, two.place);
  }
  return "";
}

}  // namespace slipscale::mesh_stages
