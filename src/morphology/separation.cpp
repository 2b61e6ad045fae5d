#include "separation.hpp"

#include <array>
#include <limits>
#include <numbers>

#include "plane.hpp"

namespace slipscale {
namespace morphology {
namespace {

/// The function whose largest value over unit vectors n is the separation:
/// n·d - r - sum |n·v| - sum sqrt((n·p)² + (n·q)²), with d from centre to centre, r the radii of discs and
/// corners, v the straight halves of rectangles, p and q the half axes of ellipses.
class Clearance {
 public:
  Clearance(const Inclusion& a, const Inclusion& b) : between_(b.centre - a.centre) {
    for (const Inclusion* inclusion : {&a, &b}) add(*inclusion);
  }

  const Vector2& between() const { return between_; }
  bool polygons() const { return ellipse_count_ == 0; }

  double along(const Vector2& n) const {
    double sum = dot(n, between_) - radii_;
    for (int k = 0; k < halves_count_; ++k) sum -= std::abs(dot(n, halves_[k]));
    for (int k = 0; k < ellipse_count_; ++k) {
      const double p = dot(n, ellipses_[k][0]), q = dot(n, ellipses_[k][1]);
      sum -= std::sqrt(p * p + q * q);
    }
    return sum;
  }

  void try_along(const Vector2& n) {
    const double s = along(n);
    if (s > best_) {
      best_ = s;
      normal_ = n;
    }
  }

  /// Tries the directions between the centres, across the flats, and out of the corners of the sum of both
  /// rectangles. There are no others to try where no ellipse is involved.
  void try_flats_and_corners() {
    try_along(norm(between_) > 0 ? unit(between_) : Vector2{1, 0});
    for (int k = 0; k < halves_count_; ++k) {
      if (norm(halves_[k]) == 0) continue;
      const Vector2 across = unit(turned(halves_[k]));
      try_along(across);
      try_along(-1.0 * across);
    }
    for (int signs = 0; signs < 1 << halves_count_; ++signs) {
      Vector2 out = between_;
      for (int k = 0; k < halves_count_; ++k) out = out + (signs >> k & 1 ? 1.0 : -1.0) * halves_[k];
      if (norm(out) > 0) try_along(unit(out));
    }
  }

  /// Normals of each ellipse all around, which are dense where it is curved, and directions all around.
  void try_all_around() {
    for (int ring = ellipse_count_ - 1; ring >= -1; --ring) {
      for (int k = 0; k < ring_size; ++k) {
        Vector2 n = around()[k];
        if (ring >= 0) {
          const auto& [p, q] = ellipses_[ring];
          const double a = norm(p), b = norm(q);
          n = unit((n[0] * b / a) * p + (n[1] * a / b) * q);
        }
        directions_[k] = n;
        values_[k] = along(n);
      }
      for (int k = 0; k < ring_size; ++k) {
        const int before = (k + ring_size - 1) % ring_size, after = (k + 1) % ring_size;
        if (values_[k] >= values_[before] && values_[k] > values_[after] &&
            !refined_between(directions_[before], directions_[after]))
          refine(directions_[before], directions_[after]);
      }
    }
  }

  double best() const { return best_; }
  const Vector2& normal() const { return normal_; }

 private:
  static constexpr int ring_size = 24, most_refined = 16;

  static const std::array<Vector2, ring_size>& around() {
    static const std::array<Vector2, ring_size> directions = [] {
      std::array<Vector2, ring_size> all;
      for (int k = 0; k < ring_size; ++k) all[k] = direction(2 * std::numbers::pi * k / ring_size);
      return all;
    }();
    return directions;
  }

  void add(const Inclusion& inclusion) {
    const double a = inclusion.half_length, b = inclusion.half_width, r = inclusion.corner;
    if (inclusion.shape == Shape::disc) {
      radii_ += a;
      return;
    }
    const Vector2 e = direction(inclusion.angle), f = turned(e);
    if (inclusion.shape == Shape::ellipse) {
      ellipses_[ellipse_count_++] = {a * e, b * f};
      return;
    }
    radii_ += r;
    halves_[halves_count_++] = (a - r) * e;
    halves_[halves_count_++] = (b - r) * f;
  }

  bool refined_between(const Vector2& from, const Vector2& to) const {
    for (int k = 0; k < refined_count_; ++k)
      if (cross(from, refined_[k]) >= 0 && cross(refined_[k], to) >= 0) return true;
    return false;
  }

  /// Golden section between two directions. The value has an error of second order in that of the direction.
  void refine(const Vector2& from, const Vector2& to) {
    constexpr double golden = std::numbers::phi - 1;
    const auto between = [&](double t) { return unit((1 - t) * from + t * to); };
    double low = 0, high = 1, left = 1 - golden, right = golden;
    double at_left = along(between(left)), at_right = along(between(right));
    while (high - low > 1e-7) {
      if (at_left < at_right) {
        low = left;
        left = right;
        at_left = at_right;
        right = low + golden * (high - low);
        at_right = along(between(right));
      } else {
        high = right;
        right = left;
        at_right = at_left;
        left = high - golden * (high - low);
        at_left = along(between(left));
      }
    }
    const Vector2 n = between(0.5 * (low + high));
    if (refined_count_ < most_refined) refined_[refined_count_++] = n;
    try_along(n);
  }

  Vector2 between_;
  double radii_ = 0;
  std::array<Vector2, 4> halves_;
  std::array<std::array<Vector2, 2>, 2> ellipses_;
  int halves_count_ = 0, ellipse_count_ = 0;
  std::array<Vector2, ring_size> directions_;
  std::array<double, ring_size> values_;
  std::array<Vector2, most_refined> refined_;
  int refined_count_ = 0;
  double best_ = -std::numeric_limits<double>::infinity();
  Vector2 normal_{1, 0};
};

}  // namespace

double bounding_radius(const Inclusion& inclusion) {
  const double a = inclusion.half_length, b = inclusion.half_width, r = inclusion.corner;
  return inclusion.shape == Shape::rectangle ? r + norm({a - r, b - r}) : a;
}

double separation_within(double reach, const Inclusion& a, const Inclusion& b, Vector2* normal) {
  const double apart = norm(b.centre - a.centre) - bounding_radius(a) - bounding_radius(b);
  if (apart > reach) return apart;
  Clearance clearance(a, b);
  if (normal && *normal != Vector2{} && std::isfinite(reach)) {
    clearance.try_along(*normal);
    if (clearance.best() > reach) return clearance.best();
  }
  clearance.try_flats_and_corners();
  if (!clearance.polygons() && clearance.best() <= reach) clearance.try_all_around();
  if (normal) *normal = clearance.normal();
  return clearance.best();
}

}  // namespace morphology

double separation(const Inclusion& a, const Inclusion& b, Vector2* normal) {
  return morphology::separation_within(std::numeric_limits<double>::infinity(), a, b, normal);
}

}  // namespace slipscale
