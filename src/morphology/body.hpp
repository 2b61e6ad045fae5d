#pragma once

#include <optional>
#include <vector>

#include "outline.hpp"
#include "slipscale/morphology/placement.hpp"

namespace slipscale::morphology {

/// A point of an interface.
struct Foot {
  Vector2 x, normal;     ///< m; out of the body, of unit length
  double curvature = 0;  ///< 1/m
};

struct Interval {
  double low, high;  ///< m
};

/// A convex part of a composite as a grid meets it: an inclusion, one of its images, or a layer.
class Body {
 public:
  /// `part` is the inclusion that it shows; images show the same.
  Body(const Inclusion& inclusion, int part);
  /// The layer low <= n·x <= high, n of unit length.
  Body(const Vector2& n, double low, double high, int part);

  int part() const { return part_; }
  int region() const { return region_; }

  /// What the body covers of the line x[axis] = at, in the other coordinate; infinite along a layer.
  std::optional<Interval> covers(int axis, double at) const;
  bool contains(const Vector2& x) const;
  /// The point of the interface nearest to x.
  Foot nearest(const Vector2& x) const;
  /// The smallest box around it along an axis; infinite along a layer.
  Interval extent(int axis) const;

 private:
  int part_, region_;
  std::optional<Inclusion> inclusion_;
  std::optional<Outline> outline_;
  Vector2 n_{};
  double low_ = 0, high_ = 0;
};

}  // namespace slipscale::morphology
