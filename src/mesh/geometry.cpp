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
  for (std::size_t k = 1; k + 1 < size; ++k) twice += cross(corners[0], corners[k], corners[k + 1]);
  return 0.5 * twice;
}

double CellGeometry::smallest_corner() const {
  double smallest = cross(corners[0], corners[1], corners[size - 1]);
  for (std::size_t k = 1; k < size; ++k)
    smallest = std::min(smallest, cross(corners[k], corners[(k + 1) % size], corners[k - 1]));
  return smallest;
}

PlexGeometry::PlexGeometry(DM dm) : dm_(dm) {
  find_vertices();
  petsc(DMGetCoordinatesLocal(dm, &by_vertex_));
  petsc(DMGetCoordinateSection(dm, &at_vertices_));
  petsc(VecGetArrayRead(by_vertex_, &vertex_values_));
  petsc(DMGetCellCoordinatesLocalNoncollective(dm, &by_cell_));
  if (!by_cell_) return;
  petsc(DMGetCellCoordinateSection(dm, &in_cells_));
  petsc(PetscSectionGetChart(in_cells_, &first_cell_, &last_cell_));
  petsc(VecGetArrayRead(by_cell_, &cell_values_));
}

PlexGeometry::~PlexGeometry() {
  (void)VecRestoreArrayRead(by_vertex_, &vertex_values_);
  if (by_cell_) (void)VecRestoreArrayRead(by_cell_, &cell_values_);
}

void PlexGeometry::find_vertices() {
  PetscSection cones = nullptr;
  PetscInt *points = nullptr, *orientations = nullptr;
  petsc(DMPlexGetConeSection(dm_, &cones));
  petsc(DMPlexGetCones(dm_, &points));
  petsc(DMPlexGetConeOrientations(dm_, &orientations));
  petsc(DMPlexGetHeightStratum(dm_, 0, &begin_, &end_));
  vertices_.assign(static_cast<std::size_t>(end_ - begin_), {-1, -1, -1, -1});
  for (PetscInt cell = begin_; cell < end_; ++cell) {
    PetscInt sides = 0, first = 0;
    petsc(PetscSectionGetDof(cones, cell, &sides));
    petsc(PetscSectionGetOffset(cones, cell, &first));
    for (PetscInt k = 0; k < std::min<PetscInt>(sides, 4); ++k) {
      PetscInt ends = 0;
      petsc(PetscSectionGetOffset(cones, points[first + k], &ends));
      vertices_[cell - begin_][k] = points[ends + (orientations[first + k] < 0 ? 1 : 0)];
    }
  }
}

std::span<const PetscInt> PlexGeometry::vertices(PetscInt cell) const {
  const auto& all = vertices_[cell - begin_];
  return {all.data(), all[3] < 0 ? 3u : 4u};
}

CellGeometry PlexGeometry::cell(PetscInt cell) const {
  const auto points = vertices(cell);
  CellGeometry geometry{points.size(), points.size(), vertices_[cell - begin_], {}};
  // Cell coordinates, not vertex coordinates: on a torus a vertex has one position, a cell at the seam needs
  // two. They lie together, in the order of the vertices.
  PetscInt count = 0, first = 0;
  if (cell >= first_cell_ && cell < last_cell_) petsc(PetscSectionGetDof(in_cells_, cell, &count));
  if (count == 0) {
    for (std::size_t k = 0; k < geometry.size; ++k) geometry.corners[k] = position(geometry.vertices[k]);
    return geometry;
  }
  petsc(PetscSectionGetOffset(in_cells_, cell, &first));
  geometry.corner_count = static_cast<std::size_t>(count / 2);
  for (std::size_t k = 0; k < std::min<std::size_t>(geometry.corner_count, 4); ++k)
    geometry.corners[k] = {cell_values_[first + 2 * k], cell_values_[first + 2 * k + 1]};
  return geometry;
}

CellSide PlexGeometry::side(PetscInt beside, PetscInt edge) const {
  const PetscInt* ends = nullptr;
  petsc(DMPlexGetCone(dm_, edge, &ends));
  const CellGeometry geometry = cell(beside);
  const std::size_t n = geometry.size;
  for (std::size_t k = 0; k < n; ++k) {
    const PetscInt a = geometry.vertices[k], b = geometry.vertices[(k + 1) % n];
    if (!((a == ends[0] && b == ends[1]) || (a == ends[1] && b == ends[0]))) continue;
    const Vector2 &p = geometry.corners[k], &q = geometry.corners[(k + 1) % n];
    return {{a, b}, {p, q}, {q[1] - p[1], p[0] - q[0]}};
  }
  throw LibraryError("an edge is not among the edges of the cell beside it");
}

Vector2 PlexGeometry::position(PetscInt vertex) const {
  PetscInt offset = 0;
  petsc(PetscSectionGetOffset(at_vertices_, vertex, &offset));
  return {vertex_values_[offset], vertex_values_[offset + 1]};
}

std::vector<PetscInt> labelled(DM dm, const std::string& name, int value, PetscInt begin, PetscInt end) {
  std::vector<PetscInt> points;
  DMLabel label = nullptr;
  petsc(DMGetLabel(dm, name.c_str(), &label));
  if (!label) return points;
  OwnedIS stratum;
  petsc(DMLabelGetStratumIS(label, value, stratum.put()));
  if (!stratum.get()) return points;
  PetscInt count = 0;
  const PetscInt* indices = nullptr;
  petsc(ISGetLocalSize(stratum, &count));
  petsc(ISGetIndices(stratum, &indices));
  std::copy_if(indices, indices + count, std::back_inserter(points),
               [&](PetscInt point) { return point >= begin && point < end; });
  petsc(ISRestoreIndices(stratum, &indices));
  std::ranges::sort(points);
  return points;
}

}  // namespace slipscale::mesh_stages
