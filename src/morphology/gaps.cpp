#include "gaps.hpp"

#include <limits>

#include "cells.hpp"
#include "plane.hpp"
#include "separation.hpp"

namespace slipscale::morphology {
namespace {

/// Smallest separation among those of less than `reach`.
double smallest_within(double reach, const std::vector<Inclusion>& inclusions, const Cells& cells) {
  double smallest = std::numeric_limits<double>::infinity();
  for (int a = 0; a < static_cast<int>(inclusions.size()); ++a) {
    const Inclusion& inclusion = inclusions[a];
    cells.near(inclusion.centre, bounding_radius(inclusion) + reach, [&](int b, const Vector2& shift) {
      if (b < a || (b == a && shift == Vector2{})) return;
      Inclusion other = inclusions[b];
      other.centre = other.centre + shift;
      smallest = std::min(smallest, separation_within(std::min(reach, smallest), inclusion, other));
    });
  }
  return smallest;
}

}  // namespace

double smallest_gap(const std::vector<Inclusion>& inclusions, const Room& room) {
  if (inclusions.empty()) return std::numeric_limits<double>::infinity();
  Domain domain{room.block, room.periodic};
  double size = domain.extent(0);
  for (const Inclusion& inclusion : inclusions) size = std::min(size, 2 * inclusion.half_width);
  Cells cells(domain, size);
  for (int k = 0; k < static_cast<int>(inclusions.size()); ++k)
    cells.add(k, inclusions[k].centre, bounding_radius(inclusions[k]));
  // Farther than twice round the block and its surroundings there is nothing more to find.
  const double farthest = 4 * (domain.extent(0) + domain.extent(1));
  for (double reach = 0.25 * size;; reach *= 4) {
    const double smallest = smallest_within(reach, inclusions, cells);
    if (smallest <= reach || reach > farthest) return smallest;
  }
}

}  // namespace slipscale::morphology
