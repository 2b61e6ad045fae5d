#include "plain_mesh.hpp"

#include <algorithm>
#include <limits>

#include "slipscale/mesh/shape_functions.hpp"

namespace slipscale::mesh_stages {
namespace {

double cross(const Vector2& o, const Vector2& a, const Vector2& b) {
  return (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0]);
}

}  // namespace

double CellGeometry::area() const { return cell_area({corners.data(), size()}); }

double CellGeometry::smallest_corner() const {
  const std::size_t n = size();
  double smallest = cross(corners[0], corners[1], corners[n - 1]);
  for (std::size_t k = 1; k < n; ++k)
    smallest = std::min(smallest, cross(corners[k], corners[(k + 1) % n], corners[k - 1]));
  return smallest;
}

Vector2 CellGeometry::outward(int side) const {
  const Vector2 &p = corners[side], &q = corners[(side + 1) % size()];
  return {q[1] - p[1], p[0] - q[0]};
}

CellGeometry PlainMesh::cell(PetscInt cell) const {
  CellGeometry geometry{.vertices = cells[cell]};
  if (is_torus() && own[cell] >= 0) {
    geometry.corners = own_corners[own[cell]];
    return geometry;
  }
  for (std::size_t k = 0; k < geometry.size(); ++k) geometry.corners[k] = position[geometry.vertices[k]];
  return geometry;
}

void settle_seam(PlainMesh& mesh) {
  constexpr double nowhere = std::numeric_limits<double>::infinity();
  std::vector<Vector2> lowest(mesh.position.size(), {nowhere, nowhere});
  for (std::size_t k = 0; k < mesh.cells.size(); ++k) {
    const CellGeometry cell = mesh.cell(static_cast<PetscInt>(k));
    for (std::size_t c = 0; c < cell.size(); ++c) {
      Vector2& known = lowest[cell.vertices[c]];
      known = std::min(known, cell.corners[c]);
    }
  }
  for (std::size_t v = 0; v < lowest.size(); ++v)
    if (lowest[v][0] != nowhere) mesh.position[v] = lowest[v];  // some may belong to no cell
}

}  // namespace slipscale::mesh_stages
