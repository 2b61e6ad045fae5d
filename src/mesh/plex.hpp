#pragma once

#include <vector>

#include "plain_mesh.hpp"
#include "slipscale/base/petsc.hpp"

/// Between the plain mesh and PETSc's DMPlex.
namespace slipscale::mesh_stages {

/// Looks at the rank's part of a DMPlex of cells and vertices, cell by cell. The vertices of all cells are
/// found once; coordinates must not be set while it is in use. Its cell coordinates must have been set up,
/// which is collective; all here is not.
class PlexGeometry {
 public:
  explicit PlexGeometry(DM dm);
  ~PlexGeometry();
  PlexGeometry(const PlexGeometry&) = delete;
  PlexGeometry& operator=(const PlexGeometry&) = delete;

  /// Corners at the vertices unless the cell has coordinates of its own.
  CellGeometry cell(PetscInt cell) const;
  /// Coordinates that the cell has of its own, in pairs; 0 when it sees its vertices where these are.
  int own_corners(PetscInt cell) const;
  std::size_t corner_count(PetscInt cell) const { return corners_of(vertices_[cell - begin_]).size(); }
  Vector2 position(PetscInt vertex) const;  ///< m

 private:
  void find_vertices();

  DM dm_;
  PetscInt begin_ = 0, end_ = 0;        ///< cells
  std::vector<CellVertices> vertices_;  ///< plex points, by cell
  PetscSection at_vertices_ = nullptr, in_cells_ = nullptr;
  Vec by_vertex_ = nullptr, by_cell_ = nullptr;
  const PetscScalar *vertex_values_ = nullptr, *cell_values_ = nullptr;
  PetscInt first_cell_ = 0, last_cell_ = 0;  ///< with coordinates of their own
};

/// A DMPlex whose points are the cells of the mesh, then its vertices. Collective.
OwnedDM plex_of(MPI_Comm comm, const PlainMesh& mesh);

}  // namespace slipscale::mesh_stages
