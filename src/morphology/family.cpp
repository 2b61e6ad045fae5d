#include "family.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace slipscale::morphology {
namespace {

constexpr double cut_off = 3;          // deviations
constexpr double most_off_mean = 0.9;  // so that no size is below a tenth of the mean

/// Deviation of the logarithm of lognormal sizes.
double log_deviation(const Family& family) {
  return std::sqrt(std::log1p(family.diameter_deviation * family.diameter_deviation));
}

double normal_within(double bound, Random& random) {
  double z;
  do z = random.normal();
  while (std::abs(z) > bound);
  return z;
}

/// Over the mean.
double drawn_size(const Family& family, Random& random) {
  const double deviation = family.diameter_deviation;
  if (deviation == 0) return 1;
  switch (family.distribution) {
    case SizeDistribution::normal:
      return 1 + deviation * normal_within(std::min(cut_off, most_off_mean / deviation), random);
    case SizeDistribution::lognormal: {
      const double s = log_deviation(family);
      return quantised(std::exp(s * normal_within(cut_off, random) - 0.5 * s * s));
    }
    case SizeDistribution::uniform:
      break;
  }
  return 1 + std::min(std::numbers::sqrt3 * deviation, most_off_mean) * (2 * random.uniform() - 1);
}

double drawn_angle(const Family& family, Random& random) {
  if (family.shape == Shape::disc) return 0;
  if (std::isinf(family.angle_deviation)) return std::numbers::pi * random.uniform();
  if (family.angle_deviation == 0) return family.angle;
  return family.angle + family.angle_deviation * normal_within(cut_off, random);
}

}  // namespace

Inclusion shaped(const Family& family, int index, double diameter, double angle) {
  Inclusion inclusion;
  inclusion.shape = family.shape;
  inclusion.family = index;
  inclusion.half_length = inclusion.half_width = 0.5 * diameter;
  if (family.shape == Shape::disc) return inclusion;
  inclusion.half_width = 0.5 * diameter / family.aspect;
  inclusion.angle = angle;
  if (family.shape == Shape::rectangle) inclusion.corner = family.rounding * inclusion.half_width;
  return inclusion;
}

Inclusion drawn(const Family& family, int index, Random& random) {
  const double size = drawn_size(family, random);
  return shaped(family, index, size * family.diameter, drawn_angle(family, random));
}

double largest_size(const Family& family) {
  const double deviation = family.diameter_deviation;
  switch (family.distribution) {
    case SizeDistribution::normal:
      return 1 + std::min(cut_off * deviation, most_off_mean);
    case SizeDistribution::lognormal: {
      const double s = log_deviation(family);
      return std::exp(cut_off * s - 0.5 * s * s);
    }
    case SizeDistribution::uniform:
      break;
  }
  return 1 + std::min(std::numbers::sqrt3 * deviation, most_off_mean);
}

double largest_extent(const Family& family, int axis) {
  const double diameter = largest_size(family) * family.diameter;
  const double spread = std::min(cut_off * family.angle_deviation, 0.5 * std::numbers::pi);
  constexpr int steps = 90;
  double largest = 0;
  for (int k = -steps; k <= steps; ++k) {
    const Inclusion inclusion = shaped(family, 0, diameter, family.angle + k * spread / steps);
    largest = std::max(largest, 2 * support(inclusion, axis == 0 ? Vector2{1, 0} : Vector2{0, 1}));
  }
  return largest;
}

}  // namespace slipscale::morphology
