#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "slipscale/morphology/inclusion.hpp"

namespace slipscale::testing_support {

using Polygon = std::vector<Vector2>;

/// `count` points on the inclusion's outline, from its definition, counter-clockwise. The polygon lies inside
/// the outline, no further away from it than half_length (2 pi / count)² / 8.
inline Polygon reference_polygon(const Inclusion& inclusion, int count) {
  Polygon polygon;
  const double c = std::cos(inclusion.angle), s = std::sin(inclusion.angle);
  for (int k = 0; k < count; ++k) {
    // Half a step aside, so that no point of the rectangle lies between two of its corners' arcs.
    const double phi = 2 * std::numbers::pi * (k + 0.5) / count, cosine = std::cos(phi), sine = std::sin(phi);
    const double a = inclusion.half_length, b = inclusion.half_width, r = inclusion.corner;
    double x = a * cosine, y = b * sine;
    if (inclusion.shape == Shape::rectangle) {
      x = std::copysign(a - r, cosine) + r * cosine;
      y = std::copysign(b - r, sine) + r * sine;
    }
    polygon.push_back({inclusion.centre[0] + c * x - s * y, inclusion.centre[1] + s * x + c * y});
  }
  return polygon;
}

inline double to_segment(const Vector2& x, const Vector2& a, const Vector2& b) {
  const Vector2 ab{b[0] - a[0], b[1] - a[1]}, ax{x[0] - a[0], x[1] - a[1]};
  const double t = std::clamp((ab[0] * ax[0] + ab[1] * ax[1]) / (ab[0] * ab[0] + ab[1] * ab[1]), 0.0, 1.0);
  return std::hypot(ax[0] - t * ab[0], ax[1] - t * ab[1]);
}

inline double to_outline(const Vector2& x, const Polygon& polygon) {
  double nearest = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < polygon.size(); ++k)
    nearest = std::min(nearest, to_segment(x, polygon[k], polygon[(k + 1) % polygon.size()]));
  return nearest;
}

inline bool contains(const Polygon& polygon, const Vector2& x) {
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vector2 &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    if ((b[0] - a[0]) * (x[1] - a[1]) <= (b[1] - a[1]) * (x[0] - a[0])) return false;
  }
  return true;
}

/// Distance of two convex polygons; 0 where a corner of one lies in the other.
inline double distance(const Polygon& a, const Polygon& b) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const Vector2& x : a) nearest = contains(b, x) ? 0 : std::min(nearest, to_outline(x, b));
  for (const Vector2& x : b) nearest = contains(a, x) ? 0 : std::min(nearest, to_outline(x, a));
  return nearest;
}

/// Distance of two polygons' shadows along a direction.
inline double shadow_distance(const Polygon& a, const Polygon& b, const Vector2& n) {
  double end = -std::numeric_limits<double>::infinity(), start = -end;
  for (const Vector2& x : a) end = std::max(end, n[0] * x[0] + n[1] * x[1]);
  for (const Vector2& x : b) start = std::min(start, n[0] * x[0] + n[1] * x[1]);
  return start - end;
}

/// The part of a polygon with sign (x[axis] - at) >= 0 (Sutherland and Hodgman 1974).
inline Polygon clipped(const Polygon& polygon, int axis, double at, double sign) {
  Polygon part;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vector2 &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    const double before = sign * (a[axis] - at), after = sign * (b[axis] - at);
    if (before >= 0) part.push_back(a);
    if ((before < 0) != (after < 0)) {
      const double t = before / (before - after);
      part.push_back({a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1])});
    }
  }
  return part;
}

inline double polygon_area_in(const Box& box, Polygon polygon) {
  for (int axis = 0; axis < 2; ++axis) {
    polygon = clipped(polygon, axis, box.lower[axis], 1);
    polygon = clipped(polygon, axis, box.upper[axis], -1);
  }
  double twice = 0;
  for (std::size_t k = 0; k < polygon.size(); ++k) {
    const Vector2 &a = polygon[k], &b = polygon[(k + 1) % polygon.size()];
    twice += a[0] * b[1] - a[1] * b[0];
  }
  return 0.5 * twice;
}

}  // namespace slipscale::testing_support
