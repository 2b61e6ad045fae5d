#include "feasibility.hpp"

#include <cmath>
#include <numbers>

#include "family.hpp"
#include "plane.hpp"
#include "sides.hpp"
#include "slipscale/base/error.hpp"
#include "slipscale/base/print.hpp"

namespace slipscale::morphology {
namespace {

/// Where inclusions may lie along an axis, m.
double available(const Room& room, int axis) {
  double length = axis == 0 ? room.block.width() : room.block.height();
  if (axis == 1 && keeps_out(room)) length -= room.keep_out + wall_distance(room);
  if (room.periodic[axis]) return length - wall_distance(room);
  if (room.edge == Edge::cut) return length;
  return length - (axis == 1 && keeps_out(room) ? 1 : 2) * wall_distance(room);
}

void refuse_too_large(const std::vector<Family>& families, std::size_t k, const Room& room) {
  for (int axis = 0; axis < 2; ++axis) {
    const double extent = largest_extent(families[k], axis), room_for = available(room, axis);
    if (extent <= room_for) continue;
    const std::string option = option_of(families, k, "diameter");
    const std::string where = format("{} of the block ({:g} m)", axis == 0 ? "the width" : "the height",
                                     axis == 0 ? room.block.width() : room.block.height());
    if (room_for <= 0)
      throw UserError("-keep_out, -gap and -size leave no room for inclusions along " + where +
                      "; give smaller ones, or a larger block");
    throw UserError(
        format("{} {:g} gives inclusions of {:g} m along ", option, families[k].diameter, extent) + where +
        format(", where there is room for {:g} m; give at most {:.3g}", room_for,
               std::floor(1e3 * room_for / extent) / 1e3 * families[k].diameter));
  }
}

/// Largest part of the plane that inclusions of the family can fill with the gap between them. Equal discs:
/// the hexagonal array; equal ellipses fill no more than that (Fejes Tóth, Acta Sci. Math. 12 (1950) 62). In
/// general, half the gap around each inclusion belongs to it. Of several families, the small ones may lie
/// between the large ones.
double densest(const Family& family, bool alone, double gap) {
  const Inclusion mean = shaped(family, 0, family.diameter, 0);
  constexpr double pi = std::numbers::pi, hexagonal = pi / (2 * std::numbers::sqrt3);
  const double deviation = family.diameter_deviation, d = family.diameter;
  const bool equal = alone && deviation == 0;
  if (family.shape == Shape::disc && equal) return hexagonal * std::pow(d / (d + gap), 2);
  const double mean_area = (1 + deviation * deviation) * area(mean);
  const double bound = mean_area / (mean_area + 0.5 * gap * perimeter(mean) + 0.25 * pi * gap * gap);
  return family.shape == Shape::ellipse && equal ? std::min(bound, hexagonal) : bound;
}

/// Part of the block that inclusions and the gaps around them may fill.
double usable(const Room& room) {
  double part = 1;
  for (int axis = 0; axis < 2; ++axis) {
    const double extent = axis == 0 ? room.block.width() : room.block.height();
    if (!room.periodic[axis]) part *= std::min(1.0, (available(room, axis) + room.gap) / extent);
  }
  return part;
}

}  // namespace

std::string option_of(const std::vector<Family>& families, std::size_t k, const std::string& key) {
  return families.size() == 1 ? "-" + key : "-families_" + families[k].region + "_" + key;
}

void refuse_impossible(const std::vector<Family>& families, const Room& room) {
  for (std::size_t k = 0; k < families.size(); ++k) refuse_too_large(families, k, room);
  const double part = usable(room);
  double filled = 0;
  for (std::size_t k = 0; k < families.size(); ++k) {
    const double largest = part * densest(families[k], families.size() == 1, room.gap);
    if (filled + families[k].fraction / largest > 1) {
      const double rest = std::floor(1e3 * largest * (1 - filled)) / 1e3;
      throw UserError(
          format("{} {:g} is more than the densest packing with a gap of {:g} m allows; give less than "
                 "{:.3g}, or a smaller -gap",
                 option_of(families, k, "fraction"), families[k].fraction, room.gap, rest));
    }
    filled += families[k].fraction / largest;
  }
}

}  // namespace slipscale::morphology
