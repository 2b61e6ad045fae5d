#include "outline.hpp"

#include <algorithm>
#include <numbers>

#include "plane.hpp"

namespace slipscale {
namespace morphology {

Outline::Outline(const Inclusion& inclusion) {
  constexpr double turn = 2 * std::numbers::pi;
  const Vector2 e = direction(inclusion.angle), f = turned(e);
  const double a = inclusion.half_length, b = inclusion.half_width, r = inclusion.corner;
  if (inclusion.shape != Shape::rectangle) {
    add_arc({}, a * e, (inclusion.shape == Shape::disc ? a : b) * f, 0, turn);
    return;
  }
  const auto local = [&](double x, double y) { return x * e + y * f; };
  const auto add_corner = [&](double x, double y, int quarter) {
    add_arc(local(x, y), r * e, r * f, quarter * turn / 4, (quarter + 1) * turn / 4);
  };
  const double x = a - r, y = b - r;
  add_line(local(a, 0), local(a, y));
  add_corner(x, y, 0);
  add_line(local(x, b), local(-x, b));
  add_corner(-x, y, 1);
  add_line(local(-a, y), local(-a, -y));
  add_corner(-x, -y, 2);
  add_line(local(-x, -b), local(x, -b));
  add_corner(x, -y, 3);
  add_line(local(a, -y), local(a, 0));
}

void Outline::add_line(const Vector2& from, const Vector2& to) {
  if (norm(to - from) > 0) arcs[count++] = {true, from, to - from, {}, 0, 1};
}

void Outline::add_arc(const Vector2& centre, const Vector2& p, const Vector2& q, double from, double to) {
  if (norm(p) > 0) arcs[count++] = {false, centre, p, q, from, to};
}

std::vector<Hit> hits(const Outline& outline, int axis, double at) {
  // So that rounding loses no point between two arcs; one too many does no harm.
  constexpr double reach = 1e-12, turn = 2 * std::numbers::pi;
  std::vector<Hit> found;
  for (int k = 0; k < outline.count; ++k) {
    const Arc& arc = outline.arcs[k];
    const auto add = [&](double s) {
      if (s > arc.from - reach && s < arc.to + reach) found.push_back({k, std::clamp(s, arc.from, arc.to)});
    };
    const double rest = at - arc.start[axis], p = arc.p[axis], q = arc.q[axis];
    if (arc.straight) {
      if (p != 0) add(rest / p);
      continue;
    }
    const double amplitude = std::hypot(p, q);
    if (std::abs(rest) > amplitude) continue;
    const double middle = std::atan2(q, p), half = std::acos(rest / amplitude);
    for (const double s : {middle - half, middle + half})
      for (const double whole : {-turn, 0.0, turn}) add(s + whole);
  }
  return found;
}

namespace {

double length(const Arc& arc) { return arc.length_to(arc.to); }

double length(const Outline& outline) {
  double sum = 0;
  for (int k = 0; k < outline.count; ++k) sum += length(outline.arcs[k]);
  return sum;
}

}  // namespace
}  // namespace morphology

using namespace morphology;

double perimeter(const Inclusion& inclusion) { return length(Outline(inclusion)); }

OutlinePoint outline(const Inclusion& inclusion, double t) {
  const Outline whole(inclusion);
  double rest = (t - std::floor(t)) * length(whole);
  int k = 0;
  for (; k + 1 < whole.count && rest > length(whole.arcs[k]); ++k) rest -= length(whole.arcs[k]);
  const Arc& arc = whole.arcs[k];
  const double s = std::min(arc.parameter_at(rest), arc.to);
  return {inclusion.centre + arc.at(s), -1.0 * turned(unit(arc.slope(s))), arc.curvature(s)};
}

std::vector<double> crossings(const Inclusion& inclusion, int axis, double at) {
  const Outline whole(inclusion);
  std::vector<double> before{0};
  for (int k = 0; k < whole.count; ++k) before.push_back(before.back() + length(whole.arcs[k]));
  std::vector<double> found;
  for (const Hit& hit : hits(whole, axis, at - inclusion.centre[axis])) {
    const double t = (before[hit.arc] + whole.arcs[hit.arc].length_to(hit.s)) / before.back();
    found.push_back(t < 1 ? t : 0);
  }
  std::ranges::sort(found);
  constexpr double same = 1e-10;
  const auto repeated = std::ranges::unique(found, [](double a, double b) { return b - a < same; });
  found.erase(repeated.begin(), repeated.end());
  if (found.size() > 2 && found.front() + 1 - found.back() < same) found.pop_back();
  if (found.size() != 2) found.clear();
  return found;
}

}  // namespace slipscale
