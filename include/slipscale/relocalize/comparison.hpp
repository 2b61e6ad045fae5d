#pragma once

#include <array>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "slipscale/relocalize/block_parts.hpp"

namespace slipscale {

/// The three answers that are compared.
struct StressSource {
  enum Index : std::size_t {
    reference,    ///< the heterogeneous run
    relocalised,  ///< C(x) : A(x) : E of the homogeneous run
    homogeneous   ///< C_eff : E of the homogeneous run
  };
  static constexpr std::size_t count = 3;
};

/// Stress (or a statistic of it) of each cell by source, [cells] of (xx, yy, xy), Pa.
using StressFields = std::array<std::span<const std::array<double, 3>>, StressSource::count>;

/// Sums over the cells of one part of the block: areas times stresses and times squares. Nothing but numbers
/// that add, over ranks (`numbers`) as over frames (+=); an error over frames is thus one over space and
/// time.
struct StressSums {
  double area = 0;                                                  ///< Σ a, m²
  std::array<std::array<double, 3>, StressSource::count> linear{};  ///< Σ a σ
  std::array<std::array<double, 3>, StressSource::count> quadratic{};  ///< Σ a σ_ref², and Σ a (σ − σ_ref)²

  StressSums& operator+=(const StressSums& other);

  /// Area average of a component (0, 1, 2: xx, yy, xy), Pa. NaN for a part without cells.
  double mean(StressSource::Index source, std::size_t component) const;
  /// √(Σ a (σ − σ_ref)²) / √(Σ a σ_ref²). NaN where the reference is no more than rounding beside its other
  /// components, or absent.
  double relative_error(StressSource::Index source, std::size_t component) const;
};

/// The sums for each of `parts`. Fields have a value for each of `cells`.
std::vector<StressSums> stress_sums(const std::vector<BlockPart>& parts, const ComparedCells& cells,
                                    const StressFields& fields);

/// The same sums as plain numbers, for MPI_Allreduce with MPI_SUM.
std::span<double> numbers(std::vector<StressSums>& sums);

/// Adds each number over all ranks, in place.
using SumOverRanks = std::function<void(std::span<double>)>;

/// Quantiles by [source][component][level], Pa.
using StressQuantiles = std::array<std::array<std::vector<double>, 3>, StressSource::count>;

/// Area-weighted quantiles of the cells' values for each of `parts`: the lowest value such that at least the
/// share `level` (0 to 1) of the area has no higher one, NaN for a part without cells. Exact, a value of some
/// cell: by bisection over all doubles on the areas summed over the ranks, so the values themselves stay
/// where they are. Collective if `sum` is.
std::vector<StressQuantiles> stress_quantiles(
    const std::vector<BlockPart>& parts, const ComparedCells& cells, const StressFields& fields,
    const std::vector<double>& levels, const SumOverRanks& sum = [](std::span<double>) {});

/// How well one history follows another, sampled at the same times.
struct HistoryAgreement {
  double correlation = 0;     ///< Pearson's; NaN where one of them is constant
  double slope = 0;           ///< of the regression line over the reference; NaN where that is constant
  double relative_error = 0;  ///< relative L2 error; NaN where the reference is zero
};
HistoryAgreement agreement(std::span<const double> reference, std::span<const double> history);

/// Pairs (frame of the reference, frame of the other run) whose times differ by no more than `tolerance`, s:
/// each the other's nearest. Times ascend.
std::vector<std::array<std::size_t, 2>> common_frames(std::span<const double> reference_time,
                                                      std::span<const double> time, double tolerance);

}  // namespace slipscale
