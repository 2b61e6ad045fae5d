#include "slipscale/record/spectrum.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

using namespace slipscale;

namespace {

constexpr double interval = 1e-6;  // s

std::vector<double> sinusoid(std::size_t samples, double frequency, double amplitude, double phase = 0.3) {
  std::vector<double> series(samples);
  for (std::size_t k = 0; k < samples; ++k)
    series[k] =
        amplitude * std::sin(2 * std::numbers::pi * frequency * interval * static_cast<double>(k) + phase);
  return series;
}

std::vector<double> white_noise(std::size_t samples, double deviation) {
  std::mt19937 random(7);
  std::normal_distribution<double> normal(0, deviation);
  std::vector<double> series(samples);
  for (double& value : series) value = normal(random);
  return series;
}

double power(const Spectrum& spectrum) {
  return spectrum.step * std::accumulate(spectrum.density.begin(), spectrum.density.end(), 0.0);
}

}  // namespace

TEST(Welch, PowerOfASinusoidIsHalfItsAmplitudeSquared) {
  for (std::size_t segment : {1000u, 1001u}) {
    const auto spectrum = welch(sinusoid(4000, 50e3, 3.0), interval, segment);
    EXPECT_EQ(spectrum.frequency.size(), segment / 2 + 1);
    EXPECT_NEAR(power(spectrum), 4.5, 0.01);
  }
}

TEST(Welch, SinusoidOnABinFillsThreeBins) {
  const auto spectrum = welch(sinusoid(4000, 50e3, 3.0), interval, 1000);
  EXPECT_DOUBLE_EQ(spectrum.step, 1000.0);
  EXPECT_NEAR(spectrum.density[50] * spectrum.step, 4.5 / 1.5, 1e-10);
  EXPECT_NEAR(spectrum.density[49] / spectrum.density[50], 0.25, 1e-10);
  EXPECT_NEAR(spectrum.density[51] / spectrum.density[50], 0.25, 1e-10);
  EXPECT_NEAR(spectrum.density[53], 0, 1e-20);
}

TEST(Welch, ParsevalHoldsForOneSegment) {
  const auto series = white_noise(2048, 1.0);
  const double mean = std::accumulate(series.begin(), series.end(), 0.0) / 2048;
  double weighted = 0, weights = 0;
  for (std::size_t k = 0; k < series.size(); ++k) {
    const double window = 0.5 * (1 - std::cos(2 * std::numbers::pi * static_cast<double>(k) / 2048));
    weighted += window * window * (series[k] - mean) * (series[k] - mean);
    weights += window * window;
  }
  EXPECT_NEAR(power(welch(series, interval, 2048)), weighted / weights, 1e-12);
}

TEST(Welch, WhiteNoiseIsFlatAtTwiceItsVariancePerSamplingRate) {
  const auto spectrum = welch(white_noise(400000, 2.0), interval, 1000);
  const double level = 2 * 4.0 * interval;
  for (std::size_t band = 10; band + 100 < spectrum.density.size(); band += 100) {
    const auto start = spectrum.density.begin() + static_cast<std::ptrdiff_t>(band);
    EXPECT_NEAR(std::accumulate(start, start + 100, 0.0) / 100, level, 0.02 * level);
  }
}

TEST(Welch, MeanIsNoSignal) {
  auto series = sinusoid(4000, 50e3, 1e-3);
  for (double& value : series) value += 1e3;
  EXPECT_NEAR(power(welch(series, interval)), 0.5e-6, 1e-8);
}

TEST(Welch, IsEmptyForTooFewSamples) {
  EXPECT_TRUE(welch({1, 2, 3}, interval).density.empty());
  EXPECT_TRUE(welch(std::vector<double>(10), interval, 11).density.empty());
  EXPECT_EQ(dominant_frequency(welch({}, interval)), 0);
}

TEST(Peaks, FrequencyIsFoundBetweenBins) {
  for (double part = 0; part < 1; part += 0.1) {
    const double frequency = 50e3 + part * 1e3;
    const auto spectrum = welch(sinusoid(4000, frequency, 1.0), interval, 1000);
    EXPECT_NEAR(dominant_frequency(spectrum), frequency, 0.02 * spectrum.step);
  }
}

TEST(Peaks, AreSortedByHeight) {
  auto series = sinusoid(8000, 30e3, 1.0);
  const auto second = sinusoid(8000, 90e3, 2.0), third = sinusoid(8000, 200e3, 0.5);
  for (std::size_t k = 0; k < series.size(); ++k) series[k] += second[k] + third[k];
  const auto found = peaks(welch(series, interval, 1000), 3);
  ASSERT_EQ(found.size(), 3u);
  EXPECT_NEAR(found[0].frequency, 90e3, 20);
  EXPECT_NEAR(found[1].frequency, 30e3, 20);
  EXPECT_NEAR(found[2].frequency, 200e3, 20);
  EXPECT_NEAR(found[0].density / found[1].density, 4.0, 0.01);
}

TEST(Peaks, DriftIsPassedOver) {
  auto series = sinusoid(4000, 50e3, 1.0);
  for (std::size_t k = 0; k < series.size(); ++k) series[k] += 10.0 * static_cast<double>(k) / 4000;
  EXPECT_NEAR(dominant_frequency(welch(series, interval, 1000)), 50e3, 20);
}

/// A hump of noise around 100 kHz, 30 kHz wide, and a line at 300 kHz: two peaks, not a comb of them.
TEST(Peaks, OfOneHumpAreListedOnce) {
  std::vector<double> series = white_noise(20000, 1.0);
  double before = 0, last = 0;
  const double turn = 2 * std::numbers::pi * 100e3 * interval,
               damping = 1 - std::numbers::pi * 30e3 * interval;
  for (double& value : series) {  // a damped oscillator driven by noise
    value += 2 * damping * std::cos(turn) * last - damping * damping * before;
    before = last;
    last = value;
  }
  const auto line = sinusoid(20000, 300e3, 20.0);
  for (std::size_t k = 0; k < series.size(); ++k) series[k] += line[k];
  const auto found = peaks(welch(series, interval), 2);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_NEAR(found[0].frequency, 300e3, 100);
  EXPECT_NEAR(found[1].frequency, 100e3, 20e3);
}

TEST(Peaks, ALineBelowTheResolutionIsNotDominant) {
  auto series = sinusoid(4000, 50e3, 1.0);
  const auto slow = sinusoid(4000, 0.7 / (2000 * interval), 5.0);
  for (std::size_t k = 0; k < series.size(); ++k) series[k] += slow[k];
  const auto spectrum = welch(series, interval);
  EXPECT_EQ(dominant_frequency(spectrum), 0);
  ASSERT_FALSE(peaks(spectrum, 1).empty());
}

/// 430 kHz and 50 kHz recorded every tenth sample of 1 MHz, 100 000 rows a second: 430 kHz shows at 30 kHz.
TEST(Aliases, AreFoundInADenserRecord) {
  auto dense = sinusoid(40000, 430e3 * 1e-6 / interval, 1.0);
  const auto slow = sinusoid(40000, 20e3 * 1e-6 / interval, 0.5);
  std::vector<double> sparse;
  for (std::size_t k = 0; k < dense.size(); ++k) {
    dense[k] += slow[k];
    if (k % 10 == 0) sparse.push_back(dense[k]);
  }
  const auto found = peaks(welch(sparse, 1e-5), 2);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_NEAR(found[0].frequency, 30e3, 50);
  EXPECT_NEAR(found[1].frequency, 20e3, 50);
  const auto wrong = aliases(found, 1e5, welch(dense, 1e-6));
  ASSERT_EQ(wrong.size(), 1u);
  EXPECT_NEAR(wrong[0].recorded, 30e3, 50);
  EXPECT_NEAR(wrong[0].source, 430e3, 50);
  EXPECT_TRUE(aliases(peaks(welch(dense, 1e-6), 2), 1e6, welch(dense, 1e-6)).empty());
}
