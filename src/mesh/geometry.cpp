#include <algorithm>

#include "stages.hpp"

namespace slipscale::mesh_stages {
namespace {

double cross(const Vector2& o, const Vector2& a, const Vector2& b) {
  return (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
}

}  // namespace

double CellGeometry::area() const {
  double twice = 0;
  for (std::size_t k = 1; k + 1 < corners.size(); ++k) twice += cross(corners[0], corners[k], corners[k + 1]);
  return 0.5 * twice;
}

double CellGeometry::smallest_corner() const {
  const std::size_t n = corners.size();
  double smallest = cross(corners[0], corners[1], corners[n - 1]);
  for (std::size_t k = 1; k < n; ++k)
    smallest = std::min(smallest, cross(corners[k], corners[(k + 1) % n], corners[k - 1]));
  return smallest;
}

std::vector<PetscInt> cell_vertices(DM dm, PetscInt cell) {
  PetscInt sides = 0;
  const PetscInt *edges = nullptr, *orientations = nullptr;
  petsc(DMPlexGetConeSize(dm, cell, &sides));
  petsc(DMPlexGetCone(dm, cell, &edges));
  petsc(DMPlexGetConeOrientation(dm, cell, &orientations));
  std::vector<PetscInt> vertices(static_cast<std::size_t>(sides));
  for (PetscInt k = 0; k < sides; ++k) {
    const PetscInt* ends = nullptr;
    petsc(DMPlexGetCone(dm, edges[k], &ends));
    vertices[k] = ends[orientations[k] < 0 ? 1 : 0];
  }
  return vertices;
}

CellGeometry cell_geometry(DM dm, PetscInt cell) {
  CellGeometry geometry{cell_vertices(dm, cell), {}};
  Vec by_cell = nullptr;
  petsc(DMGetCellCoordinatesLocalNoncollective(dm, &by_cell));
  if (!by_cell) {
    for (PetscInt vertex : geometry.vertices) geometry.corners.push_back(vertex_position(dm, vertex));
    return geometry;
  }
  // Cell coordinates, not vertex coordinates: on a torus a vertex has one position, a cell at the seam needs
  // two. They lie together, in the order of the vertices; PETSc's closure, which finds them, costs ten times
  // as much.
  PetscSection section = nullptr;
  PetscInt count = 0, offset = 0;
  petsc(DMGetCellCoordinateSection(dm, &section));
  PetscInt begin = 0, end = 0;
  petsc(PetscSectionGetChart(section, &begin, &end));
  if (cell >= begin && cell < end) petsc(PetscSectionGetDof(section, cell, &count));
  if (count == 0) {
    for (PetscInt vertex : geometry.vertices) geometry.corners.push_back(vertex_position(dm, vertex));
    return geometry;
  }
  const PetscScalar* values = nullptr;
  petsc(PetscSectionGetOffset(section, cell, &offset));
  petsc(VecGetArrayRead(by_cell, &values));
  geometry.corners.resize(static_cast<std::size_t>(count / 2));
  for (std::size_t k = 0; k < geometry.corners.size(); ++k)
    geometry.corners[k] = {values[offset + 2 * k], values[offset + 2 * k + 1]};
  petsc(VecRestoreArrayRead(by_cell, &values));
  return geometry;
}

CellSide side_of(DM dm, PetscInt cell, PetscInt edge) {
  const PetscInt* ends = nullptr;
  petsc(DMPlexGetCone(dm, edge, &ends));
  const auto geometry = cell_geometry(dm, cell);
  const std::size_t n = geometry.vertices.size();
  for (std::size_t k = 0; k < n; ++k) {
    const PetscInt a = geometry.vertices[k], b = geometry.vertices[(k + 1) % n];
    if (!((a == ends[0] && b == ends[1]) || (a == ends[1] && b == ends[0]))) continue;
    const Vector2 &p = geometry.corners[k], &q = geometry.corners[(k + 1) % n];
    return {{a, b}, {p, q}, {q[1] - p[1], p[0] - q[0]}};
  }
  throw LibraryError("an edge is not among the edges of the cell beside it");
}

Vector2 vertex_position(DM dm, PetscInt vertex) {
  Vec coordinates = nullptr;
  PetscSection section = nullptr;
  petsc(DMGetCoordinatesLocal(dm, &coordinates));
  petsc(DMGetCoordinateSection(dm, &section));
  PetscInt offset = 0;
  petsc(PetscSectionGetOffset(section, vertex, &offset));
  const PetscScalar* values = nullptr;
  petsc(VecGetArrayRead(coordinates, &values));
  const Vector2 position{values[offset], values[offset + 1]};
  petsc(VecRestoreArrayRead(coordinates, &values));
  return position;
}

}  // namespace slipscale::mesh_stages
