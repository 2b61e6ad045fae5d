#include "slipscale/morphology/placement.hpp"

#include <cmath>
#include <numeric>
#include <optional>

#include "draw.hpp"
#include "feasibility.hpp"
#include "gaps.hpp"
#include "packing.hpp"
#include "sides.hpp"
#include "slipscale/base/error.hpp"
#include "slipscale/base/print.hpp"

namespace slipscale {
namespace morphology {
namespace {

constexpr int random_attempts = 500;     // for a free place, before placement counts as jammed
constexpr int crowded_attempts = 20;     // for the place with the least overlap
constexpr int sweeps = 4000;             // to relax overlaps
constexpr int sweeps_to_thin_out = 300;  // after inclusions were taken out of a packing that did not relax
constexpr int rounds = 200;              // of mending fractions that relaxation changed

class Placer {
 public:
  Placer(const std::vector<Family>& families, const Room& room, std::uint64_t seed)
      : families_(families), room_(room), random_(seed), packing_(room, reach(), smallest_size()) {}

  Placement place() {
    for (const std::size_t k : largest_first()) {
      fill(k, false);
      refuse_none(k);
    }
    mend();
    return result();
  }

 private:
  Vector2 reach() const {
    Vector2 most{};
    for (const Family& family : families_)
      for (int axis = 0; axis < 2; ++axis)
        most[axis] = std::max(most[axis], 0.5 * largest_extent(family, axis));
    return most;
  }

  double smallest_size() const {
    double size = families_[0].diameter / families_[0].aspect;
    for (const Family& family : families_) size = std::min(size, family.diameter / family.aspect);
    return size;
  }

  double mean_area(std::size_t k) const { return area(shaped(families_[k], 0, families_[k].diameter, 0)); }

  std::vector<std::size_t> largest_first() const {
    std::vector<std::size_t> order(families_.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::stable_sort(order, std::greater<>{}, [&](std::size_t k) { return mean_area(k); });
    return order;
  }

  double block_area() const { return room_.block.width() * room_.block.height(); }

  double area_of_family(std::size_t k) const {
    double sum = 0;
    for (const Inclusion& inclusion : packing_.inclusions())
      if (inclusion.family == static_cast<int>(k)) sum += area_in_block(inclusion, room_);
    return sum;
  }

  double missing(std::size_t k) const { return families_[k].fraction * block_area() - area_of_family(k); }

  /// The inclusion of the family that is to be placed next. It is drawn once, however often one asks, so that
  /// the distribution does not depend on which sizes are easy to place.
  const Inclusion& next(std::size_t k) {
    if (!next_[k]) next_[k] = drawn(families_[k], static_cast<int>(k), random_);
    return *next_[k];
  }

  /// Adds inclusions while that brings the family nearer to its fraction.
  void fill(std::size_t k, bool in_block) {
    bool jammed = false;
    double rest = missing(k);
    while (rest > 0.5 * area(next(k))) {
      const Inclusion inclusion = next(k);
      jammed = jammed || !packing_.place_free(inclusion, random_attempts, in_block, random_);
      if (jammed) {
        packing_.place_best(inclusion, crowded_attempts, in_block, random_);
        ++relaxed_;
      }
      next_[k].reset();
      rest -= area_in_block(packing_.inclusions().back(), room_);
    }
    if (jammed && !packing_.relax(sweeps, random_)) refuse(k);
  }

  /// Takes out the inclusion that brings the family nearest to its fraction.
  void thin_out(std::size_t k, double surplus) {
    const auto& inclusions = packing_.inclusions();
    std::size_t best = 0;
    double nearest = block_area();
    for (std::size_t i = 0; i < inclusions.size(); ++i) {
      if (inclusions[i].family != static_cast<int>(k)) continue;
      const double inside = area_in_block(inclusions[i], room_);
      if (inside == 0 || std::abs(inside - surplus) >= nearest) continue;
      nearest = std::abs(inside - surplus);
      best = i;
    }
    packing_.remove(best);
  }

  /// Relaxation pushes inclusions through the sides of the block, which changes its fractions.
  void mend() {
    bool changed = true;
    for (int i = 0; i < rounds && changed; ++i) {
      changed = false;
      for (std::size_t k = 0; k < families_.size(); ++k) {
        const double rest = missing(k);
        if (rest > 0.5 * area(next(k))) {
          fill(k, true);
          changed = true;
        } else if (-rest > 0.5 * mean_area(k)) {
          thin_out(k, -rest);
          changed = true;
        }
      }
    }
  }

  void refuse_none(std::size_t k) const {
    for (const Inclusion& inclusion : packing_.inclusions())
      if (inclusion.family == static_cast<int>(k)) return;
    throw UserError(
        format("%s %g is less than half an inclusion in the block; give at least %.2g, or a smaller %s",
               option_of(families_, k, "fraction").c_str(), families_[k].fraction,
               mean_area(k) / block_area(), option_of(families_, k, "diameter").c_str()));
  }

  /// The packing does not relax: finds the fraction that does.
  [[noreturn]] void refuse(std::size_t k) {
    double reached = 0;
    do {
      const auto count = std::ranges::count(packing_.inclusions(), static_cast<int>(k), &Inclusion::family);
      if (count == 0) break;
      for (std::ptrdiff_t i = 0; i <= count / 40; ++i)
        packing_.remove(packing_.most_crowded(static_cast<int>(k)));
      reached = area_of_family(k) / block_area();
    } while (!packing_.relax(sweeps_to_thin_out, random_));
    reached = std::floor(1e3 * reached) / 1e3;
    const bool walls = room_.edge == Edge::inside && !(room_.periodic[0] && room_.periodic[1]);
    throw UserError(
        format("%s %g cannot be reached with a gap of %g m, random placement came to %g; give at "
               "most that, %s",
               option_of(families_, k, "fraction").c_str(), families_[k].fraction, room_.gap, reached,
               walls ? "a smaller -gap, or -edge cut" : "or a smaller -gap"));
  }

  Placement result() {
    Placement placement;
    for (const Inclusion& inclusion : packing_.inclusions())
      if (area_in_block(inclusion, room_) > 0) placement.inclusions.push_back(inclusion);
    for (std::size_t k = 0; k < families_.size(); ++k)
      placement.fraction.push_back(area_of_family(k) / block_area());
    placement.smallest_gap = smallest_gap(placement.inclusions, room_);
    placement.relaxed = relaxed_;
    return placement;
  }

  const std::vector<Family>& families_;
  const Room& room_;
  Random random_;
  Packing packing_;
  std::vector<std::optional<Inclusion>> next_ = std::vector<std::optional<Inclusion>>(families_.size());
  int relaxed_ = 0;
};

}  // namespace
}  // namespace morphology

Placement place_at_random(const std::vector<Family>& families, const Room& room, std::uint64_t seed) {
  morphology::refuse_impossible(families, room);
  return morphology::Placer(families, room, seed).place();
}

}  // namespace slipscale
