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
namespace {

/// The limit is to lie in the middle of the gap in which the fewest edges are.
double phase_between(const PlainMesh& mesh, double quantum) {
  constexpr int bins = 16;
  std::array<PetscInt, bins> found{};  // edges, by where they lie between two multiples
  for (PetscInt cell = 0; cell < static_cast<PetscInt>(mesh.cells.size()); ++cell) {
    const CellGeometry shape = mesh.cell(cell);
    for (std::size_t k = 1; k < shape.size(); ++k)
      for (int axis = 0; axis < 2; ++axis) {
        const double multiple = std::abs(shape.corners[k][axis] - shape.corners[0][axis]) / quantum;
        if (multiple >= 0.5) ++found[static_cast<int>((multiple - std::floor(multiple)) * bins)];
      }
  }
  const auto near = [&](int bin) {
    PetscInt sum = 0;
    for (int k = -3; k <= 3; ++k) sum += (4 - std::abs(k)) * found[(bin + k + bins) % bins];
    return sum;
  };
  int limit = bins / 2;
  for (int bin = 0; bin < bins; ++bin)
    if (near(bin) < near(limit)) limit = bin;
  return quantum * ((limit + 0.5) / bins - 0.5);
}

/// How many kinds of cells are left among some thousand, spread over the mesh, once their edges are rounded.
std::size_t kinds_of_cells(const PlainMesh& mesh, const EdgeRounding& rounding) {
  constexpr std::size_t most = 4096;
  std::vector<std::array<Vector2, 4>> shapes;
  const std::size_t stride = mesh.cells.size() / most | 1;  // odd: not that of the columns of most grids
  for (std::size_t cell = 0; cell < mesh.cells.size(); cell += stride) {
    const CellGeometry geometry = mesh.cell(static_cast<PetscInt>(cell));
    auto& shape = shapes.emplace_back();
    for (std::size_t k = 1; k < geometry.size(); ++k)
      for (int axis = 0; axis < 2; ++axis)
        shape[k][axis] = rounding(geometry.corners[k][axis] - geometry.corners[0][axis]);
  }
  std::ranges::sort(shapes);
  return static_cast<std::size_t>(std::ranges::unique(shapes).begin() - shapes.begin());
}

}  // namespace

EdgeRounding edge_rounding(const PlainMesh& mesh, const Vector2& lower, const Vector2& upper,
                           double shortest_edge) {
  double largest = 0;
  for (int axis = 0; axis < 2; ++axis)
    largest = std::max({largest, std::abs(lower[axis]), std::abs(upper[axis])});
  int exponent = 0;
  std::frexp(largest, &exponent);
  // Coordinates have 53 digits or a few less of which all are sure; their differences err by some 2^-52.
  EdgeRounding best;
  best.quantum = std::ldexp(1.0, exponent - 48);
  if (best.quantum > 1e-9 * shortest_edge) return {};  // far from the origin, or very fine
  best.phase = phase_between(mesh, best.quantum);
  std::size_t kinds = kinds_of_cells(mesh, best);
  // gmsh finds the nodes of its transfinite grids to some 1e-12 of the block only. Where fewer digits make
  // most cells alike, they were meant to be alike; elsewhere no digit is given up.
  for (const int digits : {42, 38, 34}) {
    EdgeRounding coarser{std::ldexp(1.0, exponent - digits), 0};
    if (kinds < 8 || coarser.quantum > 1e-7 * shortest_edge) break;
    coarser.phase = phase_between(mesh, coarser.quantum);
    const std::size_t left = kinds_of_cells(mesh, coarser);
    if (left <= kinds / 2) best = coarser, kinds = left;
  }
  return best;
}

}  // namespace mesh_stages
}  // namespace slipscale
