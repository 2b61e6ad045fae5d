#pragma once

#include <array>
#include <vector>

#include "slipscale/morphology/inclusion.hpp"

namespace slipscale::morphology {

/// A smooth piece of an outline, counter-clockwise: a straight line start + s p with 0 <= s <= 1, or an arc
/// of a circle or an ellipse, start + p cos s + q sin s.
struct Arc {
  bool straight = false;
  Vector2 start{}, p{}, q{};
  double from = 0, to = 1;  ///< of the parameter s

  Vector2 at(double s) const;
  Vector2 slope(double s) const;  ///< derivative by s
  /// Integral of x × dx / 2 from s0 to s1, about the origin.
  double swept(double s0, double s1) const;
  double length_to(double s) const;          ///< from `from`, m
  double parameter_at(double length) const;  ///< inverse of length_to
  double curvature(double s) const;
};

/// The outline from the end of the long axis on, with the inclusion's centre as origin.
struct Outline {
  explicit Outline(const Inclusion& inclusion);
  std::array<Arc, 9> arcs;
  int count = 0;

 private:
  void add_line(const Vector2& from, const Vector2& to);
  void add_arc(const Vector2& centre, const Vector2& p, const Vector2& q, double from, double to);
};

struct Hit {
  int arc = 0;
  double s = 0;
};
/// Where the outline meets the line x[axis] = at. A point between two arcs may be found on both.
std::vector<Hit> hits(const Outline& outline, int axis, double at);

}  // namespace slipscale::morphology
