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

/// By vertex, whether it is a corner of a cell that sees one of its corners elsewhere than the vertex is.
std::vector<char> near_seam(DM dm, const PlexGeometry& plex) {
  PetscInt begin = 0, end = 0, first = 0, last = 0;
  petsc(DMPlexGetHeightStratum(dm, 0, &begin, &end));
  petsc(DMPlexGetDepthStratum(dm, 0, &first, &last));
  std::vector<char> near(static_cast<std::size_t>(last - first), 0);
  for (PetscInt k = begin; k < end; ++k) {
    const CellGeometry cell = plex.cell(k);
    bool across = false;
    for (std::size_t c = 0; c < cell.size; ++c)
      across = across || cell.corners[c] != plex.position(cell.vertices[c]);
    if (across)
      for (const PetscInt vertex : cell.points()) near[vertex - first] = 1;
  }
  return near;
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
  const PlexGeometry plex(dm);
  for (PetscInt k = begin; k < end; ++k) {
    const CellGeometry cell = plex.cell(k);
    for (std::size_t c = 0; c < std::min(cell.size, cell.corner_count); ++c) {
      Vector2& known = lowest[cell.vertices[c] - first];
      known = std::min(known, cell.corners[c]);
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
  PetscInt begin = 0, end = 0, first = 0;
  petsc(DMPlexGetHeightStratum(dm, 0, &begin, &end));
  petsc(DMPlexGetDepthStratum(dm, 0, &first, nullptr));
  const PlexGeometry plex(dm);
  const std::vector<char> near = near_seam(dm, plex);
  std::vector<Link> links;
  for (PetscInt k = begin; k < end; ++k) {
    const CellGeometry cell = plex.cell(k);
    if (cell.size < cell.corner_count && cell.corner_count <= 4) return too_narrow(source, cell.corners[0]);
    if (cell.size != cell.corner_count) continue;
    const double size = std::sqrt(std::abs(cell.area()));
    for (std::size_t a = 0; a < cell.size; ++a)
      for (std::size_t b = a + 1; b < cell.size; ++b) {
        if (cell.vertices[a] == cell.vertices[b]) return too_narrow(source, cell.corners[a]);
        if (near[cell.vertices[a] - first] && near[cell.vertices[b] - first])
          links.push_back(link(cell, a, b, size));
      }
  }
  // Two vertices that are linked in two different ways lie across a period from each other as well; one of
  // the two links is of a cell across the seam.
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
