#include "slipscale/relocalize/comparison.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace slipscale {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Stress far below this share of its other components is rounding of strains from displacements.
constexpr double rounding = 1e-10;

double square(double x) { return x * x; }

/// An integer for each double, in the same order; NaN lies at the ends.
std::uint64_t key_of(double value) {
  const auto bits = std::bit_cast<std::uint64_t>(value);
  return bits >> 63 ? ~bits : bits | std::uint64_t{1} << 63;
}
double value_of(std::uint64_t key) {
  return std::bit_cast<double>(key >> 63 ? key ^ std::uint64_t{1} << 63 : ~key);
}

/// The distribution of one component over a part's cells of this rank.
class Distribution {
 public:
  Distribution(const BlockPart& part, const ComparedCells& cells,
               std::span<const std::array<double, 3>> stress, std::size_t component) {
    std::vector<std::pair<std::uint64_t, double>> weighted;
    weighted.reserve(part.cells.size());
    for (const std::size_t c : part.cells) weighted.emplace_back(key_of(stress[c][component]), cells.area[c]);
    std::sort(weighted.begin(), weighted.end());
    keys_.reserve(weighted.size());
    area_.reserve(weighted.size() + 1);
    area_.push_back(0);
    for (const auto& [key, area] : weighted) {
      keys_.push_back(key);
      area_.push_back(area_.back() + area);
    }
  }

  double total() const { return area_.back(); }
  /// Area of the cells whose value is not above that of `key`.
  double up_to(std::uint64_t key) const {
    return area_[static_cast<std::size_t>(std::upper_bound(keys_.begin(), keys_.end(), key) - keys_.begin())];
  }

 private:
  std::vector<std::uint64_t> keys_;
  std::vector<double> area_;  ///< of all cells before, [cells + 1]
};

/// The lowest key for each distribution and level, [distributions * levels], up to which the area reaches
/// that share of the total.
std::vector<std::uint64_t> bisect(const std::vector<Distribution>& distributions,
                                  const std::vector<double>& levels, const std::vector<double>& total,
                                  const SumOverRanks& sum) {
  // Areas are summed in another order on other ranks: where they meet the share exactly, as the median of an
  // even number of equal cells does, rounding must not decide.
  constexpr double slack = 1e-12;
  const std::size_t searches = distributions.size() * levels.size();
  std::vector<std::uint64_t> low(searches, 0), high(searches, ~std::uint64_t{0});
  std::vector<double> area(searches);
  const auto middle = [&](std::size_t s) { return low[s] + (high[s] - low[s]) / 2; };
  for (int bit = 0; bit < 64; ++bit) {
    for (std::size_t s = 0; s < searches; ++s) area[s] = distributions[s / levels.size()].up_to(middle(s));
    sum(area);
    for (std::size_t s = 0; s < searches; ++s) {
      const double share = std::max(levels[s % levels.size()] - slack, slack);
      if (area[s] >= share * total[s / levels.size()])
        high[s] = middle(s);
      else
        low[s] = middle(s) + 1;
    }
  }
  return high;
}

StressQuantiles part_quantiles(const BlockPart& part, const ComparedCells& cells, const StressFields& fields,
                               const std::vector<double>& levels, const SumOverRanks& sum) {
  std::vector<Distribution> distributions;
  for (const auto& stress : fields)
    for (std::size_t i = 0; i < 3; ++i) distributions.emplace_back(part, cells, stress, i);
  std::vector<double> total;
  for (const Distribution& distribution : distributions) total.push_back(distribution.total());
  sum(total);
  const auto keys = bisect(distributions, levels, total, sum);
  StressQuantiles quantiles;
  for (std::size_t k = 0; k < keys.size(); ++k) {
    const std::size_t d = k / levels.size();
    quantiles[d / 3][d % 3].push_back(total[d] > 0 ? value_of(keys[k]) : nan);
  }
  return quantiles;
}

}  // namespace

StressSums& StressSums::operator+=(const StressSums& other) {
  area += other.area;
  for (std::size_t s = 0; s < StressSource::count; ++s)
    for (std::size_t i = 0; i < 3; ++i) {
      linear[s][i] += other.linear[s][i];
      quadratic[s][i] += other.quadratic[s][i];
    }
  return *this;
}

double StressSums::mean(StressSource::Index source, std::size_t component) const {
  return area > 0 ? linear[source][component] / area : nan;
}

double StressSums::relative_error(StressSource::Index source, std::size_t component) const {
  const auto& squares = quadratic[StressSource::reference];
  const double size = squares[0] + squares[1] + squares[2];
  if (!(squares[component] > square(rounding) * size)) return nan;
  return source == StressSource::reference ? 0 : std::sqrt(quadratic[source][component] / squares[component]);
}

std::vector<StressSums> stress_sums(const std::vector<BlockPart>& parts, const ComparedCells& cells,
                                    const StressFields& fields) {
  std::vector<StressSums> sums(parts.size());
  for (std::size_t p = 0; p < parts.size(); ++p)
    for (const std::size_t c : parts[p].cells) {
      const double area = cells.area[c];
      sums[p].area += area;
      for (std::size_t s = 0; s < StressSource::count; ++s)
        for (std::size_t i = 0; i < 3; ++i) {
          const double stress = fields[s][c][i];
          sums[p].linear[s][i] += area * stress;
          sums[p].quadratic[s][i] +=
              area *
              square(s == StressSource::reference ? stress : stress - fields[StressSource::reference][c][i]);
        }
    }
  return sums;
}

std::span<double> numbers(std::vector<StressSums>& sums) {
  constexpr std::size_t count = 1 + 2 * StressSource::count * 3;
  static_assert(sizeof(StressSums) == count * sizeof(double), "sums hold numbers alone, without gaps");
  return {reinterpret_cast<double*>(sums.data()), count * sums.size()};
}

std::vector<StressQuantiles> stress_quantiles(const std::vector<BlockPart>& parts, const ComparedCells& cells,
                                              const StressFields& fields, const std::vector<double>& levels,
                                              const SumOverRanks& sum) {
  std::vector<StressQuantiles> quantiles;
  for (const BlockPart& part : parts) quantiles.push_back(part_quantiles(part, cells, fields, levels, sum));
  return quantiles;
}

HistoryAgreement agreement(std::span<const double> reference, std::span<const double> history) {
  const std::size_t n = std::min(reference.size(), history.size());
  double mean_x = 0, mean_y = 0, size = 0, distance = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const double x = reference[k], y = history[k];
    mean_x += x / static_cast<double>(n);
    mean_y += y / static_cast<double>(n);
    size += square(x);
    distance += square(y - x);
  }
  double xx = 0, yy = 0, xy = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const double x = reference[k] - mean_x, y = history[k] - mean_y;
    xx += x * x;
    yy += y * y;
    xy += x * y;
  }
  const double count = static_cast<double>(n);
  const bool x_varies = xx > count * square(rounding * mean_x);
  const bool y_varies = yy > count * square(rounding * mean_y);
  return {x_varies && y_varies ? xy / std::sqrt(xx * yy) : nan, x_varies ? xy / xx : nan,
          size > 0 ? std::sqrt(distance / size) : nan};
}

std::vector<std::array<std::size_t, 2>> common_frames(std::span<const double> reference_time,
                                                      std::span<const double> time, double tolerance) {
  const auto nearest = [](std::span<const double> times, double t) {
    const auto after = std::lower_bound(times.begin(), times.end(), t);
    const bool before = after == times.end() || (after != times.begin() && t - *(after - 1) <= *after - t);
    return static_cast<std::size_t>(after - times.begin()) - (before ? 1 : 0);
  };
  std::vector<std::array<std::size_t, 2>> pairs;
  if (time.empty()) return pairs;
  for (std::size_t k = 0; k < reference_time.size(); ++k) {
    const std::size_t other = nearest(time, reference_time[k]);
    if (std::abs(time[other] - reference_time[k]) <= tolerance && nearest(reference_time, time[other]) == k)
      pairs.push_back({k, other});
  }
  return pairs;
}

}  // namespace slipscale
