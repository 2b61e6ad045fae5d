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

/// The `count` highest local maxima at or above bin `first`, highest first. Frequencies are interpolated by a
/// parabola through the logarithms of three bins: within 0.02 bins for a sinusoid. The first bins hold what
/// is left of the drift.
std::vector<Peak> peaks(const Spectrum& spectrum, std::size_t count, std::size_t first = 3);

/// Frequency of the highest peak, Hz; 0 when there is none.
double dominant_frequency(const Spectrum& spectrum);

}  // namespace slipscale
