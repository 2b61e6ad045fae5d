#pragma once

#include <string>
#include <vector>

#include "plain_mesh.hpp"
#include "slipscale/base/petsc.hpp"
#include "slipscale/mesh/read.hpp"

/// Between the plain mesh and PETSc's DMPlex.
namespace slipscale::mesh_stages {

/// Looks at the rank's part of a DMPlex, with or without edges, cell by cell. The vertices of all cells are
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

/// A DMPlex whose points are the cells of the mesh, then its vertices, then its edges if they are wanted.
/// Collective.
OwnedDM plex_of(MPI_Comm comm, const PlainMesh& mesh, bool with_edges = false);

/// Lets PETSc read the file, for formats other than the text of version 4.1. Collective; throws UserError.
PlainMesh read_by_petsc(MPI_Comm comm, const MeshSource& source, const std::vector<Region>& regions,
                        const std::vector<Boundary>& boundaries);

/// Cuts every cell into four, `times` times. Collective.
PlainMesh refine(MPI_Comm comm, const PlainMesh& mesh, int times, const std::vector<Region>& regions,
                 const std::vector<Boundary>& boundaries);

}  // namespace slipscale::mesh_stages
