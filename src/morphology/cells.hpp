#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "slipscale/morphology/inclusion.hpp"

namespace slipscale::morphology {

/// A rectangle that may close on itself along x, y.
struct Domain {
  Box box;
  std::array<bool, 2> periodic{};

  double extent(int axis) const { return box.upper[axis] - box.lower[axis]; }
  /// The image of x that lies in the box; x itself along axes that do not close.
  Vector2 wrapped(Vector2 x) const {
    for (int axis = 0; axis < 2; ++axis)
      if (periodic[axis]) x[axis] -= std::floor((x[axis] - box.lower[axis]) / extent(axis)) * extent(axis);
    return x;
  }
};

/// Finds circles near a place. A circle is entered in every cell that it may touch, so that small circles
/// stay quick to find beside large ones.
class Cells {
 public:
  Cells(const Domain& domain, double size);
  void clear();
  void add(int index, const Vector2& centre, double radius);

  /// Calls visit(index, shift) once for every circle and image of a circle, moved by `shift`, whose box
  /// touches that of the circle around x.
  template <class Visit>
  void near(const Vector2& x, double radius, Visit&& visit) const {
    const Span at = span(x, radius);
    for (int j = at.low[1]; j <= at.high[1]; ++j)
      for (int i = at.low[0]; i <= at.high[0]; ++i) {
        const Place place = placed({i, j});
        for (const Entry& entry : entries_[place.cell]) {
          const std::array<int, 2> turns{place.turns[0] - entry.turns[0], place.turns[1] - entry.turns[1]};
          // Circle and image may share several cells; the first of them counts.
          if (i != std::max(at.low[0], entry.low[0] + turns[0] * count_[0]) ||
              j != std::max(at.low[1], entry.low[1] + turns[1] * count_[1]))
            continue;
          visit(entry.index, Vector2{turns[0] * domain_.extent(0), turns[1] * domain_.extent(1)});
        }
      }
  }

 private:
  struct Span {
    std::array<int, 2> low, high;
  };
  struct Place {
    std::size_t cell;
    std::array<int, 2> turns;  ///< how often the domain was gone around to come to the cell
  };
  struct Entry {
    int index;
    std::array<int, 2> turns, low;
  };

  Span span(const Vector2& x, double radius) const;
  Place placed(std::array<int, 2> cell) const;

  Domain domain_;
  std::array<int, 2> count_{};
  std::vector<std::vector<Entry>> entries_;
};

}  // namespace slipscale::morphology
