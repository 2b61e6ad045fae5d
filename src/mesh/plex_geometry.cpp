#include <algorithm>

#include "plex.hpp"

namespace slipscale::mesh_stages {

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
  PetscInt* points = nullptr;
  petsc(DMPlexGetConeSection(dm_, &cones));
  petsc(DMPlexGetCones(dm_, &points));
  petsc(DMPlexGetHeightStratum(dm_, 0, &begin_, &end_));
  vertices_.assign(static_cast<std::size_t>(end_ - begin_), {-1, -1, -1, -1});
  for (PetscInt cell = begin_; cell < end_; ++cell) {
    PetscInt corners = 0, first = 0;
    petsc(PetscSectionGetDof(cones, cell, &corners));
    petsc(PetscSectionGetOffset(cones, cell, &first));
    std::copy_n(points + first, std::min<PetscInt>(corners, 4), vertices_[cell - begin_].begin());
  }
}

int PlexGeometry::own_corners(PetscInt cell) const {
  PetscInt count = 0;
  if (cell >= first_cell_ && cell < last_cell_) petsc(PetscSectionGetDof(in_cells_, cell, &count));
  return static_cast<int>(count / 2);
}

CellGeometry PlexGeometry::cell(PetscInt cell) const {
  CellGeometry geometry{.vertices = vertices_[cell - begin_]};
  // Cell coordinates, not vertex coordinates: on a torus a vertex has one position, a cell at the seam needs
  // two. They lie together, in the order of the vertices.
  const int own = own_corners(cell);
  if (own == 0) {
    for (std::size_t k = 0; k < geometry.size(); ++k) geometry.corners[k] = position(geometry.vertices[k]);
    return geometry;
  }
  PetscInt first = 0;
  petsc(PetscSectionGetOffset(in_cells_, cell, &first));
  for (int k = 0; k < std::min(own, 4); ++k)
    geometry.corners[k] = {cell_values_[first + 2 * k], cell_values_[first + 2 * k + 1]};
  return geometry;
}

Vector2 PlexGeometry::position(PetscInt vertex) const {
  PetscInt offset = 0;
  petsc(PetscSectionGetOffset(at_vertices_, vertex, &offset));
  return {vertex_values_[offset], vertex_values_[offset + 1]};
}

}  // namespace slipscale::mesh_stages
