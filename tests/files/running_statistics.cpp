#include "slipscale/files/running_statistics.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

using namespace slipscale;

namespace {

using Samples = std::vector<std::vector<double>>;  ///< [samples][3 places]

Samples random_samples(std::size_t count, std::size_t places, double offset) {
  std::mt19937 generator(7);
  std::normal_distribution<double> normal;
  Samples samples(count, std::vector<double>(3 * places));
  for (auto& sample : samples)
    for (double& x : sample) x = offset + normal(generator);
  return samples;
}

/// Rounded to whole numbers, so that values come again and again.
Samples with_ties(Samples samples) {
  for (auto& sample : samples)
    for (double& x : sample) x = std::round(2 * x);
  return samples;
}

FieldStatistics running(const Samples& samples, std::size_t expected, double quantile) {
  RunningStatistics statistics(samples[0].size() / 3, expected, quantile);
  for (const auto& sample : samples) statistics.add(sample.data());
  EXPECT_EQ(statistics.samples(), samples.size());
  return statistics.result();
}

std::vector<double> column(const Samples& samples, std::size_t k) {
  std::vector<double> values;
  for (const auto& sample : samples) values.push_back(sample[k]);
  return values;
}

long double mean(const std::vector<double>& x) {
  long double sum = 0;
  for (const double value : x) sum += value;
  return sum / static_cast<long double>(x.size());
}

long double covariance(const std::vector<double>& x, const std::vector<double>& y) {
  const long double a = mean(x), b = mean(y);
  long double sum = 0;
  for (std::size_t n = 0; n < x.size(); ++n) sum += (x[n] - a) * (y[n] - b);
  return sum / static_cast<long double>(x.size());
}

/// By sorting all samples.
double quantile(std::vector<double> x, double q) {
  std::sort(x.begin(), x.end());
  const double at = static_cast<double>(x.size() - 1) * q;
  const auto below = static_cast<std::size_t>(at), above = std::min(below + 1, x.size() - 1);
  return x[below] + (at - static_cast<double>(below)) * (x[above] - x[below]);
}

/// Against sums over all samples in extended precision. `rounding`: parts of the largest value.
void expect_direct(const Samples& samples, const FieldStatistics& found, double q) {
  constexpr std::array<std::array<std::size_t, 2>, 6> pairs{{{0, 0}, {1, 1}, {2, 2}, {1, 2}, {0, 2}, {0, 1}}};
  double largest = 0;
  for (const auto& sample : samples)
    for (const double x : sample) largest = std::max(largest, std::abs(x));
  const double rounding = 4 * static_cast<double>(samples.size()) * 1.2e-16 * largest;
  for (std::size_t k = 0; k < samples[0].size(); ++k) {
    const auto x = column(samples, k);
    EXPECT_NEAR(found.mean[k], static_cast<double>(mean(x)), rounding);
    EXPECT_EQ(found.lowest[k], *std::min_element(x.begin(), x.end()));
    EXPECT_EQ(found.highest[k], *std::max_element(x.begin(), x.end()));
    // Interpolated by q, or by 1 - q, which is rounded.
    EXPECT_NEAR(found.quantile_high[k], quantile(x, q), rounding);
    EXPECT_NEAR(found.quantile_low[k], quantile(x, 1 - q), rounding);
  }
  for (std::size_t place = 0; place < samples[0].size() / 3; ++place)
    for (std::size_t p = 0; p < 6; ++p) {
      const auto x = column(samples, 3 * place + pairs[p][0]), y = column(samples, 3 * place + pairs[p][1]);
      const auto scale = static_cast<double>(std::sqrt(covariance(x, x) * covariance(y, y)));
      EXPECT_NEAR(found.covariance[6 * place + p], static_cast<double>(covariance(x, y)),
                  rounding * std::max(1.0, scale));
    }
}

}  // namespace

TEST(RunningStatistics, AreThoseOfAllSamples) {
  for (const double q : {0.5, 0.75, 0.9, 0.99, 0.999, 1.0})
    for (const std::size_t count : {1u, 2u, 3u, 10u, 100u, 101u, 1000u}) {
      SCOPED_TRACE(testing::Message() << count << " samples, quantile " << q);
      const auto samples = random_samples(count, 4, 0.3);
      expect_direct(samples, running(samples, count, q), q);
      expect_direct(with_ties(samples), running(with_ties(samples), count, q), q);
    }
}

/// A run that stops early has taken fewer samples than it made room for.
TEST(RunningStatistics, MayEndBeforeAllSamplesCame) {
  for (const double q : {0.5, 0.9, 0.99})
    for (const std::size_t taken : {1u, 2u, 9u, 57u, 99u}) {
      SCOPED_TRACE(testing::Message() << taken << " samples, quantile " << q);
      const auto samples = random_samples(taken, 2, -1);
      expect_direct(samples, running(samples, 100, q), q);
    }
}

/// Naive sums of squares would lose all digits of a deviation 1e-9 of the mean.
TEST(RunningStatistics, KeepTheVarianceBesideALargeMean) {
  const auto samples = random_samples(500, 2, 1e9);
  const auto found = running(samples, 500, 0.99);
  for (std::size_t place = 0; place < 2; ++place) {
    const auto x = column(samples, 3 * place);
    const auto exact = static_cast<double>(covariance(x, x));
    // The running mean carries an error of about half a unit in the last place of 1e9, 6e-8.
    EXPECT_NEAR(found.covariance[6 * place], exact, 1e-5 * exact);
  }
}

TEST(RunningStatistics, OfOneSampleAreTheSample) {
  const Samples samples{{1, -2, 3}};
  const auto found = running(samples, 1000, 0.99);
  for (const auto* values :
       {&found.mean, &found.lowest, &found.highest, &found.quantile_low, &found.quantile_high})
    EXPECT_EQ(*values, samples[0]);
  EXPECT_EQ(found.covariance, std::vector<double>(6, 0.0));
}

/// σ = (t, 2t, −3t) at t = 0, 1, …, 100: mean 50, variance (101² − 1)/12 = 850.
TEST(RunningStatistics, OfARampAreExact) {
  Samples samples;
  for (int t = 0; t <= 100; ++t) samples.push_back({1.0 * t, 2.0 * t, -3.0 * t});
  const auto found = running(samples, 101, 0.95);
  const auto expect = [](const std::vector<double>& values, const std::vector<double>& exact) {
    ASSERT_EQ(values.size(), exact.size());
    for (std::size_t k = 0; k < exact.size(); ++k)
      EXPECT_NEAR(values[k], exact[k], 1e-13 * std::abs(exact[k])) << k;
  };
  expect(found.mean, {50, 100, -150});
  expect(found.covariance, {850, 3400, 7650, -5100, -2550, 1700});
  expect(found.lowest, {0, 0, -300});
  expect(found.highest, {100, 200, 0});
  expect(found.quantile_high, {95, 190, -15});
  expect(found.quantile_low, {5, 10, -285});
}

TEST(RunningStatistics, MemoryIsThatOfTheTails) {
  // 1000 samples, the highest and the lowest eleven of each component, mean and six covariances.
  EXPECT_EQ(RunningStatistics::bytes(1000, 0.99), 8 * (3 + 6 + 6 * 11));
  EXPECT_EQ(RunningStatistics::bytes(1, 0.99), 8 * (3 + 6 + 6));
  EXPECT_EQ(RunningStatistics::bytes(1001, 0.5), 8 * (3 + 6 + 6 * 501));
}

TEST(LargestValues, AreTheLargest) {
  LargestValues largest(2, 3);
  const std::vector<double> left{5, 1, 4, 4, 2, 9}, right{-1, -2, -3, -4, -5, -6};
  for (std::size_t n = 0; n < left.size(); ++n) {
    largest.offer(0, n, left[n]);
    largest.offer(1, n, right[n]);
  }
  EXPECT_EQ(largest.descending(0, 6), (std::vector<double>{9, 5, 4}));
  EXPECT_EQ(largest.descending(1, 6), (std::vector<double>{-1, -2, -3}));
  EXPECT_EQ(LargestValues(1, 5).descending(0, 0), std::vector<double>{});
}
