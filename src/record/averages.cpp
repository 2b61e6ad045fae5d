#include "slipscale/record/averages.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace slipscale {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr double counts = 0.01;  ///< parts below this do not name a regime, and drifts below it are none
constexpr double same_amplitude = 1.25;
constexpr double growth = 1.5;              ///< of an amplitude from half to half, beyond chance and beating
constexpr double rounding_of_sums = 1e-10;  ///< of the mean: forces are sums over nodes, steps over steps
constexpr double errors_of_doubt = 3;

double plain_mean(std::span<const double> rows) {
  return rows.empty() ? 0 : std::accumulate(rows.begin(), rows.end(), 0.0) / static_cast<double>(rows.size());
}

/// From the means of `count` blocks at the end of the rows; NaN where a block would have fewer than two rows.
double block_error(std::span<const double> rows, std::size_t count) {
  const std::size_t length = rows.size() / count;
  if (length < 2) return nan;
  std::vector<double> means;
  for (std::size_t k = 0; k < count; ++k)
    means.push_back(plain_mean(rows.subspan(rows.size() - (count - k) * length, length)));
  const auto n = static_cast<double>(count);
  return deviation_of(means) * std::sqrt(n / (n - 1)) / std::sqrt(n);
}

double standard_error(std::span<const double> rows) {
  const double fine = block_error(rows, error_blocks), coarse = block_error(rows, error_blocks / 2);
  return std::isnan(fine) ? coarse : std::max(fine, coarse);
}

}  // namespace

double deviation_of(std::span<const double> rows) {
  if (rows.empty()) return 0;
  const double mean = plain_mean(rows);
  double sum = 0;
  for (const double value : rows) sum += (value - mean) * (value - mean);
  return std::sqrt(sum / static_cast<double>(rows.size()));
}

std::size_t default_window(std::span<const double> times) {
  if (times.empty()) return 0;
  const double middle = 0.5 * (times.front() + times.back());
  return static_cast<std::size_t>(std::lower_bound(times.begin(), times.end(), middle) - times.begin());
}

Average mean_of(std::span<const double> rows) { return {plain_mean(rows), standard_error(rows)}; }

Average ratio_of_means(std::span<const double> top, std::span<const double> bottom) {
  const double below = plain_mean(bottom);
  if (below == 0) return {nan, nan};
  const double ratio = plain_mean(top) / below;
  std::vector<double> rest;
  for (std::size_t k = 0; k < top.size(); ++k) rest.push_back(top[k] - ratio * bottom[k]);
  return {ratio, standard_error(rest) / std::abs(below)};
}

Settling settling(std::span<const double> signal) {
  const std::size_t half = signal.size() / 2;
  const auto first = signal.first(half), second = signal.subspan(signal.size() - half);
  const double mean = plain_mean(signal), step = plain_mean(second) - plain_mean(first);
  const double before = deviation_of(first), after = deviation_of(second);
  Settling found;
  if (mean != 0) found.drift = step / std::abs(mean);
  if (before > 0) found.amplitude_ratio = after / before;
  const double doubt = errors_of_doubt * std::hypot(standard_error(first), standard_error(second));
  const bool same_mean = std::abs(step) <= counts * std::abs(mean) || std::abs(step) <= doubt;
  const bool vibrates = std::max(before, after) > counts * std::abs(mean);
  const bool same_size = std::max(before, after) <= same_amplitude * std::min(before, after);
  const bool grows = after > growth * before && after > rounding_of_sums * std::abs(mean);
  found.settled = same_mean && !grows && (!vibrates || same_size);
  return found;
}

std::string regime(double stick, double open, double amplitude, double friction, double power_ratio) {
  if (open >= 1) return "open";
  if (amplitude <= counts * std::abs(friction) && std::abs(power_ratio) <= counts) return "steady";
  return std::string(stick > counts ? "stick-slip" : "slip") + (open > counts ? "-separated" : "");
}

}  // namespace slipscale
