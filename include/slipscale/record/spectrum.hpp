#pragma once

#include <cstddef>
#include <vector>

namespace slipscale {

/// One-sided power spectral density, whose sum times `step` is the variance of the signal.
struct Spectrum {
  std::vector<double> frequency;  ///< Hz, k * step
  std::vector<double> density;    ///< unit²/Hz
  double step = 0;                ///< Hz
};

struct Peak {
  double frequency = 0;  ///< Hz, interpolated between the bins
  double density = 0;    ///< unit²/Hz at the highest bin
};

/// Welch's method with a periodic Hann window and half-overlapping segments, the mean of each removed
/// (P. D. Welch, IEEE Trans. Audio Electroacoust. 15 (1967) 70).
///
/// `series` is evenly sampled every `interval` seconds; `segment` is the segments' length in samples, 0: half
/// the series, which makes three. Empty when a segment would have fewer than 8 samples or more than the
/// series.
Spectrum welch(const std::vector<double>& series, double interval, std::size_t segment = 0);

/// Bins from which on a line is one: what is slower varies less than three times within a segment and cannot
/// be told from drift.
constexpr std::size_t first_resolved_bin = 3;

/// The `count` highest local maxima at or above bin `first`, highest first, one of each hump: a maximum
/// stands for itself when the density, smoothed over five bins, falls on the way to every higher one below a
/// quarter of its own. Frequencies are interpolated by a parabola through the logarithms of three bins:
/// within 0.02 bins for a sinusoid.
std::vector<Peak> peaks(const Spectrum& spectrum, std::size_t count, std::size_t first = first_resolved_bin);

/// Frequency of the highest peak, Hz; 0 when there is none, and when the density is higher still below the
/// first resolved bin: what dominates is then slower than the series can tell.
double dominant_frequency(const Spectrum& spectrum);

/// A peak of a sparse record that a faster vibration makes.
struct Alias {
  double recorded = 0, source = 0;  ///< Hz
};

/// Which of the peaks of a record with `rate` rows a second are aliases, as a spectrum of the same signal
/// shows that was taken more often: those at which more than a tenth of the power comes from the frequencies
/// k·rate ± f that fall on f. Powers are those within two bins of the denser spectrum.
std::vector<Alias> aliases(const std::vector<Peak>& found, double rate, const Spectrum& dense);

}  // namespace slipscale
