#include "slipscale/morphology/placement.hpp"

#include <cmath>
#include <numeric>
#include <optional>

#include "family.hpp"
#include "feasibility.hpp"
#include "gaps.hpp"
#include "packing.hpp"
#include "sides.hpp"
#include "slipscale/base/error.hpp"
#include "slipscale/base/print.hpp"

namespace slipscale {
namespace morphology {
namespace {

/// A packing of family `k` that did not relax, and the fraction of it that did.
struct Jam {
  std::size_t k;
  double reached;
};

constexpr int random_attempts = 500;     // for a free place, before placement counts as jammed
constexpr int crowded_attempts = 20;     // for the place with the least overlap
constexpr int sweeps = 4000;             // to relax overlaps
constexpr int sweeps_to_thin_out = 300;  // after inclusions were taken out of a packing that did not relax
constexpr int attempts = 3;              // at filling up again what was thinned out
constexpr double hopeless = 0.95;        // of the fraction; below it no further attempt is made
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

  void fill(std::size_t k, bool in_block) {
    double reached = 0;
    for (int i = 0; i < attempts; ++i) {
      if (!add(k, in_block) || packing_.relax(sweeps, random_)) return;
      thin_out_until_relaxed(k);
      reached = std::max(reached, area_of_family(k) / block_area());
      if (reached < hopeless * families_[k].fraction) break;
    }
    throw Jam{k, reached};
  }

  /// Adds inclusions while that brings the family nearer to its fraction. Returns whether some overlap.
  bool add(std::size_t k, bool in_block) {
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
    return jammed;
  }

  void thin_out_until_relaxed(std::size_t k) {
    const int family = static_cast<int>(k);
    do {
      const auto count = std::ranges::count(packing_.inclusions(), family, &Inclusion::family);
      if (count == 0) return;
      for (std::ptrdiff_t i = 0; i <= count / 40; ++i) packing_.remove(packing_.most_crowded(family));
    } while (!packing_.relax(sweeps_to_thin_out, random_));
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
        format("{} {:g} is less than half an inclusion in the block; give at least {:.2g}, or a smaller {}",
               option_of(families_, k, "fraction"), families_[k].fraction, mean_area(k) / block_area(),
               option_of(families_, k, "diameter")));
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

/// A fraction not above `reached` with which placement succeeds.
double feasible(std::vector<Family> families, const Room& room, std::uint64_t seed, const Jam& jam) {
  double& fraction = families[jam.k].fraction;
  fraction = std::floor(1e3 * std::min(jam.reached, 0.99 * fraction)) / 1e3;
  while (fraction > 0.01) try {
      Placer(families, room, seed).place();
      return fraction;
    } catch (const Jam&) {
      fraction = std::floor(950 * fraction) / 1e3;
    }
  return 0;
}

[[noreturn]] void refuse(const std::vector<Family>& families, const Room& room, std::uint64_t seed,
                         const Jam& jam) {
  const double lower = feasible(families, room, seed, jam);
  const bool walls = room.edge == Edge::inside && !(room.periodic[0] && room.periodic[1]);
  const std::string other = walls ? "a smaller -gap, or -edge cut" : "or a smaller -gap";
  throw UserError(
      format("{} {:g} cannot be reached with a gap of {:g} m: random placement comes to {:.3g}; give that, ",
             option_of(families, jam.k, "fraction"), families[jam.k].fraction, room.gap, lower) +
      other);
}

}  // namespace
}  // namespace morphology

Placement place_at_random(const std::vector<Family>& families, const Room& room, std::uint64_t seed) {
  morphology::refuse_impossible(families, room);
  try {
    return morphology::Placer(families, room, seed).place();
  } catch (const morphology::Jam& jam) {
    morphology::refuse(families, room, seed, jam);
  }
}

}  // namespace slipscale
