#include "body.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "plane.hpp"

namespace slipscale::morphology {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// The parts below look at the quarter u, v >= 0 of an inclusion in its own axes.
Foot on_disc(const Inclusion& inclusion, const Vector2& x) {
  const double r = inclusion.half_length, distance = norm(x);
  const Vector2 n = distance > 0 ? (1 / distance) * x : Vector2{1, 0};
  return {r * n, n, 1 / r};
}

/// Of the flats before which x lies and the corner, the nearest.
Foot on_rectangle(const Inclusion& inclusion, const Vector2& x) {
  const double a = inclusion.half_length, b = inclusion.half_width, r = inclusion.corner;
  const Vector2 corner{a - r, b - r}, rest = x - corner;
  if (rest[0] > 0 && rest[1] > 0) return {corner + (r / norm(rest)) * rest, unit(rest), 1 / r};
  const bool before_end = rest[1] <= 0, before_flank = rest[0] <= 0;
  if (before_end && (!before_flank || std::abs(x[0] - a) < std::abs(x[1] - b))) return {{a, x[1]}, {1, 0}, 0};
  return {{x[0], b}, {0, 1}, 0};
}

/// The root t > -b² of (a u / (t + a²))² + (b v / (t + b²))² = 1 gives the nearest point
/// (a² u / (t + a²), b² v / (t + b²)). The left side is convex in t: Newton's method comes from below.
Foot on_ellipse(const Inclusion& inclusion, const Vector2& x) {
  const double a = inclusion.half_length, b = inclusion.half_width, u = x[0];
  const double v = std::max(x[1], 1e-12 * b);  // on the long axis the nearest point has a twin
  double t = b * v - b * b;
  for (int i = 0; i < 100; ++i) {
    const double p = a * u / (t + a * a), q = b * v / (t + b * b);
    const double step = (p * p + q * q - 1) / (2 * (p * p / (t + a * a) + q * q / (t + b * b)));
    t += step;
    if (std::abs(step) < 1e-15 * a * a) break;
  }
  const double cosine = a * u / (t + a * a), sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
  const double speed = std::hypot(a * sine, b * cosine);
  return {{a * cosine, b * sine}, (1 / speed) * Vector2{b * cosine, a * sine}, a * b / std::pow(speed, 3)};
}

Foot nearest_in_quarter(const Inclusion& inclusion, const Vector2& x) {
  switch (inclusion.shape) {
    case Shape::disc:
      return on_disc(inclusion, x);
    case Shape::ellipse:
      return on_ellipse(inclusion, x);
    case Shape::rectangle:
      break;
  }
  return on_rectangle(inclusion, x);
}

}  // namespace

Body::Body(const Inclusion& inclusion, int part)
    : part_(part), region_(inclusion.family + 1), inclusion_(inclusion), outline_(Outline(inclusion)) {}

Body::Body(const Vector2& n, double low, double high, int part)
    : part_(part), region_(1), n_(n), low_(low), high_(high) {}

std::optional<Interval> Body::covers(int axis, double at) const {
  if (!inclusion_) {
    const double across = n_[1 - axis], rest = n_[axis] * at;
    if (across == 0) {
      if (rest < low_ || rest > high_) return std::nullopt;
      return Interval{-infinity, infinity};
    }
    const double one = (low_ - rest) / across, other = (high_ - rest) / across;
    return Interval{std::min(one, other), std::max(one, other)};
  }
  const std::vector<Hit> found = hits(*outline_, axis, at - inclusion_->centre[axis]);
  if (found.empty()) return std::nullopt;
  Interval covered{infinity, -infinity};
  for (const Hit& hit : found) {
    const double x = outline_->arcs[hit.arc].at(hit.s)[1 - axis] + inclusion_->centre[1 - axis];
    covered = {std::min(covered.low, x), std::max(covered.high, x)};
  }
  return covered;
}

bool Body::contains(const Vector2& x) const {
  const Foot foot = nearest(x);
  return dot(x - foot.x, foot.normal) <= 0;
}

Foot Body::nearest(const Vector2& x) const {
  if (!inclusion_) {
    const double at = dot(n_, x);
    const bool low = at - low_ < high_ - at;
    return {x + ((low ? low_ : high_) - at) * n_, low ? -1.0 * n_ : n_, 0};
  }
  const Vector2 e = direction(inclusion_->angle), f = turned(e), rest = x - inclusion_->centre;
  const Vector2 local{dot(rest, e), dot(rest, f)};
  Foot foot = nearest_in_quarter(*inclusion_, {std::abs(local[0]), std::abs(local[1])});
  const auto back = [&](const Vector2& y) {
    return std::copysign(y[0], local[0]) * e + std::copysign(y[1], local[1]) * f;
  };
  // Components of the quarter are not negative, so that copysign turns them as it should.
  return {inclusion_->centre + back(foot.x), back(foot.normal), foot.curvature};
}

Interval Body::extent(int axis) const {
  if (!inclusion_) {
    if (n_[1 - axis] != 0) return {-infinity, infinity};
    const double one = low_ / n_[axis], other = high_ / n_[axis];
    return {std::min(one, other), std::max(one, other)};
  }
  const double reach = support(*inclusion_, axis == 0 ? Vector2{1, 0} : Vector2{0, 1});
  return {inclusion_->centre[axis] - reach, inclusion_->centre[axis] + reach};
}

}  // namespace slipscale::morphology
