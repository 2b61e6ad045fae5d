#pragma once

#include <vector>

#include "slipscale/base/box.hpp"
#include "slipscale/base/vector2.hpp"

namespace slipscale {

enum class Shape { disc, ellipse, rectangle };

/// One convex inclusion as it is drawn: a disc, an ellipse, or a rectangle with rounded corners (a fibre tow
/// seen from the side or the end). Lengths in m.
struct Inclusion {
  Shape shape = Shape::disc;
  Vector2 centre{};
  double half_length = 0;  ///< half of the long axis; the radius of a disc
  double half_width = 0;   ///< half of the short axis, <= half_length; the radius of a disc
  double corner = 0;       ///< corner radius of a rectangle, 0 < corner <= half_width
  double angle = 0;        ///< of the long axis from x, radian
  int family = 0;          ///< index into Recipe::families
};

double area(const Inclusion& inclusion);  ///< m²

/// Largest n·(x − centre) over the inclusion for a unit vector n, m.
double support(const Inclusion& inclusion, const Vector2& n);

/// Distance between two inclusions along the best separating direction: negative when they overlap, then
/// minus the shortest way apart. `normal` (unit, from a to b) is that direction.
double separation(const Inclusion& a, const Inclusion& b, Vector2* normal = nullptr);

/// The outline at t in [0, 1), counter-clockwise from the end of the long axis; t is proportional to arc
/// length. `curvature` in 1/m, `normal` outward and of unit length.
struct OutlinePoint {
  Vector2 x, normal;
  double curvature;
};
OutlinePoint outline(const Inclusion& inclusion, double t);
double perimeter(const Inclusion& inclusion);  ///< m

/// Values of t, ascending, at which the outline crosses the line x[axis] = at; none, or two.
std::vector<double> crossings(const Inclusion& inclusion, int axis, double at);

/// Area of the part of the inclusion that lies in the box, m²; to 1e-9 of the inclusion's area.
double area_inside(const Inclusion& inclusion, const Box& box);

}  // namespace slipscale
