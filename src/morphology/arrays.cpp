#include <cmath>
#include <numbers>

#include "cells.hpp"
#include "family.hpp"
#include "gaps.hpp"
#include "plane.hpp"
#include "separation.hpp"
#include "sides.hpp"
#include "slipscale/base/error.hpp"
#include "slipscale/base/print.hpp"

namespace slipscale {
namespace morphology {
namespace {

class ArrayPlacer {
 public:
  ArrayPlacer(const Family& family, const Room& room, const Array& array)
      : family_(family),
        room_(room),
        array_(array),
        spacing_{room.block.width() / array.columns, room.block.height() / array.rows} {}

  Placement place() {
    if (hexagonal() && room_.periodic[1] && array_.rows % 2)
      throw UserError(
          format("-rows {}: a hexagonal array that is periodic along y has an even number of rows; "
                 "give {}",
                 array_.rows, array_.rows + 1));
    const Inclusion inclusion = model();
    refuse_too_close(inclusion);
    put(inclusion);
    mend();
    placement_.fraction = {0};
    for (const Inclusion& each : placement_.inclusions)
      placement_.fraction[0] += area_in_block(each, room_) / (room_.block.width() * room_.block.height());
    placement_.smallest_gap = smallest_gap(placement_.inclusions, room_);
    return placement_;
  }

 private:
  bool hexagonal() const { return array_.arrangement == Arrangement::hexagonal; }

  Inclusion of_diameter(double diameter) const { return shaped(family_, 0, diameter, family_.angle); }

  /// Sides that do not cut take the place of one inclusion in each shifted row.
  bool short_rows() const { return hexagonal() && room_.edge == Edge::inside && !room_.periodic[0]; }

  /// The block's area over the number of inclusions, halves at opposite sides counted as one, m².
  double area_for_each() const {
    const int count = array_.columns * array_.rows - (short_rows() ? array_.rows / 2 : 0);
    return room_.block.width() * room_.block.height() / count;
  }

  /// Of the given diameter, or else of the diameter that gives the fraction.
  Inclusion model() const {
    if (family_.diameter > 0) return of_diameter(family_.diameter);
    return of_diameter(std::sqrt(family_.fraction * area_for_each() / area(of_diameter(1))));
  }

  /// The gap to the nearest neighbour in the unlimited array; an odd number of rows beyond the sides does not
  /// matter to it.
  double gap_in_array(const Inclusion& inclusion) const {
    double smallest = 4 * (spacing_[0] + spacing_[1]);
    // An aspect far from that of the cell reaches past the nearest rows and columns.
    const Vector2 reach{support(inclusion, {1, 0}), support(inclusion, {0, 1})};
    const int columns = 2 + static_cast<int>(2 * reach[0] / spacing_[0]),
              rows = 2 + static_cast<int>(2 * reach[1] / spacing_[1]);
    for (int j = 0; j <= rows; ++j)
      for (int i = -columns; i <= columns; ++i) {
        if (j == 0 && i <= 0) continue;
        Inclusion other = inclusion;
        const double shift = hexagonal() && j % 2 ? 0.5 : 0;
        other.centre = inclusion.centre + Vector2{(i + shift) * spacing_[0], j * spacing_[1]};
        smallest = std::min(smallest, separation(inclusion, other));
      }
    return smallest;
  }

  void refuse_too_close(const Inclusion& inclusion) const {
    const double gap = gap_in_array(inclusion);
    // Rounding must not refuse the diameter that an earlier message has recommended.
    if (gap >= room_.gap * (1 - 1e-9)) return;
    double fits = 0, too_large = 2 * inclusion.half_length;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (fits + too_large);
      (gap_in_array(of_diameter(middle)) >= room_.gap ? fits : too_large) = middle;
    }
    if (fits < 1e-9 * too_large || fits == 0)
      throw UserError(
          format("-gap {:g} is larger than the spacing of the array, {:g} m by {:g} m; give a smaller gap, "
                 "or fewer -columns and -rows",
                 room_.gap, spacing_[0], spacing_[1]));
    const double fraction = area(of_diameter(fits)) / area_for_each();
    const bool by_diameter = family_.diameter > 0;
    const double given = by_diameter ? family_.diameter : family_.fraction;
    throw UserError(
        format("-{} {:g} leaves {:g} m between the inclusions of the array, less than the gap of {:g} m; "
               "give at most {:.3g}, or a smaller -gap",
               by_diameter ? "diameter" : "fraction", given, gap, room_.gap,
               rounded_down(by_diameter ? fits : fraction)));
  }

  /// To three digits.
  static double rounded_down(double x) {
    const double unit = std::pow(10, std::floor(std::log10(x)) - 2);
    return std::floor(x / unit) * unit;
  }

  void put(Inclusion inclusion) {
    for (int j = 0; j < array_.rows; ++j) {
      const bool shifted = hexagonal() && j % 2;
      // A shifted row has its first and last inclusion on the sides: cut in half, or else left out; on a
      // periodic side they are the same.
      const bool cut = room_.edge == Edge::cut && !room_.periodic[0];
      const int first = shifted ? (cut ? -1 : 0) : 0;
      const int last = array_.columns - (shifted && short_rows() ? 1 : 0);
      for (int i = first; i < last; ++i) {
        const double x = std::fmod(i + (shifted ? 1.0 : 0.5), array_.columns + (cut ? 1 : 0));
        inclusion.centre = room_.block.lower + Vector2{x * spacing_[0], (j + 0.5) * spacing_[1]};
        placement_.inclusions.push_back(inclusion);
      }
    }
  }

  /// Moves or drops inclusions that do not keep the sides.
  void mend() {
    std::vector<Inclusion>& inclusions = placement_.inclusions;
    for (std::size_t k = 0; k < inclusions.size();) {
      const Fault fault = side_fault(inclusions[k], room_);
      if (!fault.found) {
        ++k;
        continue;
      }
      Inclusion moved = inclusions[k];
      moved.centre = Domain{room_.block, room_.periodic}.wrapped(moved.centre + fault.way);
      if (norm(fault.way) < array_.repair && !side_fault(moved, room_).found && is_free(moved, k)) {
        inclusions[k++] = moved;
        ++placement_.moved;
      } else {
        inclusions.erase(inclusions.begin() + static_cast<std::ptrdiff_t>(k));
        ++placement_.dropped;
      }
    }
  }

  bool is_free(const Inclusion& inclusion, std::size_t place) const {
    for (std::size_t k = 0; k < placement_.inclusions.size(); ++k) {
      if (k == place) continue;
      for (int i = -1; i <= 1; ++i)
        for (int j = -1; j <= 1; ++j) {
          if ((i != 0 && !room_.periodic[0]) || (j != 0 && !room_.periodic[1])) continue;
          Inclusion other = placement_.inclusions[k];
          other.centre = other.centre + Vector2{i * room_.block.width(), j * room_.block.height()};
          if (separation_within(room_.gap, inclusion, other) < room_.gap) return false;
        }
    }
    return true;
  }

  const Family& family_;
  const Room& room_;
  const Array& array_;
  Vector2 spacing_;
  Placement placement_;
};

}  // namespace
}  // namespace morphology

Placement place_in_array(const Family& family, const Room& room, const Array& array) {
  return morphology::ArrayPlacer(family, room, array).place();
}

}  // namespace slipscale
