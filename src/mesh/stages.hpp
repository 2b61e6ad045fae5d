#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "gmsh_file.hpp"
#include "slipscale/mesh/mesh.hpp"
#include "slipscale/mesh/read.hpp"

/// The stages between a gmsh file and a `Mesh`. "Serial" means: all of it on rank 0, nothing elsewhere.
namespace slipscale::mesh_stages {

/// Corner vertices and their unwrapped coordinates of one cell of a DMPlex, in the order of the closure.
struct CellGeometry {
  std::size_t size = 0;                ///< vertices: three or four
  std::size_t corner_count = 0;        ///< the same, but in cells that no mesh may have
  std::array<PetscInt, 4> vertices{};  ///< plex points
  std::array<Vector2, 4> corners{};    ///< m
  double area() const;                 ///< m², negative when the corners run clockwise
  double smallest_corner() const;      ///< least cross product of two edges that meet at a corner, m²
  std::span<const PetscInt> points() const { return {vertices.data(), size}; }
};

/// An edge as the cell beside it sees it: unwrapped, its ends in counter-clockwise order.
struct CellSide {
  std::array<PetscInt, 2> vertices{};  ///< plex points
  std::array<Vector2, 2> ends{};       ///< m
  Vector2 outward{};                   ///< outward normal times the edge's length, m
};

/// Looks at the rank's part of a DMPlex, cell by cell. The vertices of all cells are found once, for the way
/// from a cell over its edges to its vertices costs more than all that is asked of a cell; coordinates must
/// not be set while it is in use. Its cell coordinates must have been set up, which is collective; all here
/// is not.
class PlexGeometry {
 public:
  explicit PlexGeometry(DM dm);
  ~PlexGeometry();
  PlexGeometry(const PlexGeometry&) = delete;
  PlexGeometry& operator=(const PlexGeometry&) = delete;

  CellGeometry cell(PetscInt cell) const;
  std::span<const PetscInt> vertices(PetscInt cell) const;  ///< plex points
  CellSide side(PetscInt cell, PetscInt edge) const;
  Vector2 position(PetscInt vertex) const;  ///< m

 private:
  void find_vertices();

  DM dm_;
  PetscInt begin_ = 0, end_ = 0;                   ///< cells
  std::vector<std::array<PetscInt, 4>> vertices_;  ///< by cell; a triangle's last is -1
  PetscSection at_vertices_ = nullptr, in_cells_ = nullptr;
  Vec by_vertex_ = nullptr, by_cell_ = nullptr;
  const PetscScalar *vertex_values_ = nullptr, *cell_values_ = nullptr;
  PetscInt first_cell_ = 0, last_cell_ = 0;  ///< with coordinates of their own
};

/// The points of a stratum [begin, end) that carry `value` in the label of this name, ascending.
std::vector<PetscInt> labelled(DM dm, const std::string& name, int value, PetscInt begin, PetscInt end);

/// The whole mesh on rank 0: what must be known before it is cut.
struct Whole {
  OwnedDM dm;
  std::vector<Region> regions;       ///< complete on every rank
  std::vector<Boundary> boundaries;  ///< likewise, without edges and nodes
  std::array<bool, 2> periodic{};
  Vector2 lower{}, upper{};
  double shortest_edge = 0;
  std::vector<PetscInt> number;  ///< rank 0: whole-mesh number of each vertex and cell, by plex point
  PetscInt node_count = 0, cell_count = 0;
};

/// Fewer than three cells across a period make two edges with the same ends, which a DMPlex merges. The
/// sentence about it, or nothing. Rank 0, before the mesh is refined.
std::string fault_in_torus(DM dm, const MeshSource& source);

/// On a torus, gives every vertex the lowest of the positions at which its cells see it, x first: PETSc's
/// choice varies along the seam, and refinement leaves the midpoints there on the other side of the body.
void settle_seam(DM dm);

/// Reads, refines, checks and measures the mesh. Collective; throws UserError.
Whole load_whole(MPI_Comm comm, const MeshSource& source, const GmshFile& file);

/// The numbers of nodes (reverse Cuthill-McKee) and of cells (by their lowest nodes), by plex point. Rank 0.
std::vector<PetscInt> whole_mesh_order(DM dm, const PlexGeometry& plex);

/// Gives the DMPlex its partitioner, with the partition already in it for `metis` and `simple`. Collective.
void set_partition(DM dm, Partitioner partitioner, const std::vector<PetscInt>& number);

/// Cuts the mesh with one layer of overlap and fills the plain arrays of `mesh`. Collective.
void distribute(MPI_Comm comm, Whole&& whole, Partitioner partitioner, Mesh& mesh);

}  // namespace slipscale::mesh_stages
