#include <algorithm>
#include <numbers>

#include "outline.hpp"
#include "plane.hpp"

namespace slipscale::morphology {
namespace {

constexpr double quarter_turn = std::numbers::pi / 2;

/// Arc length of the ellipse (a cos s, b sin s), a >= b, from s = 0: elliptic integrals of the second kind.
class EllipseLength {
 public:
  EllipseLength(double a, double b)
      : a_(a), modulus_(std::sqrt((1 - b / a) * (1 + b / a))), quarter_(a * std::comp_ellint_2(modulus_)) {}

  double to(double s) const {
    const double quarters = std::floor(s / quarter_turn), rest = s - quarters * quarter_turn;
    const bool even = std::fmod(quarters, 2) == 0;
    return even ? quarters * quarter_ + in_quarter(rest)
                : (quarters + 1) * quarter_ - in_quarter(quarter_turn - rest);
  }

  double inverse(double length) const {
    const double quarters = std::floor(length / quarter_), rest = length - quarters * quarter_;
    const bool even = std::fmod(quarters, 2) == 0;
    return even ? quarters * quarter_turn + quarter_inverse(rest)
                : (quarters + 1) * quarter_turn - quarter_inverse(quarter_ - rest);
  }

 private:
  double in_quarter(double s) const { return quarter_ - a_ * std::ellint_2(modulus_, quarter_turn - s); }

  /// Newton's method. The length is a convex function of s, so that every step but the first comes from
  /// above.
  double quarter_inverse(double length) const {
    double s = quarter_turn * length / quarter_;
    for (int i = 0; i < 50; ++i) {
      const double cosine = modulus_ * std::cos(s);
      const double step = (in_quarter(s) - length) / (a_ * std::sqrt((1 - cosine) * (1 + cosine)));
      s = std::clamp(s - step, 0.0, quarter_turn);
      if (std::abs(step) < 1e-13) break;
    }
    return s;
  }

  double a_, modulus_, quarter_;
};

}  // namespace

Vector2 Arc::at(double s) const {
  return straight ? start + s * p : start + std::cos(s) * p + std::sin(s) * q;
}

Vector2 Arc::slope(double s) const { return straight ? p : std::cos(s) * q - std::sin(s) * p; }

double Arc::swept(double s0, double s1) const {
  if (straight) return 0.5 * (s1 - s0) * cross(start, p);
  return 0.5 * (cross(start, at(s1) - at(s0)) + (s1 - s0) * cross(p, q));
}

double Arc::length_to(double s) const {
  const double a = norm(p), b = norm(q);
  if (straight || a - b <= 1e-14 * a) return a * (s - from);
  return EllipseLength(a, b).to(s);
}

double Arc::parameter_at(double length) const {
  const double a = norm(p), b = norm(q);
  if (straight || a - b <= 1e-14 * a) return from + length / a;
  return EllipseLength(a, b).inverse(length);
}

double Arc::curvature(double s) const {
  if (straight) return 0;
  return cross(p, q) / std::pow(norm(slope(s)), 3);
}

}  // namespace slipscale::morphology
