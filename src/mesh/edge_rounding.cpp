#include <algorithm>
#include <array>
#include <cmath>

#include "stages.hpp"

namespace slipscale {

double EdgeRounding::operator()(double component) const {
  const double size = std::abs(component);
  if (quantum == 0) return component;
  if (size < 0.5 * quantum) return 0;
  return std::copysign(std::floor((size - phase) / quantum + 0.5) * quantum + phase, component);
}

std::array<Vector2, 4> Mesh::shape_of(int cell) const {
  const auto corners = cells.corners_of(cell);
  std::array<Vector2, 4> shape{};
  for (std::size_t k = 1; k < corners.size(); ++k)
    for (int axis = 0; axis < 2; ++axis) shape[k][axis] = edge_rounding(corners[k][axis] - corners[0][axis]);
  return shape;
}

namespace mesh_stages {

EdgeRounding edge_rounding(const PlainMesh& mesh, const Vector2& lower, const Vector2& upper,
                           double shortest_edge) {
  double largest = 0;
  for (int axis = 0; axis < 2; ++axis)
    largest = std::max({largest, std::abs(lower[axis]), std::abs(upper[axis])});
  int exponent = 0;
  std::frexp(largest, &exponent);
  // Coordinates have 53 digits or a few less of which all are sure; their differences err by some 2^-52.
  EdgeRounding rounding;
  rounding.quantum = std::ldexp(1.0, exponent - 48);
  if (rounding.quantum > 1e-9 * shortest_edge) return {};  // far from the origin, or very fine
  constexpr int bins = 16;
  std::array<PetscInt, bins> found{};  // edges, by where they lie between two multiples
  for (PetscInt cell = 0; cell < static_cast<PetscInt>(mesh.cells.size()); ++cell) {
    const CellGeometry shape = mesh.cell(cell);
    for (std::size_t k = 1; k < shape.size(); ++k)
      for (int axis = 0; axis < 2; ++axis) {
        const double multiple = std::abs(shape.corners[k][axis] - shape.corners[0][axis]) / rounding.quantum;
        if (multiple >= 0.5) ++found[static_cast<int>((multiple - std::floor(multiple)) * bins)];
      }
  }
  // The limit is to lie in the middle of the gap in which the fewest edges are.
  const auto near = [&](int bin) {
    PetscInt sum = 0;
    for (int k = -3; k <= 3; ++k) sum += (4 - std::abs(k)) * found[(bin + k + bins) % bins];
    return sum;
  };
  int limit = bins / 2;
  for (int bin = 0; bin < bins; ++bin)
    if (near(bin) < near(limit)) limit = bin;
  rounding.phase = rounding.quantum * ((limit + 0.5) / bins - 0.5);
  return rounding;
}

}  // namespace mesh_stages
}  // namespace slipscale
