#include "sides.hpp"

#include <limits>
#include <numbers>
#include <optional>
#include <vector>

#include "plane.hpp"
#include "separation.hpp"

namespace slipscale {
namespace morphology {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Where the centre's coordinate must not lie: open intervals.
struct Barred {
  double low, high;
};

std::vector<Barred> barred(const Inclusion& inclusion, const Room& room, int axis, bool outside_allowed) {
  const double reach = support(inclusion, axis == 0 ? Vector2{1, 0} : Vector2{0, 1});
  const double low = room.block.lower[axis], high = room.block.upper[axis];
  const double near = room.clearance, wall = wall_distance(room);
  std::vector<Barred> found;
  const auto add_cut = [&](double side) {
    found.push_back({side - reach - near, side - reach + near});
    found.push_back({side + reach - near, side + reach + near});
  };
  const bool cut = room.periodic[axis] || room.edge == Edge::cut;
  const bool layer = axis == 1 && keeps_out(room);
  if (cut && !layer) add_cut(low);
  if (cut) add_cut(high);
  if (layer) found.push_back({-infinity, low + room.keep_out + reach + wall});
  if (!cut) {
    if (!layer) found.push_back({-infinity, low + reach + wall});
    found.push_back({high - reach - wall, infinity});
  } else if (!room.periodic[axis] && !outside_allowed) {
    found.push_back({-infinity, low - reach + near});
    found.push_back({high + reach - near, infinity});
  }
  return found;
}

bool allowed(double x, const std::vector<Barred>& intervals) {
  return std::ranges::none_of(intervals, [&](const Barred& b) { return x > b.low && x < b.high; });
}

/// The allowed coordinate nearest to x; x itself when there is none. `slack` keeps it off the ends, so that
/// rounding does not bring it back.
double nearest_allowed(double x, const std::vector<Barred>& intervals, double slack) {
  if (allowed(x, intervals)) return x;
  double best = infinity;
  for (const Barred& b : intervals)
    for (const double end : {b.low - slack, b.high + slack})
      if (std::abs(end - x) < std::abs(best - x) && allowed(end, intervals)) best = end;
  return best == infinity ? x : best;
}

/// Whether an outline passes a corner of the block properly, and the move that makes it do so. An inclusion
/// that covers the corner is moved further over it unless `out`.
Vector2 corner_move(const Inclusion& inclusion, const Room& room, bool out, double slack) {
  Inclusion point;
  for (const double x : {room.block.lower[0], room.block.upper[0]})
    for (const double y : {room.block.lower[1], room.block.upper[1]}) {
      point.centre = {x, y};
      Vector2 away{};
      const double s = separation_within(room.clearance, point, inclusion, &away);
      if (std::abs(s) >= room.clearance) continue;
      const bool cover = s < 0 && !out && inclusion.half_width > 1.5 * room.clearance;
      return (cover ? -(room.clearance + s + slack) : room.clearance - s + slack) * away;
    }
  return {};
}

/// An inclusion beyond a corner can cross the lines of both sides and yet miss the block.
Vector2 move_into_block(const Inclusion& inclusion, const Room& room, double slack) {
  Vector2 way{};
  const double s = separation_within(0, inclusion, as_inclusion(room.block), &way);
  if (s < 0) return {};
  const Vector2 middle = 0.5 * (room.block.lower + room.block.upper);
  return (std::max(s, 0.0) + room.clearance + slack) * unit(middle - inclusion.centre);
}

/// One move that mends the first fault found; zero when there is none.
Vector2 mending_move(const Inclusion& inclusion, const Room& room, bool outside_allowed, bool out) {
  const double slack = 1e-8 * std::min(room.block.width(), room.block.height());
  Vector2 move{};
  for (int axis = 0; axis < 2; ++axis)
    move[axis] =
        nearest_allowed(inclusion.centre[axis], barred(inclusion, room, axis, outside_allowed), slack) -
        inclusion.centre[axis];
  if (move != Vector2{}) return move;
  move = corner_move(inclusion, room, out, slack);
  if (move != Vector2{} || outside_allowed) return move;
  return move_into_block(inclusion, room, slack);
}

bool keeps_sides(const Inclusion& inclusion, const Room& room, bool outside_allowed) {
  return mending_move(inclusion, room, outside_allowed, false) == Vector2{};
}

/// Mends one fault after the other.
std::optional<Vector2> mended_in_turn(const Inclusion& inclusion, const Room& room, bool outside_allowed,
                                      bool out) {
  Inclusion moved = inclusion;
  for (int i = 0; i < 8; ++i) {
    const Vector2 move = mending_move(moved, room, outside_allowed, out);
    if (move == Vector2{}) return moved.centre - inclusion.centre;
    moved.centre = moved.centre + move;
  }
  return std::nullopt;
}

/// Near a corner, mending one fault may make another: looks for a place all around, further and further off.
std::optional<Vector2> mended_by_search(const Inclusion& inclusion, const Room& room, bool outside_allowed) {
  constexpr int directions = 16, steps = 40;
  const double farthest = inclusion.half_length + inclusion.half_width + 2 * wall_distance(room);
  for (int i = 1; i <= steps; ++i)
    for (int k = 0; k < directions; ++k) {
      Inclusion moved = inclusion;
      const Vector2 way = (farthest * i / steps) * direction(2 * std::numbers::pi * k / directions);
      moved.centre = moved.centre + way;
      if (keeps_sides(moved, room, outside_allowed)) return way;
    }
  return std::nullopt;
}

Fault fault(const Inclusion& inclusion, const Room& room, bool outside_allowed) {
  if (keeps_sides(inclusion, room, outside_allowed)) return {};
  std::optional<Vector2> shortest;
  for (const bool out : {false, true}) {
    const auto way = mended_in_turn(inclusion, room, outside_allowed, out);
    if (way && (!shortest || norm(*way) < norm(*shortest))) shortest = way;
  }
  if (!shortest) shortest = mended_by_search(inclusion, room, outside_allowed);
  return {true, shortest.value_or(Vector2{})};
}

/// Bounding box against box: cheap, and right but near a corner.
bool may_reach(const Inclusion& inclusion, const Box& box) {
  for (int axis = 0; axis < 2; ++axis) {
    const double reach = support(inclusion, axis == 0 ? Vector2{1, 0} : Vector2{0, 1});
    if (inclusion.centre[axis] + reach <= box.lower[axis] ||
        inclusion.centre[axis] - reach >= box.upper[axis])
      return false;
  }
  return true;
}

}  // namespace

Inclusion as_inclusion(const Box& box) {
  const double a = 0.5 * box.width(), b = 0.5 * box.height();
  return {Shape::rectangle, 0.5 * (box.lower + box.upper), a, b, 0, 0, 0};
}

Fault side_fault_or_outside(const Inclusion& inclusion, const Room& room) {
  return fault(inclusion, room, true);
}

double area_in_block(const Inclusion& inclusion, const Room& room) {
  double sum = 0;
  for (const Inclusion& image : images(inclusion, room)) sum += area_inside(image, room.block);
  return sum;
}

}  // namespace morphology

using namespace morphology;

std::vector<Inclusion> images(const Inclusion& inclusion, const Room& room) {
  std::vector<Inclusion> found{inclusion};
  const Inclusion block = as_inclusion(room.block);
  const int nx = room.periodic[0] ? 1 : 0, ny = room.periodic[1] ? 1 : 0;
  for (int j = -ny; j <= ny; ++j)
    for (int i = -nx; i <= nx; ++i) {
      Inclusion image = inclusion;
      image.centre = inclusion.centre + Vector2{i * room.block.width(), j * room.block.height()};
      if ((i != 0 || j != 0) && may_reach(image, room.block) && separation(image, block) < 0)
        found.push_back(image);
    }
  return found;
}

Fault side_fault(const Inclusion& inclusion, const Room& room) { return fault(inclusion, room, false); }

}  // namespace slipscale
