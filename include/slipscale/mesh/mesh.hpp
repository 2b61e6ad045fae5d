#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "slipscale/base/petsc.hpp"
#include "slipscale/base/vector2.hpp"

namespace slipscale {

/// A gmsh physical surface, as a whole (the same on every rank).
struct Region {
  std::string name;
  int tag = 0;
  PetscInt cells = 0;
  double area = 0;  ///< m²
};

/// An edge of a named boundary with at least one end owned by this rank.
struct BoundaryEdge {
  std::array<int, 2> nodes{};     ///< local nodes, in the order of their whole-mesh numbers
  std::array<Vector2, 2> ends{};  ///< their coordinates, unwrapped across a periodic seam, m
  Vector2 outward{};              ///< outward normal times the edge's length, m
};

/// A gmsh physical curve. The first members describe it as a whole, `edges` and `nodes` this rank's part.
struct Boundary {
  std::string name;
  int tag = 0;
  PetscInt edge_count = 0;
  double length = 0;      ///< m
  bool interior = false;  ///< has cells on both sides: a periodic seam, or an interface
  Vector2 normal{};       ///< unit mean outward normal; zero when it is interior or closes on itself
  std::vector<BoundaryEdge> edges = {};  ///< in the order of their nodes' numbers
  std::vector<int> nodes = {};           ///< owned nodes on it, end points included, ascending
};

/// The nodes this rank holds: first the owned ones, then the ghosts, both in ascending whole-mesh number.
struct Nodes {
  int owned = 0;
  std::vector<PetscInt> number;   ///< whole-mesh number of each local node; independent of the ranks
  std::vector<Vector2> position;  ///< m; on a periodic mesh the representative's
  std::vector<PetscInt> ghosts;   ///< index of each ghost in PETSc's numbering of the owned nodes
  PetscInt total = 0;             ///< nodes of the whole mesh

  int size() const { return static_cast<int>(number.size()); }
};

/// The cells this rank holds, one layer of overlap included, in ascending whole-mesh number. Corners run
/// counter-clockwise from the corner with the lowest node number.
struct Cells {
  std::vector<PetscInt> number;   ///< [cells]
  std::vector<char> owned;        ///< [cells] 1 when this rank is the cell's owner
  std::vector<int> region;        ///< [cells] index into Mesh::regions
  std::vector<int> first;         ///< [cells + 1] where a cell's corners start in the next two
  std::vector<int> corner_nodes;  ///< local node of each corner
  std::vector<Vector2> corners;   ///< its coordinates, unwrapped across a periodic seam, m
  PetscInt total = 0;             ///< cells of the whole mesh

  int size() const { return static_cast<int>(number.size()); }
  int corner_count(int cell) const { return first[cell + 1] - first[cell]; }
  std::span<const Vector2> corners_of(int cell) const {  ///< counter-clockwise, m
    return std::span(corners).subspan(first[cell], corner_count(cell));
  }
  std::span<const int> nodes_of(int cell) const {  ///< local node of each corner
    return std::span(corner_nodes).subspan(first[cell], corner_count(cell));
  }
};

/// Edges of a grid that were meant to be equal differ by the rounding of the coordinates, which depends on
/// where they lie. Rounded to multiples of `quantum`, off by `phase`, the last digits that
/// coordinates of this size have, they are equal to the last bit; the phase keeps the mesh's edges off the
/// limits between two multiples.
struct EdgeRounding {
  double quantum = 0;  ///< m, a power of two; 0 leaves edges as they are
  double phase = 0;    ///< m

  double operator()(double component) const;  ///< of an edge, m
};

/// What the partition costs; one entry a rank.
struct PartitionReport {
  std::vector<PetscInt> owned_cells, overlap_cells, owned_nodes, ghost_nodes;
  PetscInt edge_cut = 0;  ///< edges between cells of different owners
};

/// A partitioned plane mesh in plain arrays.
///
/// The order of nodes and cells belongs to the whole mesh and is fixed before it is partitioned, so that sums
/// taken in that order give the same bits on any number of ranks. Every cell around an owned node is local.
struct Mesh {
  MPI_Comm comm = MPI_COMM_NULL;  ///< of the ranks that share it
  Nodes nodes;
  Cells cells;
  std::vector<Region> regions;
  std::vector<Boundary> boundaries;
  std::array<bool, 2> periodic{};  ///< along x, along y
  Vector2 lower{}, upper{};        ///< bounding box of the cells, m
  double shortest_edge = 0;        ///< m
  EdgeRounding edge_rounding;
  std::string file;
  std::uint64_t checksum = 0;      ///< FNV-1a of the file's bytes
  std::vector<std::string> notes;  ///< what was made of the file, one sentence each, for the user to see
  PartitionReport partition;

  const Boundary* find_boundary(const std::string& name) const;
  std::vector<std::string> region_names() const;
  std::vector<std::string> boundary_names() const;
  double area() const;  ///< m²

  /// The corners of a cell as seen from its first, m, rounded so that cells that were meant to be alike are,
  /// to the last bit. Unused entries are zero.
  std::array<Vector2, 4> shape_of(int cell) const;
};

}  // namespace slipscale
