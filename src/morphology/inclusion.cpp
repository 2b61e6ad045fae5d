#include "slipscale/morphology/inclusion.hpp"

#include <algorithm>
#include <numbers>

#include "outline.hpp"
#include "plane.hpp"

namespace slipscale {

using namespace morphology;

double area(const Inclusion& inclusion) {
  const double a = inclusion.half_length, b = inclusion.half_width, r = inclusion.corner;
  switch (inclusion.shape) {
    case Shape::disc:
      return std::numbers::pi * a * a;
    case Shape::ellipse:
      return std::numbers::pi * a * b;
    case Shape::rectangle:
      break;
  }
  return 4 * a * b - (4 - std::numbers::pi) * r * r;
}

double support(const Inclusion& inclusion, const Vector2& n) {
  const double a = inclusion.half_length, b = inclusion.half_width, r = inclusion.corner;
  if (inclusion.shape == Shape::disc) return a;
  const Vector2 e = direction(inclusion.angle);
  const double along = dot(n, e), across = cross(n, e);
  if (inclusion.shape == Shape::ellipse) return std::sqrt(a * a * along * along + b * b * across * across);
  return (a - r) * std::abs(along) + (b - r) * std::abs(across) + r;
}

namespace {

/// Of the outline's parts in the box; about the inclusion's centre, like the box. By Green's theorem.
double swept_by_outline(const Outline& outline, const Box& box) {
  std::array<std::vector<double>, 9> cuts;
  for (int k = 0; k < outline.count; ++k) cuts[k] = {outline.arcs[k].from, outline.arcs[k].to};
  for (int axis = 0; axis < 2; ++axis)
    for (const double at : {box.lower[axis], box.upper[axis]})
      for (const Hit& hit : hits(outline, axis, at)) cuts[hit.arc].push_back(hit.s);
  double sum = 0;
  for (int k = 0; k < outline.count; ++k) {
    const Arc& arc = outline.arcs[k];
    std::ranges::sort(cuts[k]);
    for (std::size_t i = 0; i + 1 < cuts[k].size(); ++i) {
      const Vector2 middle = arc.at(0.5 * (cuts[k][i] + cuts[k][i + 1]));
      if (middle[0] > box.lower[0] && middle[0] < box.upper[0] && middle[1] > box.lower[1] &&
          middle[1] < box.upper[1])
        sum += arc.swept(cuts[k][i], cuts[k][i + 1]);
    }
  }
  return sum;
}

/// Of the part of the box's side x[axis] = at that lies in the outline.
double swept_by_side(const Outline& outline, const Box& box, int axis, double at) {
  const int along = 1 - axis;
  double low = box.upper[along], high = box.lower[along];
  for (const Hit& hit : hits(outline, axis, at)) {
    const double x = outline.arcs[hit.arc].at(hit.s)[along];
    low = std::min(low, x);
    high = std::max(high, x);
  }
  const double length = std::min(high, box.upper[along]) - std::max(low, box.lower[along]);
  const double distance = at == box.upper[axis] ? at : -at;
  return length > 0 ? 0.5 * distance * length : 0;
}

}  // namespace

double area_inside(const Inclusion& inclusion, const Box& box) {
  const Vector2 reach{support(inclusion, {1, 0}), support(inclusion, {0, 1})};
  bool whole = true;
  for (int axis = 0; axis < 2; ++axis) {
    const double low = inclusion.centre[axis] - reach[axis], high = inclusion.centre[axis] + reach[axis];
    if (high <= box.lower[axis] || low >= box.upper[axis]) return 0;
    whole = whole && low >= box.lower[axis] && high <= box.upper[axis];
  }
  if (whole) return area(inclusion);
  const Outline outline(inclusion);
  const Box about_centre{box.lower - inclusion.centre, box.upper - inclusion.centre};
  double sum = swept_by_outline(outline, about_centre);
  for (int axis = 0; axis < 2; ++axis)
    for (const double at : {about_centre.lower[axis], about_centre.upper[axis]})
      sum += swept_by_side(outline, about_centre, axis, at);
  return std::clamp(sum, 0.0, area(inclusion));
}

}  // namespace slipscale
