#include "slipscale/solid/eigenvalue_bound.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "by_shape.hpp"
#include "slipscale/solid/element.hpp"

namespace slipscale {
namespace {

constexpr double unknown = std::numeric_limits<double>::infinity();

/// Of each local cell, 1/s²; infinite where it cannot be computed.
std::vector<double> eigenvalues(const Mesh& mesh, const std::vector<Material>& materials) {
  std::vector<double> values;
  values.reserve(static_cast<std::size_t>(mesh.cells.size()));
  ByShape<double> eigenvalue;
  for (int cell = 0; cell < mesh.cells.size(); ++cell) {
    const Solid material = materials[mesh.cells.region[cell]].at(cell);
    const double value = eigenvalue.of(mesh, cell, material, [&](std::span<const Vector2> shape) {
      return largest_element_eigenvalue(shape, material.stiffness, material.density);
    });
    values.push_back(std::isfinite(value) ? value : unknown);  // a comparison would lose what is no number
  }
  return values;
}

/// Smallest and largest angle, degrees.
std::array<double, 2> angles_of(std::span<const Vector2> x) {
  std::array<double, 2> angles{180, 0};
  for (std::size_t k = 0, n = x.size(); k < n; ++k) {
    const Vector2 &at = x[k], &next = x[(k + 1) % n], &before = x[(k + n - 1) % n];
    const Vector2 a{next[0] - at[0], next[1] - at[1]}, b{before[0] - at[0], before[1] - at[1]};
    const double angle =
        std::atan2(a[0] * b[1] - a[1] * b[0], a[0] * b[0] + a[1] * b[1]) * 180 / std::numbers::pi;
    angles = {std::min(angles[0], angle), std::max(angles[1], angle)};
  }
  return angles;
}

/// Where the ratios of the largest eigenvalue to those of the cells have their median, from their counts in
/// bins of equal ratio: no rank needs to know every cell.
class Ratios {
 public:
  void add(double ratio) { ++counts_[std::min(bins - 1, static_cast<int>(std::log2(ratio) * per_octave))]; }
  /// Collective.
  double median(MPI_Comm comm) {
    MPI_Allreduce(MPI_IN_PLACE, counts_.data(), bins, MPI_LONG, MPI_SUM, comm);
    long total = 0, below = 0;
    for (const long count : counts_) total += count;
    int bin = 0;
    while (bin < bins - 1 && 2 * (below + counts_[bin]) < total) below += counts_[bin++];
    return bin == 0 ? 1 : std::exp2((bin + 0.5) / per_octave);
  }

 private:
  static constexpr int per_octave = 64, bins = 40 * per_octave;
  std::vector<long> counts_ = std::vector<long>(bins, 0);
};

}  // namespace

CriticalCell critical_cell(MPI_Comm comm, const Mesh& mesh, const std::vector<Material>& materials) {
  const Cells& cells = mesh.cells;
  const auto values = eigenvalues(mesh, materials);
  CriticalCell critical;
  for (const double value : values) critical.eigenvalue = std::max(critical.eigenvalue, value);
  MPI_Allreduce(MPI_IN_PLACE, &critical.eigenvalue, 1, MPI_DOUBLE, MPI_MAX, comm);
  if (std::isinf(critical.eigenvalue)) return critical;

  critical.number = PETSC_MAX_INT;
  int found = -1;
  for (int cell = cells.size() - 1; cell >= 0; --cell)
    if (values[cell] == critical.eigenvalue) critical.number = cells.number[found = cell];
  const PetscInt own = critical.number;
  MPI_Allreduce(MPI_IN_PLACE, &critical.number, 1, MPIU_INT, MPI_MIN, comm);
  double facts[5] = {-unknown, -unknown, -unknown, -unknown, -unknown};
  if (found >= 0 && own == critical.number) {
    const auto corners = cells.corners_of(found);
    const auto angles = angles_of(corners);
    Vector2 sum{};
    for (const Vector2& x : corners) sum = {sum[0] + x[0], sum[1] + x[1]};
    const auto n = static_cast<double>(corners.size());
    const double known[] = {sum[0] / n, sum[1] / n, angles[0], angles[1],
                            static_cast<double>(cells.region[found])};
    std::copy_n(known, 5, facts);
  }
  MPI_Allreduce(MPI_IN_PLACE, facts, 5, MPI_DOUBLE, MPI_MAX, comm);
  critical.centre = {facts[0], facts[1]};
  critical.smallest_angle = facts[2], critical.largest_angle = facts[3];
  critical.region = static_cast<int>(facts[4]);

  Ratios all, in_region;
  for (int cell = 0; cell < cells.size(); ++cell) {
    if (!cells.owned[cell]) continue;
    const double ratio = critical.eigenvalue / values[cell];
    all.add(ratio);
    if (cells.region[cell] == critical.region) in_region.add(ratio);
  }
  critical.of_median = 1 / std::sqrt(all.median(comm));
  critical.of_median_in_region = 1 / std::sqrt(in_region.median(comm));
  return critical;
}

}  // namespace slipscale
