#include <algorithm>

#include "fitting.hpp"
#include "plane.hpp"

namespace slipscale::morphology {
namespace {

constexpr double flat_cosine = -0.906;  ///< of 155 degrees

/// Of a square with all corners on interfaces: the part that covers its middle.
int part_at_middle(const Fit& fit, const Place& low) {
  const auto places = corners(low);
  Vector2 middle{};
  for (const Place& place : places) {
    if (fit.on[fit.lattice.node(place)] != fit.on[fit.lattice.node(low)]) return nobody;  // between two parts
    middle = middle + 0.25 * fit.position(place);
  }
  if (fit.contour) return fit.contour->inside(middle) ? 0 : nobody;
  for (const Place& place : places) {
    const int node = fit.lattice.node(place);
    const OnInterface& touch = fit.touches.at(node);
    const Vector2 image = fit.lattice.position(touch.seen) - fit.lattice.position(place);
    if (fit.bodies[touch.body].contains(middle + image)) return fit.on[node];
  }
  return nobody;
}

/// Two triangles on both sides of the diagonal from a corner; the part of each is that of its own corner.
Square halves(int first, const std::array<int, 4>& part) {
  Square square;
  square.count = 2;
  for (int half = 0; half < 2; ++half) {
    const int from = (first + 2 * half) % 4, middle = (from + 1) % 4, to = (from + 2) % 4;
    square.cells[half] = {{from, middle, to, 0}, 3, part[middle]};
  }
  return square;
}

/// The corner of a square with an angle near 180 degrees, between two others on the interface; or -1.
int flat_corner(const Fit& fit, const std::array<Place, 4>& places, const std::array<int, 4>& on) {
  for (int i = 0; i < 4; ++i) {
    const int next = (i + 1) % 4, last = (i + 3) % 4;
    if (on[i] == nobody || on[next] == nobody || on[last] == nobody) continue;
    const Vector2 x = fit.position(places[i]), ahead = unit(fit.position(places[next]) - x),
                  back = unit(fit.position(places[last]) - x);
    if (dot(ahead, back) < flat_cosine || cross(ahead, back) < 0) return i;
  }
  return -1;
}

}  // namespace

void decide_surrounded(Fit& fit) {
  for (const auto& [node, touch] : fit.touches) {
    const Place low = fit.lattice.place(node);
    if (!fit.lattice.has_square(low)) continue;
    const auto places = corners(low);
    if (std::ranges::all_of(places, [&](const Place& at) { return fit.on[fit.lattice.node(at)] != nobody; }))
      fit.surrounded[node] = part_at_middle(fit, low);
  }
}

Square square(const Fit& fit, const Place& low) {
  const auto places = corners(low);
  std::array<int, 4> on{}, side{};
  int part = nobody;  // that has a corner inside
  for (int i = 0; i < 4; ++i) {
    const int node = fit.lattice.node(places[i]);
    on[i] = fit.on[node];
    side[i] = fit.inside[node];
    if (on[i] == nobody && side[i] != nobody) part = side[i];
  }
  int within = 0, without = 0;
  for (int i = 0; i < 4; ++i) {
    if (part != nobody && on[i] != nobody && on[i] != part) on[i] = side[i] = nobody;  // another's interface
    if (on[i] == nobody) ++(side[i] == nobody ? without : within);
  }
  Square square;
  if (within > 0 && without > 0) return halves(on[0] != nobody && on[2] != nobody ? 0 : 1, side);
  if (within + without == 0) {
    const auto decided = fit.surrounded.find(fit.lattice.node(low));
    part = decided != fit.surrounded.end() ? decided->second : part_at_middle(fit, low);
  }
  if (const int flat = flat_corner(fit, places, on); flat >= 0) return halves(flat, {part, part, part, part});
  square.cells[0] = {{0, 1, 2, 3}, 4, part};
  return square;
}

}  // namespace slipscale::morphology
