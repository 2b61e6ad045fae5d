#include "slipscale/files/running_statistics.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

namespace slipscale {
namespace {

constexpr std::size_t width = 3;  // components
constexpr std::array<std::array<std::size_t, 2>, 6> pairs{{{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}}};

/// Where among n samples in ascending order, counted from 0, the quantile lies.
double position(std::size_t samples, double quantile) { return static_cast<double>(samples - 1) * quantile; }

/// How many of n samples, from the largest on, the quantile is made of. It never falls as n grows, so what is
/// enough for all samples is enough for the first of them.
std::size_t tail(std::size_t samples, double quantile) {
  return samples - static_cast<std::size_t>(std::floor(position(samples, quantile)));
}

double quantile_of(const std::vector<double>& descending, std::size_t samples, double quantile) {
  const double at = position(samples, quantile), below = std::floor(at);
  const std::size_t lower = samples - 1 - static_cast<std::size_t>(below);
  if (lower == 0) return descending[0];
  return descending[lower] + (at - below) * (descending[lower - 1] - descending[lower]);
}

}  // namespace

void LargestValues::offer(std::size_t column, std::size_t taken, double value) {
  double* const first = values_.data() + column * keep_;
  if (taken < keep_) {
    first[taken] = value;
    std::push_heap(first, first + taken + 1, std::greater<>());
  } else if (value > *first) {
    std::pop_heap(first, first + keep_, std::greater<>());
    first[keep_ - 1] = value;
    std::push_heap(first, first + keep_, std::greater<>());
  }
}

std::vector<double> LargestValues::descending(std::size_t column, std::size_t taken) const {
  const double* const first = values_.data() + column * keep_;
  std::vector<double> sorted(first, first + std::min(taken, keep_));
  std::sort(sorted.begin(), sorted.end(), std::greater<>());
  return sorted;
}

RunningStatistics::RunningStatistics(std::size_t places, std::size_t samples, double quantile)
    : places_(places),
      quantile_(quantile),
      mean_(places, std::array<double, 3>{}),
      products_(places, std::array<double, 6>{}),
      high_(width * places, tail(samples, quantile)),
      low_(width * places, tail(samples, quantile)) {}

void RunningStatistics::add(const double* values) {
  for (std::size_t place = 0; place < places_; ++place) {
    const double* const x = values + width * place;
    for (std::size_t i = 0; i < width; ++i) {
      high_.offer(width * place + i, taken_, x[i]);
      low_.offer(width * place + i, taken_, -x[i]);
    }
    add_moments(place, x);
  }
  ++taken_;
}

void RunningStatistics::add_moments(std::size_t place, const double* x) {
  std::array<double, width> before{}, after{};
  for (std::size_t i = 0; i < width; ++i) {
    before[i] = x[i] - mean_[place][i];
    mean_[place][i] += before[i] / static_cast<double>(taken_ + 1);
    after[i] = x[i] - mean_[place][i];
  }
  for (std::size_t p = 0; p < pairs.size(); ++p)
    products_[place][p] += before[pairs[p][0]] * after[pairs[p][1]];
}

FieldStatistics RunningStatistics::result() const {
  FieldStatistics found;
  for (std::size_t place = 0; place < places_; ++place) {
    found.mean.insert(found.mean.end(), mean_[place].begin(), mean_[place].end());
    for (const double sum : products_[place]) found.covariance.push_back(sum / static_cast<double>(taken_));
  }
  for (std::size_t column = 0; column < width * places_; ++column) {
    const auto high = high_.descending(column, taken_), low = low_.descending(column, taken_);
    found.highest.push_back(high[0]);
    found.lowest.push_back(-low[0]);
    found.quantile_high.push_back(quantile_of(high, taken_, quantile_));
    found.quantile_low.push_back(-quantile_of(low, taken_, quantile_));
  }
  return found;
}

std::vector<StateArray> RunningStatistics::state(const std::string& name, const std::string& units) {
  const auto tails = static_cast<int>(width * high_.keep());
  return {{name + "_mean", units, "mean so far; xx, yy, xy", 3, places_ > 0 ? mean_[0].data() : nullptr},
          {name + "_products", "(" + units + ")^2", "sums of products of the deviations from it", 6,
           places_ > 0 ? products_[0].data() : nullptr},
          {name + "_largest", units, "heaps of the largest samples; xx, yy, xy", tails, high_.values()},
          {name + "_smallest", units, "the same of the smallest, with changed sign", tails, low_.values()}};
}

double RunningStatistics::bytes(std::size_t samples, double quantile) {
  const double tails = 2.0 * width * static_cast<double>(tail(samples, quantile));
  return sizeof(double) * (width + pairs.size() + tails);
}

}  // namespace slipscale
