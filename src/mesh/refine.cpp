#include <algorithm>
#include <tuple>

#include "plain_mesh.hpp"

namespace slipscale::mesh_stages {
namespace {

/// The edges of a mesh, numbered as they come when one goes from cell to cell and around each.
struct Edges {
  std::vector<CellVertices> of_cell;              ///< the edge from each corner to the next
  std::vector<std::array<PetscInt, 2>> vertices;  ///< the ends of each
};

Edges edges_of(const std::vector<CellVertices>& cells) {
  struct Seen {
    PetscInt low, high;
    CellSide side;
  };
  std::vector<Seen> seen;
  seen.reserve(4 * cells.size());
  for (std::size_t k = 0; k < cells.size(); ++k) {
    const auto corners = corners_of(cells[k]);
    for (std::size_t c = 0; c < corners.size(); ++c) {
      const auto [low, high] = std::minmax(corners[c], corners[(c + 1) % corners.size()]);
      seen.push_back({low, high, {static_cast<PetscInt>(k), static_cast<int>(c)}});
    }
  }
  const auto place = [](const CellSide& side) { return std::pair(side.cell, side.corner); };
  std::ranges::sort(seen, [&](const Seen& a, const Seen& b) {
    return std::tuple(a.low, a.high, place(a.side)) < std::tuple(b.low, b.high, place(b.side));
  });
  // Every side learns which side was the first of its edge; the first ones are then numbered as they come.
  std::vector<std::array<CellSide, 4>> first(cells.size());
  for (std::size_t k = 0, head = 0; k < seen.size(); ++k) {
    if (seen[k].low != seen[head].low || seen[k].high != seen[head].high) head = k;
    first[seen[k].side.cell][seen[k].side.corner] = seen[head].side;
  }
  Edges edges;
  edges.of_cell.assign(cells.size(), {-1, -1, -1, -1});
  for (std::size_t k = 0; k < cells.size(); ++k) {
    const auto corners = corners_of(cells[k]);
    for (std::size_t c = 0; c < corners.size(); ++c) {
      const CellSide& one = first[k][c];
      if (one.cell == static_cast<PetscInt>(k) && one.corner == static_cast<int>(c)) {
        edges.of_cell[k][c] = static_cast<PetscInt>(edges.vertices.size());
        edges.vertices.push_back({corners[c], corners[(c + 1) % corners.size()]});
      } else {
        edges.of_cell[k][c] = edges.of_cell[one.cell][one.corner];
      }
    }
  }
  return edges;
}

Vector2 middle(const Vector2& a, const Vector2& b) {
  return {0.5 * a[0] + 0.5 * b[0], 0.5 * a[1] + 0.5 * b[1]};
}

Vector2 mean(const std::array<Vector2, 4>& x) {
  Vector2 sum{};
  for (const Vector2& each : x)
    for (int d = 0; d < 2; ++d) sum[d] += 0.25 * each[d];
  return sum;
}

/// The four parts of a cell: that at each corner begins there, and the one amid a triangle's sides is the
/// last.
struct Parts {
  std::array<CellVertices, 4> vertices;
  std::array<std::array<Vector2, 4>, 4> corners;
};

/// `sides` and `centre` are the new vertices.
Parts parts_of(const CellGeometry& cell, const CellVertices& sides, PetscInt centre) {
  const int n = static_cast<int>(cell.size());
  std::array<Vector2, 4> half;
  for (int c = 0; c < n; ++c) half[c] = middle(cell.corners[c], cell.corners[(c + 1) % n]);
  Parts parts;
  for (int c = 0; c < n; ++c) {
    const int before = (c + n - 1) % n;
    if (n == 3) {
      parts.vertices[c] = {cell.vertices[c], sides[c], sides[before], -1};
      parts.corners[c] = {cell.corners[c], half[c], half[before], Vector2{}};
    } else {
      parts.vertices[c] = {cell.vertices[c], sides[c], centre, sides[before]};
      parts.corners[c] = {cell.corners[c], half[c], mean(cell.corners), half[before]};
    }
  }
  if (n == 3) {
    parts.vertices[3] = {sides[0], sides[1], sides[2], -1};
    parts.corners[3] = {half[0], half[1], half[2], Vector2{}};
  }
  return parts;
}

}  // namespace

PlainMesh refined(const PlainMesh& mesh) {
  const Edges edges = edges_of(mesh.cells);
  const auto old = static_cast<PetscInt>(mesh.position.size());
  PlainMesh fine;
  fine.position = mesh.position;
  fine.position.resize(mesh.position.size() + edges.vertices.size());
  fine.cells.reserve(4 * mesh.cells.size());
  if (mesh.is_torus()) fine.own.reserve(4 * mesh.cells.size());
  for (std::size_t k = 0; k < mesh.cells.size(); ++k) {
    const CellGeometry cell = mesh.cell(static_cast<PetscInt>(k));
    const int n = static_cast<int>(cell.size());
    CellVertices sides{-1, -1, -1, -1};
    for (int c = 0; c < n; ++c) {
      sides[c] = old + edges.of_cell[k][c];
      fine.position[sides[c]] = middle(cell.corners[c], cell.corners[(c + 1) % n]);
    }
    const auto centre = static_cast<PetscInt>(fine.position.size());
    if (n == 4) fine.position.push_back(mean(cell.corners));
    const Parts parts = parts_of(cell, sides, centre);
    for (int part = 0; part < 4; ++part) {
      fine.cells.push_back(parts.vertices[part]);
      if (!mesh.is_torus()) continue;
      fine.own.push_back(mesh.own[k] < 0 ? -1 : static_cast<PetscInt>(fine.own_corners.size()));
      if (mesh.own[k] >= 0) fine.own_corners.push_back(parts.corners[part]);
    }
  }
  if (mesh.is_torus()) settle_seam(fine);
  for (const auto& cells : mesh.region_cells) {
    auto& finer = fine.region_cells.emplace_back();
    for (const PetscInt cell : cells)
      for (PetscInt part = 0; part < 4; ++part) finer.push_back(4 * cell + part);
  }
  for (const BoundarySides& boundary : mesh.boundaries) {
    BoundarySides& finer = fine.boundaries.emplace_back();
    finer.interior = boundary.interior;
    for (const auto& [cell, corner] : boundary.sides) {
      const int n = static_cast<int>(corners_of(mesh.cells[cell]).size()), next = (corner + 1) % n;
      finer.sides.push_back({4 * cell + corner, 0});
      finer.sides.push_back({4 * cell + next, n == 3 ? 2 : 3});
    }
    std::ranges::sort(finer.sides, {},
                      [](const CellSide& side) { return std::pair(side.cell, side.corner); });
  }
  return fine;
}

}  // namespace slipscale::mesh_stages
