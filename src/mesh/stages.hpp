#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "slipscale/base/petsc.hpp"
#include "slipscale/mesh/mesh.hpp"
#include "slipscale/mesh/read.hpp"
#include "soundness.hpp"

/// The stages between a gmsh file and a `Mesh`.
namespace slipscale::mesh_stages {

/// The whole mesh and what must be known of it before it is cut.
struct Whole {
  PlainMesh plain;                   ///< on rank 0
  Rows around;                       ///< on rank 0: the cells around each vertex
  std::vector<Region> regions;       ///< complete on every rank
  std::vector<Boundary> boundaries;  ///< likewise, without edges and nodes
  std::array<bool, 2> periodic{};
  Vector2 lower{}, upper{};
  double shortest_edge = 0;
  EdgeRounding edge_rounding;
  std::vector<PetscInt> node_number, cell_number;  ///< rank 0: whole-mesh number of each vertex and cell
  PetscInt node_count = 0, cell_count = 0;
  std::uint64_t checksum = 0;
  std::vector<std::string> notes;  ///< what was made of the file, for the user to see
};

/// Reads, refines, checks and measures the mesh. Collective; throws UserError.
Whole load_whole(MPI_Comm comm, const MeshSource& source);

/// Fewer than three cells across a period make two edges with the same ends, which are one to whoever knows
/// an edge by its ends. Throws GmshFault. Rank 0, before the mesh is refined.
void check_torus(const PlainMesh& mesh);

/// Checks cells and groups and measures them. Throws GmshFault. Rank 0.
void survey(Whole& whole);

/// The lines of the grid that the mesh has, along x or along y, whichever are fewer: nodes that one comes to
/// by the edge that runs most nearly along the axis. Every vertex is in one line, alone where it lies in
/// none. Nothing where less than half of the vertices lie on lines: the mesh is no grid. A grid that closes
/// across the lines has none, since its first line would be beside its last. Rank 0.
Rows grid_lines(const PlainMesh& mesh, PetscInt vertices, const std::array<bool, 2>& periodic);

/// Numbers the nodes (by the lines of the grid, and these by reverse Cuthill-McKee; where there is no grid,
/// by that alone) and the cells (by their lowest nodes). Rank 0.
void number_whole(Whole& whole);

/// How to round the edges of cells, so that edges that were meant to be equal are. Rank 0.
EdgeRounding edge_rounding(const PlainMesh& mesh, const Vector2& lower, const Vector2& upper,
                           double shortest_edge);

/// The part of each cell when the mesh is cut into so many; on rank 0, elsewhere nothing. Only PT-Scotch is
/// collective, and cuts into as many parts as there are ranks.
std::vector<PetscInt> cell_parts(MPI_Comm comm, Partitioner partitioner, int ranks, const Whole& whole);

/// Gives the DMPlex of the whole mesh the partition that it shall be cut by. Collective.
void set_partition(MPI_Comm comm, DM dm, Partitioner partitioner, const Whole& whole);

/// Cuts the mesh with one layer of overlap and fills the plain arrays of `mesh`. Collective.
void distribute(MPI_Comm comm, Whole&& whole, Partitioner partitioner, Mesh& mesh);

/// Fills the plain arrays of `mesh` from the DMPlex of the rank's part. The whole-mesh number of each point
/// and the region of each cell are by plex point. Collective.
void extract(MPI_Comm comm, DM dm, const std::vector<PetscInt>& number, const std::vector<PetscInt>& region,
             Mesh& mesh);

/// An edge of a boundary, as every rank can find it: whole-mesh numbers of the cell beside it and of its
/// ends, counter-clockwise as the cell sees them.
struct NumberedSide {
  PetscInt cell, from, to;
};

/// Gives the boundaries their edges and nodes, where nodes and cells are there already.
void fill_boundary(const std::vector<NumberedSide>& sides, const Nodes& nodes, const Cells& cells,
                   Boundary& boundary);

}  // namespace slipscale::mesh_stages
