#include "packing.hpp"

#include <limits>

#include "plane.hpp"
#include "separation.hpp"
#include "sides.hpp"

namespace slipscale::morphology {
namespace {

/// The block, with a margin that closes on itself at sides that cut inclusions: what goes around it does not
/// come back into the block.
Domain domain_around(const Room& room, const Vector2& reach) {
  Domain domain{room.block, room.periodic};
  if (room.edge == Edge::inside) return domain;
  for (int axis = 0; axis < 2; ++axis) {
    if (room.periodic[axis]) continue;
    const double margin = 2 * reach[axis] + room.gap + 2 * room.clearance;
    domain.box.upper[axis] += margin;
    if (axis == 1 && keeps_out(room)) continue;
    domain.box.lower[axis] -= margin;
    domain.periodic[axis] = true;
  }
  return domain;
}

}  // namespace

Packing::Packing(const Room& room, const Vector2& reach, double size)
    : room_(room),
      domain_(domain_around(room, reach)),
      size_(size),
      cells_(domain_, size),
      // A power of two, so that rounding to it is exact.
      quantum_(std::exp2(std::floor(std::log2(std::max(domain_.extent(0), domain_.extent(1)))) - 40)) {}

void Packing::add(const Inclusion& inclusion) {
  const double radius = bounding_radius(inclusion);
  largest_radius_ = std::max(largest_radius_, radius);
  cells_.add(static_cast<int>(inclusions_.size()), inclusion.centre, radius);
  inclusions_.push_back(inclusion);
}

void Packing::remove(std::size_t k) {
  inclusions_.erase(inclusions_.begin() + static_cast<std::ptrdiff_t>(k));
  sort_into_cells();
}

Vector2 Packing::any_place(Random& random, bool in_block) const {
  const Box& box = in_block ? room_.block : domain_.box;
  const double x = random.uniform(), y = random.uniform();
  return {box.lower[0] + x * box.width(), box.lower[1] + y * box.height()};
}

double Packing::smallest_separation(const Inclusion& inclusion, double enough, int except) const {
  double smallest = std::numeric_limits<double>::infinity();
  cells_.near(inclusion.centre, bounding_radius(inclusion) + enough, [&](int k, const Vector2& shift) {
    if (k == except) return;
    Inclusion other = inclusions_[k];
    other.centre = other.centre + shift;
    smallest = std::min(smallest, separation_within(std::min(enough, smallest), inclusion, other));
  });
  return smallest;
}

bool Packing::place_free(Inclusion inclusion, int attempts, bool in_block, Random& random) {
  for (int i = 0; i < attempts; ++i) {
    inclusion.centre = any_place(random, in_block);
    if (smallest_separation(inclusion, room_.gap) < room_.gap) continue;
    if (side_fault_or_outside(inclusion, room_).found) continue;
    add(inclusion);
    return true;
  }
  return false;
}

void Packing::place_best(Inclusion inclusion, int attempts, bool in_block, Random& random) {
  Vector2 best{};
  double largest = -std::numeric_limits<double>::infinity();
  for (int i = 0; i < attempts; ++i) {
    inclusion.centre = any_place(random, in_block);
    const Fault fault = side_fault_or_outside(inclusion, room_);
    if (fault.found) inclusion.centre = inclusion.centre + fault.way;
    const double s = smallest_separation(inclusion, room_.gap);
    if (s <= largest) continue;
    largest = s;
    best = inclusion.centre;
  }
  inclusion.centre = best;
  add(inclusion);
}

void Packing::sort_into_cells() {
  cells_.clear();
  for (std::size_t k = 0; k < inclusions_.size(); ++k)
    cells_.add(static_cast<int>(k), inclusions_[k].centre, bounding_radius(inclusions_[k]));
}

}  // namespace slipscale::morphology
