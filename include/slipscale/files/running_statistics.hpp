#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "slipscale/base/state_group.hpp"

namespace slipscale {

/// Statistics over time of a symmetric tensor (xx, yy, xy) at each of a number of places.
struct FieldStatistics {
  std::vector<double> mean;  ///< [places, 3]
  std::vector<double>
      covariance;               ///< [places, 6] xx.xx, yy.yy, xy.xy, yy.xy, xx.xy, xx.yy; of the population
  std::vector<double> lowest;   ///< [places, 3]
  std::vector<double> highest;  ///< [places, 3]
  std::vector<double> quantile_low;   ///< [places, 3] below it lies the part 1 − quantile of the samples
  std::vector<double> quantile_high;  ///< [places, 3] below it lies the part quantile
};

/// The `keep` largest of many numbers, for each of `count` columns: a heap each, its smallest in front.
class LargestValues {
 public:
  LargestValues(std::size_t count, std::size_t keep) : keep_(keep), values_(count * keep) {}

  /// `taken`: how many this column has been offered before.
  void offer(std::size_t column, std::size_t taken, double value);
  /// The largest of the `taken` offered, at most `keep`, in descending order.
  std::vector<double> descending(std::size_t column, std::size_t taken) const;

  double* values() { return values_.data(); }  ///< [count, keep]
  std::size_t keep() const { return keep_; }

 private:
  std::size_t keep_;
  std::vector<double> values_;  ///< [count, keep]
};

/// Mean, covariance, extremes and quantiles of a field, from samples that are seen once and not kept.
///
/// Mean and covariance as in Welford (Technometrics 4 (1962) 419). The quantiles are those of the samples
/// themselves, by linear interpolation between neighbours (type 7 of Hyndman and Fan, Am. Stat. 50 (1996)
/// 361; numpy's default): the number of samples is known beforehand, so only the tails beyond them are kept.
class RunningStatistics {
 public:
  /// At most `samples` will come; ½ ≤ quantile ≤ 1.
  RunningStatistics(std::size_t places, std::size_t samples, double quantile);

  /// One sample of each place, [places, 3].
  void add(const double* values);

  std::size_t samples() const { return taken_; }  ///< so far
  FieldStatistics result() const;                 ///< over the samples so far, at least one

  /// For a checkpoint: the arrays by place, names beginning with `name`; and how many samples they are of.
  std::vector<StateArray> state(const std::string& name, const std::string& units);
  void resume(std::size_t samples) { taken_ = samples; }

  /// Memory for one place.
  static double bytes(std::size_t samples, double quantile);

 private:
  void add_moments(std::size_t place, const double* x);

  std::size_t places_, taken_ = 0;
  double quantile_;
  std::vector<std::array<double, 3>> mean_;
  std::vector<std::array<double, 6>> products_;  ///< sums of products of the deviations from the mean
  LargestValues high_, low_;                     ///< [places, 3] columns each; the low ones with changed sign
};

}  // namespace slipscale
