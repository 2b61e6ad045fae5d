#include "slipscale/morphology/inclusion.hpp"

#include <gtest/gtest.h>

#include <random>

#include "reference_polygon.hpp"

using namespace slipscale;
using namespace slipscale::testing_support;

namespace {

constexpr double pi = std::numbers::pi;

Inclusion disc(double radius, const Vector2& centre = {}) {
  return {Shape::disc, centre, radius, radius, 0, 0, 0};
}

Inclusion ellipse(double a, double b, double angle = 0, const Vector2& centre = {}) {
  return {Shape::ellipse, centre, a, b, 0, angle, 0};
}

Inclusion rectangle(double a, double b, double corner, double angle = 0, const Vector2& centre = {}) {
  return {Shape::rectangle, centre, a, b, corner, angle, 0};
}

/// All shapes with long axes of about 2, aspects up to 20 and corners up to the full half width.
class Shapes {
 public:
  Inclusion next(Shape shape, double spread) {
    const double b = shape == Shape::disc ? 1 : 1 / (1 + 19 * uniform() * uniform());
    const double corner = shape == Shape::rectangle ? b * (0.05 + 0.95 * uniform()) : 0;
    const double angle = shape == Shape::disc ? 0 : 2 * pi * uniform();
    return {shape, {spread * uniform(), spread * uniform()}, 1, b, corner, angle, 0};
  }
  double uniform() { return std::uniform_real_distribution<double>()(engine_); }

 private:
  std::mt19937 engine_{7};
};

constexpr Shape all_shapes[] = {Shape::disc, Shape::ellipse, Shape::rectangle};

std::vector<Inclusion> samples(int of_each) {
  Shapes shapes;
  std::vector<Inclusion> all;
  for (const Shape shape : all_shapes)
    for (int k = 0; k < of_each; ++k) all.push_back(shapes.next(shape, 1));
  all.push_back(rectangle(1, 1, 1));
  all.push_back(rectangle(1, 0.4, 0.4, 1));
  return all;
}

}  // namespace

/// Closed forms; the perimeter of the ellipse with half axes 2 and 1 is 8 E(sqrt(3)/2) = 9.68844822054768
/// (Abramowitz and Stegun, table 17.1).
TEST(Inclusion, HasItsAreaAndPerimeter) {
  EXPECT_DOUBLE_EQ(area(disc(2)), 4 * pi);
  EXPECT_DOUBLE_EQ(perimeter(disc(2)), 4 * pi);
  EXPECT_DOUBLE_EQ(area(ellipse(2, 1, 0.3)), 2 * pi);
  EXPECT_NEAR(perimeter(ellipse(2, 1, 0.3)), 9.68844822054768, 1e-13);
  EXPECT_DOUBLE_EQ(area(rectangle(2, 1, 0.5, 0.3)), 8 - (4 - pi) * 0.25);
  EXPECT_DOUBLE_EQ(perimeter(rectangle(2, 1, 0.5, 0.3)), 12 - (8 - 2 * pi) * 0.5);
  EXPECT_NEAR(area(rectangle(1, 1, 1)), pi, 1e-14);
}

/// The sides of a rectangle that is a disc have no length.
TEST(Inclusion, IsADiscWhenItsCornersMeet) {
  const Inclusion round = rectangle(1, 1, 1, 0, {0.2, 0.1});
  for (const double t : {0.0, 0.1, 0.25, 0.6, 0.999}) {
    const OutlinePoint on = outline(round, t), expected = outline(disc(1, {0.2, 0.1}), t);
    for (int axis = 0; axis < 2; ++axis) {
      EXPECT_NEAR(on.x[axis], expected.x[axis], 1e-14);
      EXPECT_NEAR(on.normal[axis], expected.normal[axis], 1e-14);
    }
    EXPECT_NEAR(on.curvature, 1, 1e-14);
  }
}

/// A point of a convex outline with normal n is the farthest along n.
TEST(Inclusion, OutlineIsWhereTheSupportIs) {
  for (const Inclusion& inclusion : samples(20))
    for (int k = 0; k < 100; ++k) {
      const OutlinePoint on = outline(inclusion, k / 100.0);
      const Vector2 from{on.x[0] - inclusion.centre[0], on.x[1] - inclusion.centre[1]};
      EXPECT_NEAR(std::hypot(on.normal[0], on.normal[1]), 1, 1e-14);
      EXPECT_NEAR(from[0] * on.normal[0] + from[1] * on.normal[1], support(inclusion, on.normal), 1e-13);
    }
}

/// t is the part of the perimeter gone: for ellipses, of aspects up to 20, Simpson's rule along the parameter
/// with 20000 intervals, which is exact to 1e-12.
TEST(Inclusion, OutlineOfAnEllipseGoesByArcLength) {
  Shapes shapes;
  for (int k = 0; k < 10; ++k) {
    const Inclusion inclusion = shapes.next(Shape::ellipse, 1);
    const double a = inclusion.half_length, b = inclusion.half_width;
    const auto length_to = [&](double end) {
      const int n = 20000;
      double sum = 0;
      for (int i = 0; i <= n; ++i) {
        const double phi = end * i / n, weight = i == 0 || i == n ? 1 : i % 2 ? 4 : 2;
        sum += weight * std::hypot(a * std::sin(phi), b * std::cos(phi));
      }
      return sum * end / n / 3;
    };
    const double whole = length_to(2 * pi);
    EXPECT_NEAR(perimeter(inclusion), whole, 1e-10 * whole);
    for (const double t : {1e-6, 0.013, 0.25, 0.4, 0.5, 0.77, 0.9999}) {
      const OutlinePoint on = outline(inclusion, t);
      const double c = std::cos(inclusion.angle), s = std::sin(inclusion.angle);
      const double x = on.x[0] - inclusion.centre[0], y = on.x[1] - inclusion.centre[1];
      double phi = std::atan2((c * y - s * x) / b, (c * x + s * y) / a);
      if (phi < 0) phi += 2 * pi;
      EXPECT_NEAR(length_to(phi) / whole, t, 1e-10) << "aspect " << a / b;
    }
  }
}

/// Of a rectangle with half axes 2 and 1 and corners of 1/2: the outline begins with half a short side.
TEST(Inclusion, OutlineOfARectangleGoesByArcLength) {
  const Inclusion inclusion = rectangle(2, 1, 0.5);
  const double whole = 8 + pi;
  const auto expect_at = [&](double length, double x, double y) {
    const OutlinePoint on = outline(inclusion, length / whole);
    EXPECT_NEAR(on.x[0], x, 1e-14);
    EXPECT_NEAR(on.x[1], y, 1e-14);
  };
  expect_at(0.2, 2, 0.2);
  expect_at(0.5 + pi / 8, 1.5 + std::sqrt(0.125), 0.5 + std::sqrt(0.125));
  expect_at(0.5 + pi / 4 + 1, 0.5, 1);
  expect_at(0.5 * whole, -2, 0);
  expect_at(whole - 0.2, 2, -0.2);
}

/// The normal turns by the curvature per length; central difference, of second order.
TEST(Inclusion, CurvatureIsTheTurnOfTheNormal) {
  for (const Inclusion& inclusion : samples(10))
    for (int k = 0; k < 50; ++k) {
      const double t = (k + 0.123) / 50, step = 1e-6;
      const OutlinePoint before = outline(inclusion, t - step), on = outline(inclusion, t),
                         after = outline(inclusion, t + step);
      // Where a side ends in a corner, the curvature jumps.
      if (before.curvature == 0 || after.curvature == 0) continue;
      const double turn = before.normal[0] * after.normal[1] - before.normal[1] * after.normal[0];
      EXPECT_NEAR(turn / (2 * step * perimeter(inclusion)) / on.curvature, 1, 1e-5);
    }
}

TEST(Inclusion, CrossesALineTwiceOrNotAtAll) {
  Shapes shapes;
  for (const Inclusion& inclusion : samples(30))
    for (const int axis : {0, 1})
      for (int k = 0; k < 10; ++k) {
        const double reach = support(inclusion, axis == 0 ? Vector2{1, 0} : Vector2{0, 1});
        const double at = inclusion.centre[axis] + 1.5 * reach * (2 * shapes.uniform() - 1);
        const std::vector<double> found = crossings(inclusion, axis, at);
        ASSERT_EQ(found.size(), std::abs(at - inclusion.centre[axis]) < reach ? 2u : 0u);
        if (found.empty()) continue;
        EXPECT_LT(found[0], found[1]);
        for (const double t : found) {
          EXPECT_TRUE(t >= 0 && t < 1);
          EXPECT_NEAR(outline(inclusion, t).x[axis], at, 1e-12);
        }
      }
}

/// Lines through the seams of the outline: its beginning, and where sides end in corners.
TEST(Inclusion, CrossesALineAtItsSeams) {
  EXPECT_EQ(crossings(disc(1), 1, 0), (std::vector<double>{0, 0.5}));
  const auto through_middle = crossings(ellipse(2, 1, pi / 2), 0, 0);
  ASSERT_EQ(through_middle.size(), 2u);
  EXPECT_NEAR(through_middle[1] - through_middle[0], 0.5, 1e-12);
  for (const double at : {-1.5, 1.5}) EXPECT_EQ(crossings(rectangle(2, 1, 0.5), 0, at).size(), 2u);
  for (const double at : {-0.5, 0.0, 0.5}) EXPECT_EQ(crossings(rectangle(2, 1, 0.5), 1, at).size(), 2u);
}

/// Half, quarter and a segment of the disc, r² (α - sin α cos α) with cos α = h / r; the same of the ellipse,
/// which is a disc stretched along x.
TEST(Inclusion, AreaInsideIsThatOfSegments) {
  const double far = 10, segment = std::acos(0.3) - 0.3 * std::sqrt(1 - 0.09);
  for (const double a : {1.0, 3.0}) {
    const Inclusion inclusion = a == 1 ? disc(1, {2, 3}) : ellipse(a, 1, 0, {2, 3});
    const auto inside = [&](const Vector2& low, const Vector2& high) {
      return area_inside(inclusion, {{2 + a * low[0], 3 + low[1]}, {2 + a * high[0], 3 + high[1]}}) / a;
    };
    EXPECT_DOUBLE_EQ(inside({-far, -far}, {far, far}), pi);
    EXPECT_NEAR(inside({0, -far}, {far, far}), pi / 2, 1e-14);
    EXPECT_NEAR(inside({-far, -far}, {far, 0}), pi / 2, 1e-14);
    EXPECT_NEAR(inside({0, 0}, {far, far}), pi / 4, 1e-14);
    EXPECT_NEAR(inside({0.3, -far}, {far, far}), segment, 1e-14);
    EXPECT_NEAR(inside({-far, -far}, {far, -0.3}), segment, 1e-14);
    EXPECT_NEAR(inside({-0.3, -far}, {0.3, far}), pi - 2 * segment, 1e-14);
    EXPECT_NEAR(inside({-0.1, -0.1}, {0.3, 0.4}), 0.2, 1e-14);
    EXPECT_EQ(inside({1.5, -far}, {far, far}), 0);
    EXPECT_EQ(inside({0.9, 0.9}, {far, far}), 0);
  }
}

/// The polygon has 200000 corners; its area is smaller by less than (2 pi / 200000)² / 6, that is 2e-10.
TEST(Inclusion, AreaInsideIsThatOfAFinePolygon) {
  Shapes shapes;
  for (const Inclusion& inclusion : samples(6)) {
    const Polygon polygon = reference_polygon(inclusion, 200000);
    for (int k = 0; k < 3; ++k) {
      const Vector2 low{2 * shapes.uniform() - 1, 2 * shapes.uniform() - 1};
      const Box box{low, {low[0] + 2 * shapes.uniform(), low[1] + 2 * shapes.uniform()}};
      EXPECT_NEAR(area_inside(inclusion, box), polygon_area_in(box, polygon), 1e-9 * area(inclusion));
    }
  }
}

TEST(Inclusion, SeparationOfDiscs) {
  Vector2 normal;
  EXPECT_DOUBLE_EQ(separation(disc(1), disc(0.5, {3, 4}), &normal), 3.5);
  EXPECT_DOUBLE_EQ(normal[0], 0.6);
  EXPECT_DOUBLE_EQ(normal[1], 0.8);
  EXPECT_DOUBLE_EQ(separation(disc(4), disc(2, {3, 4})), -1);
  EXPECT_DOUBLE_EQ(separation(disc(1), disc(0, {3, 4})), 4);
}

/// Two squares corner to corner, side to side, overlapping, and in one another.
TEST(Inclusion, SeparationOfSquares) {
  const auto square = [](double x, double y, double angle = 0) { return rectangle(1, 1, 0, angle, {x, y}); };
  EXPECT_NEAR(separation(square(0, 0), square(5, 6)), 5, 1e-14);
  EXPECT_NEAR(separation(square(0, 0), square(5, 1)), 3, 1e-14);
  EXPECT_NEAR(separation(square(0, 0), square(1.5, 1)), -0.5, 1e-14);
  EXPECT_NEAR(separation(square(0, 0), square(4, 0, pi / 4)), 3 - std::sqrt(2), 1e-14);
  Vector2 normal;
  EXPECT_NEAR(separation(square(0, 0), square(0.1, 0.2), &normal), -1.8, 1e-14);
  EXPECT_NEAR(normal[1], 1, 1e-14);
}

/// Brute force. Apart: the distance of polygons with 1000 corners, which lie inside the outlines by at most
/// 5e-6 each. Overlapping: the best of 10000 directions, in which the polygons' shadows overlap least; the
/// direction is wrong by at most 3.2e-4 radian, and the shadows move by at most 5 per radian.
TEST(Inclusion, SeparationIsThatOfFinePolygons) {
  Shapes shapes;
  int apart = 0, overlapping = 0;
  for (int k = 0; k < 54; ++k) {
    const Inclusion a = shapes.next(all_shapes[k % 3], 3.5), b = shapes.next(all_shapes[k / 3 % 3], 3.5);
    const double s = separation(a, b);
    const Polygon pa = reference_polygon(a, 1000), pb = reference_polygon(b, 1000);
    if (s > 0) {
      ++apart;
      const double brute = distance(pa, pb);
      EXPECT_GE(brute, s - 1e-12);
      EXPECT_LE(brute, s + 1e-5);
      continue;
    }
    ++overlapping;
    double brute = -10;
    for (int i = 0; i < 10000; ++i) {
      const double angle = 2 * pi * i / 10000;
      brute = std::max(brute, shadow_distance(pa, pb, {std::cos(angle), std::sin(angle)}));
    }
    EXPECT_LE(brute, s + 1e-5);
    EXPECT_GE(brute, s - 5 * 3.2e-4);
  }
  EXPECT_GE(apart, 15);
  EXPECT_GE(overlapping, 15);
}

/// The supports on both sides are as far apart as the separation says, in the direction that it gives, and
/// the same the other way round.
TEST(Inclusion, SeparationHasANormalAndIsSymmetric) {
  Shapes shapes;
  for (int k = 0; k < 3000; ++k) {
    const Inclusion a = shapes.next(all_shapes[k % 3], 3), b = shapes.next(all_shapes[k / 3 % 3], 3);
    Vector2 n;
    const double s = separation(a, b, &n);
    const Vector2 between{b.centre[0] - a.centre[0], b.centre[1] - a.centre[1]};
    EXPECT_NEAR(std::hypot(n[0], n[1]), 1, 1e-14);
    EXPECT_NEAR(n[0] * between[0] + n[1] * between[1] - support(a, n) - support(b, {-n[0], -n[1]}), s, 1e-13);
    EXPECT_NEAR(separation(b, a), s, 1e-12);
  }
}
