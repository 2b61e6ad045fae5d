#pragma once

#include <gtest/gtest.h>

#include "reference_polygon.hpp"
#include "slipscale/morphology/placement.hpp"

namespace slipscale::testing_support {

inline constexpr double pi = std::numbers::pi, infinity = std::numeric_limits<double>::infinity();

/// Inclusions of 1 mm in a block of `size` times that, aside the origin; the gap is 2 % of the diameter.
inline Room room_of(double size) {
  Room room;
  room.block = {{2e-3, -1e-3}, {2e-3 + size * 1e-3, -1e-3 + 0.8 * size * 1e-3}};
  room.gap = 2e-5;
  room.clearance = 4e-5;
  return room;
}

enum class Sides { periodic, periodic_x, cut, inside, kept_out, channel };
inline constexpr Sides all_sides[] = {Sides::periodic, Sides::periodic_x, Sides::cut,
                                      Sides::inside,   Sides::kept_out,   Sides::channel};

inline Room room_with(Sides sides, double size) {
  Room room = room_of(size);
  room.periodic = {sides == Sides::periodic || sides == Sides::periodic_x || sides == Sides::channel,
                   sides == Sides::periodic};
  if (sides == Sides::inside || sides == Sides::channel) room.edge = Edge::inside;
  if (sides == Sides::kept_out) room.keep_out = 4e-4;
  return room;
}

inline Family family_of(Shape shape, double fraction) {
  Family family;
  family.region = "inclusion";
  family.shape = shape;
  family.fraction = fraction;
  family.diameter = 1e-3;
  if (shape == Shape::disc) return family;
  family.aspect = 2;
  family.rounding = 0.4;
  family.angle_deviation = infinity;
  return family;
}

inline constexpr int corners = 120;
/// A polygon with so many corners lies inside its outline by at most this, m.
inline const double inset = 0.5e-3 * std::pow(2 * pi / corners, 2) / 8;

struct Image {
  std::size_t inclusion;
  Vector2 centre;
  double radius;
  Polygon polygon;
};

/// The inclusions and all copies one period away.
inline std::vector<Image> all_images(const Placement& placement, const Room& room) {
  std::vector<Image> all;
  const int nx = room.periodic[0], ny = room.periodic[1];
  for (std::size_t k = 0; k < placement.inclusions.size(); ++k)
    for (int j = -ny; j <= ny; ++j)
      for (int i = -nx; i <= nx; ++i) {
        Inclusion image = placement.inclusions[k];
        image.centre[0] += i * room.block.width();
        image.centre[1] += j * room.block.height();
        all.push_back({k, image.centre, std::hypot(image.half_length, image.half_width),
                       reference_polygon(image, corners)});
      }
  return all;
}

/// Infinite when circles around the inclusions are more than .3 mm apart.
inline double brute_force_gap(const std::vector<Image>& images, std::size_t inclusions) {
  double nearest = infinity;
  const std::size_t copies = images.size() / inclusions;
  for (std::size_t first = 0; first < inclusions; ++first) {
    const Image& a = images[first * copies + copies / 2];
    for (const Image& b : images) {
      const double apart = std::hypot(a.centre[0] - b.centre[0], a.centre[1] - b.centre[1]);
      if (&a != &b && apart < a.radius + b.radius + 3e-4)
        nearest = std::min(nearest, distance(a.polygon, b.polygon));
    }
  }
  return nearest;
}

struct Extent {
  double low = infinity, high = -infinity;
};

inline Extent extent(const Polygon& polygon, int axis) {
  Extent found;
  for (const Vector2& x : polygon) {
    found.low = std::min(found.low, x[axis]);
    found.high = std::max(found.high, x[axis]);
  }
  return found;
}

/// No outline comes near to touching a side or a corner of the block.
inline void expect_clear(const Polygon& polygon, const Room& room) {
  const Box& block = room.block;
  const double clear = room.clearance - 2 * inset, wall = std::max(room.clearance, room.gap) - 1e-9;
  for (const int axis : {0, 1}) {
    const Extent found = extent(polygon, axis);
    const bool inside = !room.periodic[axis] && room.edge == Edge::inside;
    const bool layer = axis == 1 && room.keep_out > 0;
    for (const double side : {block.lower[axis], block.upper[axis]}) {
      EXPECT_GE(std::abs(found.low - side), clear);
      EXPECT_GE(std::abs(found.high - side), clear);
    }
    if (layer || inside) {
      EXPECT_GE(found.low, block.lower[axis] + (layer ? room.keep_out : 0) + wall);
    }
    if (inside) {
      EXPECT_LE(found.high, block.upper[axis] - wall);
    }
  }
  for (const double x : {block.lower[0], block.upper[0]})
    for (const double y : {block.lower[1], block.upper[1]}) EXPECT_GE(to_outline({x, y}, polygon), clear);
}

/// What holds of every placement, without the help of the code that made it.
inline void expect_sound(const Placement& placement, const Room& room) {
  const std::vector<Image> images = all_images(placement, room);
  const double brute = brute_force_gap(images, placement.inclusions.size());
  EXPECT_GE(brute, room.gap);
  EXPECT_GE(placement.smallest_gap, room.gap);
  if (brute < infinity) {
    EXPECT_NEAR(placement.smallest_gap, brute, 2 * inset);
  }
  for (const Image& image : images) {
    const bool own = image.centre == placement.inclusions[image.inclusion].centre;
    if (!own) continue;
    expect_clear(image.polygon, room);
    for (const int axis : {0, 1}) {
      const Extent found = extent(image.polygon, axis);
      EXPECT_LT(found.low, room.block.upper[axis]);
      EXPECT_GT(found.high, room.block.lower[axis]);
      if (!room.periodic[axis]) continue;
      EXPECT_GE(image.centre[axis], room.block.lower[axis]);
      EXPECT_LT(image.centre[axis], room.block.upper[axis]);
    }
  }
}

/// Area fraction by clipping fine polygons; they are too small by (2 pi / 120)² / 6 of their area.
inline double brute_force_fraction(const Placement& placement, const Room& room, int family) {
  double sum = 0;
  for (const Image& image : all_images(placement, room))
    if (placement.inclusions[image.inclusion].family == family)
      sum += polygon_area_in(room.block, image.polygon);
  return sum / (room.block.width() * room.block.height());
}

}  // namespace slipscale::testing_support
