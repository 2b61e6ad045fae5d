#include "slipscale/record/spectrum.hpp"

#include <fftw3.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <numeric>

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
        plan_(fftw_plan_dft_r2c_1d(static_cast<int>(length), in_.get(), out_.get(), FFTW_ESTIMATE)) {}
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
  std::vector<Peak> found;
  for (std::size_t k = std::max<std::size_t>(first, 1); k + 1 < density.size(); ++k) {
    if (!(density[k] > density[k - 1] && density[k] >= density[k + 1])) continue;
    const double top = parabola_top(density[k - 1], density[k], density[k + 1]);
    found.push_back({(static_cast<double>(k) + top) * spectrum.step, density[k]});
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Peak& a, const Peak& b) { return a.density > b.density; });
  if (found.size() > count) found.resize(count);
  return found;
}

double dominant_frequency(const Spectrum& spectrum) {
  const auto highest = peaks(spectrum, 1);
  return highest.empty() ? 0 : highest.front().frequency;
}

}  // namespace slipscale
