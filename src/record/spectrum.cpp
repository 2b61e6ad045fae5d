#include "slipscale/record/spectrum.hpp"

#include <fftw3.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <numeric>

#include "slipscale/base/error.hpp"
#include "slipscale/base/print.hpp"

namespace slipscale {
namespace {

struct FreeFftw {
  void operator()(void* array) const { fftw_free(array); }
};

/// Squared magnitudes of the Fourier transform of real segments of one length.
class Transform {
 public:
  explicit Transform(std::size_t length)
      : length_(length),
        in_(fftw_alloc_real(length)),
        out_(fftw_alloc_complex(length / 2 + 1)),
        plan_(fftw_plan_dft_r2c_1d(static_cast<int>(length), in_.get(), out_.get(), FFTW_ESTIMATE)) {
    if (!in_ || !out_ || !plan_) {
      fftw_destroy_plan(plan_);
      throw LibraryError(format("FFTW has no plan for a segment of {} samples", length));
    }
  }
  ~Transform() { fftw_destroy_plan(plan_); }
  Transform(const Transform&) = delete;
  Transform& operator=(const Transform&) = delete;

  /// Adds |FFT of window * (segment - its mean)|² to `power` [length / 2 + 1].
  void add(const double* segment, const std::vector<double>& window, std::vector<double>& power) {
    const double mean = std::accumulate(segment, segment + length_, 0.0) / static_cast<double>(length_);
    for (std::size_t k = 0; k < length_; ++k) in_.get()[k] = (segment[k] - mean) * window[k];
    fftw_execute(plan_);
    for (std::size_t k = 0; k < power.size(); ++k) {
      const fftw_complex& z = out_.get()[k];
      power[k] += z[0] * z[0] + z[1] * z[1];
    }
  }

 private:
  std::size_t length_;
  std::unique_ptr<double, FreeFftw> in_;
  std::unique_ptr<fftw_complex, FreeFftw> out_;
  fftw_plan plan_;
};

std::vector<double> hann(std::size_t length) {
  std::vector<double> window(length);
  for (std::size_t k = 0; k < length; ++k)
    window[k] =
        0.5 * (1 - std::cos(2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(length)));
  return window;
}

/// Means over five bins, fewer at the ends.
std::vector<double> smoothed(const std::vector<double>& density) {
  std::vector<double> means;
  const auto size = static_cast<std::ptrdiff_t>(density.size());
  for (std::ptrdiff_t k = 0; k < size; ++k) {
    const auto begin = std::max<std::ptrdiff_t>(k - 2, 0), end = std::min(k + 3, size);
    means.push_back(std::accumulate(density.begin() + begin, density.begin() + end, 0.0) /
                    static_cast<double>(end - begin));
  }
  return means;
}

/// Whether a valley lies between a maximum and a higher one.
bool apart(const std::vector<double>& smooth, std::size_t one, std::size_t higher) {
  const auto [left, right] = std::minmax(one, higher);
  const auto begin = smooth.begin() + static_cast<std::ptrdiff_t>(left);
  return *std::min_element(begin, begin + static_cast<std::ptrdiff_t>(right - left)) < 0.25 * smooth[one];
}

/// Power within two bins of a frequency, unit².
double power_near(const Spectrum& spectrum, double frequency) {
  const double bin = std::round(frequency / spectrum.step);
  double power = 0;
  for (double k = std::max(bin - 2, 0.0); k <= bin + 2 && k < static_cast<double>(spectrum.density.size());
       ++k)
    power += spectrum.density[static_cast<std::size_t>(k)] * spectrum.step;
  return power;
}

/// Where the parabola through the logarithms of three neighbours has its top, in bins from the middle one.
double parabola_top(double left, double middle, double right) {
  if (left <= 0 || right <= 0) return 0;
  const double a = std::log(left / middle), b = std::log(right / middle);
  return a + b < 0 ? 0.5 * (a - b) / (a + b) : 0;
}

}  // namespace

Spectrum welch(const std::vector<double>& series, double interval, std::size_t segment) {
  if (segment == 0) segment = series.size() / 2;
  if (segment < 8 || segment > series.size()) return {};
  const auto window = hann(segment);
  std::vector<double> power(segment / 2 + 1, 0.0);
  Transform transform(segment);
  int segments = 0;
  for (std::size_t start = 0; start + segment <= series.size(); start += segment / 2, ++segments)
    transform.add(series.data() + start, window, power);

  const double window_power = std::inner_product(window.begin(), window.end(), window.begin(), 0.0);
  const double scale = interval / (window_power * segments);
  Spectrum spectrum;
  spectrum.step = 1 / (interval * static_cast<double>(segment));
  for (std::size_t k = 0; k < power.size(); ++k) {
    const bool has_mirror =
        k > 0 && 2 * k != segment;  // the negative frequency, which 0 and Nyquist have not
    spectrum.frequency.push_back(static_cast<double>(k) * spectrum.step);
    spectrum.density.push_back(power[k] * scale * (has_mirror ? 2 : 1));
  }
  return spectrum;
}

std::vector<Peak> peaks(const Spectrum& spectrum, std::size_t count, std::size_t first) {
  const auto& density = spectrum.density;
  std::vector<std::size_t> tops;
  for (std::size_t k = std::max<std::size_t>(first, 1); k + 1 < density.size(); ++k)
    if (density[k] > density[k - 1] && density[k] >= density[k + 1]) tops.push_back(k);
  std::stable_sort(tops.begin(), tops.end(),
                   [&](std::size_t a, std::size_t b) { return density[a] > density[b]; });

  const std::vector<double> smooth = smoothed(density);
  std::vector<std::size_t> kept;
  std::vector<Peak> found;
  for (const std::size_t k : tops) {
    if (found.size() == count) break;
    if (!std::all_of(kept.begin(), kept.end(), [&](std::size_t higher) { return apart(smooth, k, higher); }))
      continue;
    kept.push_back(k);
    const double top = parabola_top(density[k - 1], density[k], density[k + 1]);
    found.push_back({(static_cast<double>(k) + top) * spectrum.step, density[k]});
  }
  return found;
}

double dominant_frequency(const Spectrum& spectrum) {
  const auto highest = peaks(spectrum, 1);
  if (highest.empty()) return 0;
  const auto slow = spectrum.density.begin() + 1;
  const bool drifts = *std::max_element(slow, slow + first_resolved_bin - 1) > highest.front().density;
  return drifts ? 0 : highest.front().frequency;
}

std::vector<Alias> aliases(const std::vector<Peak>& found, double rate, const Spectrum& dense) {
  constexpr double share = 0.1;
  std::vector<Alias> seen;
  if (dense.density.empty()) return seen;
  const double highest = dense.frequency.back();
  for (const Peak& peak : found) {
    const double own = power_near(dense, peak.frequency);
    double strange = 0, strongest = 0, source = 0;
    const auto add = [&](double image) {
      const double power = image <= highest ? power_near(dense, image) : 0;
      strange += power;
      if (power > strongest) strongest = power, source = image;
    };
    for (double k = 1; k * rate - peak.frequency <= highest; ++k) {
      add(k * rate - peak.frequency);
      add(k * rate + peak.frequency);
    }
    if (strange > share * (own + strange)) seen.push_back({peak.frequency, source});
  }
  return seen;
}

}  // namespace slipscale
