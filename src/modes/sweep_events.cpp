// What happens along a sweep: where modes begin to grow, cease to, and couple.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "slipscale/base/print.hpp"
#include "slipscale/modes/modes_sweep.hpp"

namespace slipscale {
namespace {

constexpr double is_near = 0.03;  ///< two modes couple within this distance, relative

bool is_there(Complex p) { return std::isfinite(p.real()) && std::isfinite(p.imag()); }

double frequency_of(Complex p) { return p.imag() / (2 * std::numbers::pi); }

bool is_growing(Complex p) {
  constexpr double rounding = 1e-9;
  return p.real() > rounding * std::abs(p);
}

void find_limits(ModesSweep& sweep, std::size_t n) {
  const auto& p = sweep.paths[n].exponent;
  const auto& values = sweep.choice.values;
  for (std::size_t k = 0; k + 1 < p.size(); ++k) {
    if (!is_there(p[k]) || !is_there(p[k + 1]) || is_growing(p[k]) == is_growing(p[k + 1])) continue;
    const double part = std::clamp(p[k].real() / (p[k].real() - p[k + 1].real()), 0.0, 1.0);
    sweep.limits.push_back({n, values[k] + part * (values[k + 1] - values[k]),
                            frequency_of(p[k] + part * (p[k + 1] - p[k])), is_growing(p[k + 1])});
  }
}

void find_couplings(ModesSweep& sweep, std::size_t a, std::size_t b) {
  const auto &one = sweep.paths[a].exponent, &other = sweep.paths[b].exponent;
  const auto distance = [&](std::size_t k) { return std::abs(one[k] - other[k]) / std::abs(one[k]); };
  for (std::size_t k = 1; k + 1 < one.size(); ++k) {
    const double here = distance(k);
    if (!(here <= is_near) || !(here <= distance(k - 1)) || !(here < distance(k + 1))) continue;
    // Two that merely cross go on as they came: growth rates part where modes couple.
    const double before = std::abs((one[k - 1] - other[k - 1]).real()),
                 after = std::abs((one[k + 1] - other[k + 1]).real());
    if (after <= before) continue;
    sweep.couplings.push_back(
        {{a, b}, sweep.choice.values[k], frequency_of(0.5 * (one[k] + other[k])), here});
  }
}

}  // namespace

void find_events(ModesSweep& sweep) {
  sweep.limits.clear();
  sweep.couplings.clear();
  for (std::size_t n = 0; n < sweep.paths.size(); ++n) {
    find_limits(sweep, n);
    for (std::size_t other = n + 1; other < sweep.paths.size(); ++other) find_couplings(sweep, n, other);
  }
  std::ranges::sort(sweep.limits, {}, &StabilityLimit::value);
  std::ranges::sort(sweep.couplings, {}, &Coupling::value);
}

std::string describe(const ModesSweep& sweep) {
  const SweepChoice& choice = sweep.choice;
  std::string text = format(
      "sweep of {} from {:g} to {:g}, {} values: {} modes followed, in {} vectors of {} places; largest "
      "residual {:.1e}\n",
      choice.name, choice.values.front(), choice.values.back(), choice.values.size(), sweep.paths.size(),
      sweep.basis, sweep.places.size(), sweep.worst);
  std::vector<std::vector<std::string>> rows{{"at " + choice.name, "frequency [Hz]", "mode", "what"}};
  for (const StabilityLimit& limit : sweep.limits)
    rows.push_back({format("{:.6g}", limit.value), format("{:.6g}", limit.frequency),
                    std::to_string(limit.path + 1), limit.grows ? "begins to grow" : "ceases to grow"});
  for (const Coupling& coupling : sweep.couplings)
    rows.push_back({format("{:.6g}", coupling.value), format("{:.6g}", coupling.frequency),
                    format("{} and {}", coupling.paths[0] + 1, coupling.paths[1] + 1),
                    format("couple, apart by {:.2g}", coupling.distance)});
  if (rows.size() > 1) text += table(rows);
  rows = {{choice.name, "growing", "fastest [1/s]", "at [Hz]"}};
  constexpr std::size_t most_rows = 11;
  const std::size_t last = choice.values.size() - 1, shown = std::min(last, most_rows - 1);
  for (std::size_t row = 0; row <= shown; ++row) {
    const std::size_t k = shown == 0 ? 0 : row * last / shown;
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    Complex fastest{none, none};
    int growing = 0;
    for (const ModePath& path : sweep.paths) {
      const Complex p = path.exponent[k];
      if (!is_there(p)) continue;
      growing += is_growing(p);
      if (!is_there(fastest) || p.real() > fastest.real()) fastest = p;
    }
    rows.push_back({format("{:.6g}", choice.values[k]), std::to_string(growing),
                    format("{:.6g}", fastest.real()), format("{:.6g}", frequency_of(fastest))});
  }
  return text + table(rows);
}

}  // namespace slipscale
