#pragma once

#include <petscsys.h>

#include <array>
#include <span>
#include <vector>

#include "gmsh_mesh.hpp"
#include "slipscale/mesh/mesh.hpp"

/// The whole mesh before it is cut: on rank 0 all of it, elsewhere nothing.
namespace slipscale::mesh_stages {

/// The vertices at the corners of a cell, counter-clockwise; a triangle's last is -1.
using CellVertices = std::array<PetscInt, 4>;

inline std::span<const PetscInt> corners_of(const CellVertices& cell) {
  return {cell.data(), cell[3] < 0 ? 3u : 4u};
}

/// Corner vertices of one cell and their coordinates, unwrapped across a periodic seam.
struct CellGeometry {
  CellVertices vertices{-1, -1, -1, -1};
  std::array<Vector2, 4> corners{};  ///< m

  std::size_t size() const { return vertices[3] < 0 ? 3 : 4; }
  std::span<const PetscInt> points() const { return corners_of(vertices); }
  double area() const;             ///< m², negative when the corners run clockwise
  double smallest_corner() const;  ///< least cross product of two edges that meet at a corner, m²
  Vector2 outward(
      int side) const;  ///< outward normal of the side from this corner to the next times its length, m
};

/// An edge as one of the cells beside it sees it: from its corner `corner` to the next.
struct CellSide {
  PetscInt cell = 0;
  int corner = 0;
};

/// The edges of a named boundary, each as the first of the cells beside it sees it.
struct BoundarySides {
  std::vector<CellSide> sides;
  bool interior = false;  ///< some have cells on both sides
};

/// Cells and vertices, no edges: there are as many of these as of both, and only those of the named
/// boundaries are asked for.
struct PlainMesh {
  std::vector<CellVertices> cells;
  std::vector<Vector2> position;  ///< of each vertex, m; on a torus the lowest where a cell sees it, x first
  /// On a torus, where the corners of each cell near a seam are in `own_corners`; -1 for cells that see their
  /// vertices where these are.
  std::vector<PetscInt> own;
  std::vector<std::array<Vector2, 4>> own_corners;  ///< m
  std::vector<std::vector<PetscInt>> region_cells;  ///< ascending, for each region
  std::vector<BoundarySides> boundaries;

  bool is_torus() const { return !own.empty(); }
  CellGeometry cell(PetscInt cell) const;
};

/// Turns the surfaces whose cells all run clockwise. Returns the tags of these surfaces.
std::vector<int> turn_clockwise_surfaces(GmshMesh& file);

/// Vertices are the nodes that cells use, those that repeat another left out, in the order of the file.
/// `original` says of each node which one it repeats, itself where it repeats none; empty without a period.
/// Throws GmshFault for a boundary that does not run along the cells.
PlainMesh plain_mesh(const GmshMesh& file, const std::vector<int>& original,
                     const std::vector<Region>& regions, const std::vector<Boundary>& boundaries);

/// Cuts every cell into four: at the middle of its sides, and a quadrilateral at the mean of its corners. The
/// first vertices are those of `mesh`.
PlainMesh refined(const PlainMesh& mesh);

/// Gives every vertex of a torus the lowest of the positions at which its cells see it, x first.
void settle_seam(PlainMesh& mesh);

}  // namespace slipscale::mesh_stages
