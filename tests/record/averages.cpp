#include "slipscale/record/averages.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

using namespace slipscale;

namespace {

std::vector<double> noise(std::size_t count, double correlation, unsigned seed) {
  std::mt19937_64 generator(seed);
  std::normal_distribution<double> gauss;
  std::vector<double> values;
  double x = 0;
  for (std::size_t k = 0; k < count; ++k) {
    x = correlation * x + std::sqrt(1 - correlation * correlation) * gauss(generator);
    values.push_back(x);
  }
  return values;
}

double root_mean_square_error(std::size_t rows, double correlation) {
  double sum = 0;
  constexpr int tries = 200;
  for (unsigned seed = 1; seed <= tries; ++seed) {
    const double error = mean_of(noise(rows, correlation, seed)).error;
    sum += error * error;
  }
  return std::sqrt(sum / tries);
}

std::vector<double> wave(std::size_t count, double mean, double amplitude) {
  std::vector<double> values;
  for (std::size_t k = 0; k < count; ++k)
    values.push_back(mean + amplitude * std::sin(2 * std::numbers::pi * static_cast<double>(k) / 25));
  return values;
}

}  // namespace

TEST(DefaultWindow, IsTheSecondHalfOfTheTime) {
  const std::vector<double> times = {0, 1, 2, 3, 4}, late = {10, 11, 12, 13, 14, 14.5};
  EXPECT_EQ(default_window(times), 2u);
  EXPECT_EQ(default_window(late), 3u);
  EXPECT_EQ(default_window({}), 0u);
  EXPECT_EQ(default_window(std::vector<double>{3}), 0u);
}

// The standard error of the mean of n independent values of deviation 1 is 1/√n, and of an autoregressive
// series of correlation r √((1 + r)/(1 − r)/n). Taking the larger of two estimates lies somewhat above.
TEST(StandardError, IsThatOfIndependentRows) {
  EXPECT_NEAR(root_mean_square_error(4000, 0) * std::sqrt(4000.0), 1.15, 0.12);
}

TEST(StandardError, CountsCorrelatedRowsForWhatTheyAreWorth) {
  const double r = 0.95, exact = std::sqrt((1 + r) / (1 - r) / 8000);
  EXPECT_NEAR(root_mean_square_error(8000, r) / exact, 1.15, 0.15);
}

TEST(StandardError, IsNotGivenForTooFewRows) {
  EXPECT_TRUE(std::isnan(mean_of(std::vector<double>(9, 1.0)).error));
  EXPECT_FALSE(std::isnan(mean_of(std::vector<double>(10, 1.0)).error));
  EXPECT_EQ(mean_of(std::vector<double>(40, 2.5)).value, 2.5);
  EXPECT_EQ(mean_of(std::vector<double>(40, 2.5)).error, 0);
}

TEST(RatioOfMeans, IsNoMeanOfRatios) {
  const std::vector<double> top = {1, 3, 1, 3}, bottom = {10, 10, 2, 2};
  EXPECT_DOUBLE_EQ(ratio_of_means(top, bottom).value, 8.0 / 24.0);
  const std::vector<double> none(4, 0.0);
  EXPECT_TRUE(std::isnan(ratio_of_means(top, none).value));
}

// Where the forces go up and down together, the ratio is sharper than either.
TEST(RatioOfMeans, HasNoErrorWhereTheForcesAreInProportion) {
  const std::vector<double> bottom = wave(1000, 100, 30);
  std::vector<double> top;
  for (const double force : bottom) top.push_back(0.4 * force);
  const Average found = ratio_of_means(top, bottom);
  EXPECT_NEAR(found.value, 0.4, 1e-15);
  EXPECT_LT(found.error, 1e-15);
}

TEST(Settling, OfALimitCycle) {
  const Settling found = settling(wave(1000, 0.4, 0.1));
  EXPECT_TRUE(found.settled);
  EXPECT_NEAR(found.amplitude_ratio, 1, 1e-9);
  EXPECT_NEAR(found.drift, 0, 1e-9);
}

TEST(Settling, SeesAMeanThatMoves) {
  std::vector<double> signal = wave(1000, 0.4, 0.01);
  for (std::size_t k = 0; k < signal.size(); ++k) signal[k] += 0.04 * static_cast<double>(k) / 1000;
  const Settling found = settling(signal);
  EXPECT_FALSE(found.settled);
  EXPECT_NEAR(found.drift, 0.02 / 0.42, 1e-3);
}

TEST(Settling, SeesAVibrationThatGrows) {
  std::vector<double> signal = wave(500, 0.4, 0.05);
  const std::vector<double> later = wave(500, 0.4, 0.1);
  signal.insert(signal.end(), later.begin(), later.end());
  EXPECT_FALSE(settling(signal).settled);
  EXPECT_NEAR(settling(signal).amplitude_ratio, 2, 1e-9);
}

// A vibration that has all but died out is no matter, however much less there is of it.
TEST(Settling, OfWhatSlidesSteadily) {
  std::vector<double> signal = wave(500, 0.4, 1e-5);
  const std::vector<double> later = wave(500, 0.4, 1e-7);
  signal.insert(signal.end(), later.begin(), later.end());
  EXPECT_TRUE(settling(signal).settled);
}

// An instability grows from nothing, long before it is 1 % of friction; rounding of no vibration is none.
TEST(Settling, SeesASmallVibrationThatGrows) {
  const auto grown = [](double first, double second) {
    std::vector<double> signal = wave(500, 0.4, first);
    const std::vector<double> later = wave(500, 0.4, second);
    signal.insert(signal.end(), later.begin(), later.end());
    return settling(signal).settled;
  };
  for (const double amplitude : {1e-3, 1e-6, 1e-9}) {
    EXPECT_FALSE(grown(amplitude, 1.6 * amplitude)) << amplitude;
    EXPECT_FALSE(grown(0, amplitude)) << amplitude;
    EXPECT_TRUE(grown(amplitude, 1.4 * amplitude)) << amplitude;
  }
  EXPECT_TRUE(grown(1e-12, 2e-11));
}

TEST(Regime, HasTheNamesOfTheLiterature) {
  EXPECT_EQ(regime(0, 0, 0.001, 0.4, 0), "steady");
  EXPECT_EQ(regime(0, 0, 0.001, 0.4, 0.02), "slip");  // a wave that takes power
  EXPECT_EQ(regime(0, 0, 0.1, 0.4, 0), "slip");
  EXPECT_EQ(regime(0.3, 0.005, 0.1, 0.4, 0), "stick-slip");
  EXPECT_EQ(regime(0, 0.2, 0.1, 0.4, 0), "slip-separated");
  EXPECT_EQ(regime(0.3, 0.2, 0.1, 0.4, 0), "stick-slip-separated");
  EXPECT_EQ(regime(0, 1, 0, 0, 0), "open");
}
