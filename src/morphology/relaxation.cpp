#include "packing.hpp"

#include <limits>
#include <numeric>

#include "plane.hpp"
#include "separation.hpp"
#include "sides.hpp"

namespace slipscale::morphology {
namespace {

/// Inclusions are pushed this much further apart than they need to be, over the size: the approach to a state
/// without overlaps is exponential and would not end.
constexpr double surplus = 1e-3;

/// A contact list serves until inclusions have moved by half of this, over the size.
constexpr double skin = 0.3;

/// A sweep moves an inclusion by no more than this, over its half width.
constexpr double longest_move = 0.5;

/// So often the most crowded inclusion is put elsewhere, in sweeps.
constexpr int patience = 100;

/// It is given up when the overlaps do not fall to this part in so many sweeps.
constexpr double progress = 0.95;
constexpr int last_patience = 400;

}  // namespace

bool Packing::relax(int sweeps, Random& random) {
  reserve_ = 0;
  bool relaxed = false;
  double least = std::numeric_limits<double>::infinity();
  int best = 0;
  for (int i = 1; i <= sweeps && !relaxed && i - best <= last_patience; ++i) {
    relaxed = sweep();
    if (crowding() < progress * least) {
      least = crowding();
      best = i;
    }
    if (!relaxed && i % patience == 0) move_most_crowded(random);
  }
  for (Inclusion& inclusion : inclusions_) inclusion.centre = domain_.wrapped(inclusion.centre);
  sort_into_cells();
  return relaxed;
}

/// Returns true, and moves nothing, when there is no fault.
bool Packing::sweep() {
  if (reserve_ <= 0) find_contacts();
  push_.assign(inclusions_.size(), {});
  crowding_.assign(inclusions_.size(), 0);
  const bool apart = push_apart(), off_sides = push_off_sides();
  if (apart && off_sides) return true;
  move();
  return false;
}

void Packing::find_contacts() {
  for (Inclusion& inclusion : inclusions_) inclusion.centre = domain_.wrapped(inclusion.centre);
  sort_into_cells();
  contacts_.clear();
  const double reach = room_.gap + (surplus + skin) * size_;
  for (int a = 0; a < static_cast<int>(inclusions_.size()); ++a) {
    const double radius = bounding_radius(inclusions_[a]) + reach;
    cells_.near(inclusions_[a].centre, radius, [&](int b, const Vector2& shift) {
      const Vector2 between = inclusions_[b].centre + shift - inclusions_[a].centre;
      if (b > a && norm(between) < radius + bounding_radius(inclusions_[b]))
        contacts_.push_back({a, b, shift, {}});
    });
  }
  reserve_ = 0.5 * skin * size_;
}

bool Packing::push_apart() {
  bool apart = true;
  const double wanted = room_.gap + surplus * size_;
  for (Contact& contact : contacts_) {
    Inclusion b = inclusions_[contact.b];
    b.centre = b.centre + contact.shift;
    const double s = separation_within(wanted, inclusions_[contact.a], b, &contact.normal);
    if (s >= wanted) continue;
    const Vector2 half = (0.5 * (wanted - s)) * contact.normal;
    push_[contact.a] = push_[contact.a] - half;
    push_[contact.b] = push_[contact.b] + half;
    if (s >= room_.gap) continue;
    apart = false;
    crowding_[contact.a] += room_.gap - s;
    crowding_[contact.b] += room_.gap - s;
  }
  return apart;
}

bool Packing::push_off_sides() {
  bool off = true;
  for (std::size_t k = 0; k < inclusions_.size(); ++k) {
    const Fault fault = side_fault_or_outside(inclusions_[k], room_);
    if (!fault.found) continue;
    off = false;
    push_[k] = push_[k] + fault.way;
    crowding_[k] += norm(fault.way);
  }
  return off;
}

void Packing::move() {
  double longest = 0;
  for (std::size_t k = 0; k < inclusions_.size(); ++k) {
    Inclusion& inclusion = inclusions_[k];
    const double length = norm(push_[k]), most = longest_move * inclusion.half_width;
    if (length == 0) continue;
    inclusion.centre = inclusion.centre + std::min(1.0, most / length) * push_[k];
    for (int axis = 0; axis < 2; ++axis) {
      double& x = inclusion.centre[axis];
      if (!domain_.periodic[axis]) x = std::clamp(x, domain_.box.lower[axis], domain_.box.upper[axis]);
      // Otherwise the last bits, which are not the same on every machine, would grow from sweep to sweep.
      x = std::nearbyint(x / quantum_) * quantum_;
    }
    longest = std::max(longest, std::min(length, most));
  }
  reserve_ -= longest;
}

std::size_t Packing::most_crowded(int family) const {
  std::size_t found = inclusions_.size();
  for (std::size_t k = 0; k < inclusions_.size(); ++k)
    if (inclusions_[k].family == family && (found == inclusions_.size() || crowding_[k] > crowding_[found]))
      found = k;
  return found;
}

double Packing::crowding() const { return std::accumulate(crowding_.begin(), crowding_.end(), 0.0); }

/// Some are wedged between others and a side; there is more room elsewhere.
void Packing::move_most_crowded(Random& random) {
  const std::size_t k = static_cast<std::size_t>(std::ranges::max_element(crowding_) - crowding_.begin());
  const Inclusion wedged = inclusions_[k];
  remove(k);
  place_best(wedged, 100, false, random);
  reserve_ = 0;
}

}  // namespace slipscale::morphology
