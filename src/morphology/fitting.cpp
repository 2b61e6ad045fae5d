#include "fitting.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "plane.hpp"

namespace slipscale::morphology {
namespace {

constexpr double same = 1e-9;      ///< in cells: an interface so near to a node passes through it
constexpr double farthest = 0.75;  ///< in cells, that a node is moved
constexpr double nearest = 0.2;    ///< in cells, that two nodes on a side may come
constexpr double thinnest = 0.5;   ///< in cells: a wedge at a side of the block that is left out
/// In cells: a tip that reaches past a line of the lattice without meeting a node there is cut off, and its
/// area made good all around; a longer one is more than a grid of this size can show.
constexpr double deepest_lost = 0.5;

/// An edge of the lattice that an interface crosses.
struct Crossing {
  int axis;     ///< along which the edge runs
  Place place;  ///< of its lower node
  double part;  ///< of the edge below the crossing
  int body;
  std::array<std::optional<Vector2>, 2> move;  ///< that brings its lower, upper node onto the interface, m

  Place end(int upper) const {
    Place at = place;
    at[axis] += upper;
    return at;
  }
};

class Fitter {
 public:
  Fitter(const Lattice& lattice, const std::vector<Body>& bodies)
      : lattice_(lattice), bodies_(bodies), fit_{lattice, bodies, {}, {}, {}, {}, {}, 0, 0, {}} {
    fit_.inside.assign(lattice.nodes(), nobody);
    fit_.on.assign(lattice.nodes(), nobody);
    fit_.moved.assign(lattice.nodes(), {});
  }

  Fit work() {
    for (std::size_t body = 0; body < bodies_.size(); ++body)
      for (int axis = 0; axis < 2; ++axis) cross(static_cast<int>(body), axis);
    for (const Crossing& crossing : crossings_) take_at_node(crossing);
    std::erase_if(crossings_, [&](const Crossing& c) {
      const int part = bodies_[c.body].part();
      return (fit_.inside[lattice_.node(c.end(0))] == part) == (fit_.inside[lattice_.node(c.end(1))] == part);
    });
    for (Crossing& crossing : crossings_)
      for (int upper = 0; upper < 2; ++upper) crossing.move[upper] = move(crossing, upper);
    // Where an interface cuts a side of the block there is one point for the nodes of the side, and those at
    // the end of an edge that leaves the side have no other.
    std::ranges::stable_sort(crossings_, {}, [&](const Crossing& c) {
      return std::pair(!leaves_side(c), std::min(cost(c.move[0]), cost(c.move[1])));
    });
    for (const Crossing& crossing : crossings_) settle(crossing);
    return std::move(fit_);
  }

 private:
  /// A node through which an interface passes lies on it, whatever rounding says of the two edges there.
  void take_at_node(const Crossing& crossing) {
    constexpr double at_node = 1e-6;
    for (const int upper : {0, 1}) {
      const Place place = crossing.end(upper);
      const int node = lattice_.node(place);
      const double part = crossing.part - upper;
      if (std::abs(part) > at_node || fit_.on[node] != nobody) continue;
      fit_.on[node] = bodies_[crossing.body].part();
      fit_.touches[node] = {crossing.body, place};
      if (!lattice_.on_side(place, crossing.axis))
        fit_.moved[node][crossing.axis] = part * lattice_.step(crossing.axis);
    }
  }

  double in_cells(double x, int axis) const {
    const double t = (x - lattice_.block().lower[axis]) / lattice_.step(axis);
    return std::abs(t - std::round(t)) < same ? std::round(t) : t;
  }

  /// Edges along `axis` that the body's interface crosses; nodes that it covers.
  void cross(int body, int axis) {
    const int across = 1 - axis, cells = lattice_.cells(axis);
    const Interval extent = bodies_[body].extent(across);
    const auto line = [&](double x) {
      return static_cast<int>(std::clamp(in_cells(x, across), -1.0, 1.0 * lattice_.lines(across)));
    };
    for (int k = std::max(0, line(extent.low)); k <= std::min(line(extent.high), lattice_.lines(across) - 1);
         ++k) {
      const auto covered = bodies_[body].covers(across, lattice_.line(across, k));
      if (!covered) continue;
      const double low = std::clamp(in_cells(covered->low, axis), -1.0, cells + 1.0),
                   high = std::clamp(in_cells(covered->high, axis), -1.0, cells + 1.0);
      const int first = static_cast<int>(std::ceil(low)), last = static_cast<int>(std::floor(high));
      if (first > last) {  // a tip between two nodes
        const double beyond = std::min(in_cells(extent.high, across) - k, k - in_cells(extent.low, across));
        if (beyond > deepest_lost && high > 0 && low < cells)
          ++fit_.unresolved[{bodies_[body].part(), nobody}];
        continue;
      }
      Place place{};
      place[across] = k;
      if (axis == 0)
        for (place[0] = std::max(first, 0); place[0] <= std::min(last, cells); ++place[0])
          fit_.inside[lattice_.node(place)] = bodies_[body].part();
      const auto add = [&](int lower, double part) {
        if (lower < 0 || lower >= cells) return;
        place[axis] = lower;
        crossings_.push_back({axis, place, part, body, {}});
      };
      add(first - 1, low - (first - 1));
      add(last, high - last);
    }
  }

  /// Along the edge; along the side for nodes on a side of the block.
  std::optional<Vector2> move(const Crossing& crossing, int upper) const {
    const Place place = crossing.end(upper);
    const int axis = crossing.axis, across = 1 - axis;
    Vector2 by{};
    by[axis] = (crossing.part - upper) * lattice_.step(axis);
    if (!lattice_.on_side(place, axis) || std::abs(crossing.part - upper) < same) return by;
    if (lattice_.on_side(place, across)) return std::nullopt;  // a corner of the block
    const Vector2 from = lattice_.position(place);
    const auto covered = bodies_[crossing.body].covers(axis, from[axis]);
    if (!covered) return std::nullopt;
    const double low = covered->low - from[across], high = covered->high - from[across];
    by[axis] = 0;
    by[across] = std::abs(low) < std::abs(high) ? low : high;
    return by;
  }

  bool leaves_side(const Crossing& c) const {
    return lattice_.on_side(c.end(0), c.axis) || lattice_.on_side(c.end(1), c.axis);
  }

  bool along_side(const Crossing& c) const { return lattice_.on_side(c.place, 1 - c.axis); }

  double cost(const std::optional<Vector2>& move) const {
    return move ? std::hypot((*move)[0] / lattice_.step(0), (*move)[1] / lattice_.step(1)) : 1e300;
  }

  /// The nearer node of the edge is moved, or else the farther.
  void settle(const Crossing& crossing) {
    const int part = bodies_[crossing.body].part();
    if (along_side(crossing) && !leaves_side(crossing))
      for (const int upper : {0, 1})
        if (fit_.on[lattice_.node(crossing.end(upper))] == part) return;
    const int nearer = cost(crossing.move[1]) < cost(crossing.move[0]) ? 1 : 0;
    for (const int upper : {nearer, 1 - nearer}) {
      const Place place = crossing.end(upper);
      const int node = lattice_.node(place);
      if (fit_.on[node] == part) return;
      if (cost(crossing.move[upper]) > farthest || fit_.on[node] != nobody) continue;
      if (taken(place, *crossing.move[upper], part)) continue;
      if (fit_.inside[node] != nobody && fit_.inside[node] != part) continue;
      fit_.on[node] = part;
      fit_.moved[node] = *crossing.move[upper];
      fit_.touches[node] = {crossing.body, place};
      fit_.squeezed += upper != nearer;
      return;
    }
    if (blunt(crossing, part)) return;
    int neighbour = nobody;
    for (const int upper : {0, 1}) {
      const int node = lattice_.node(crossing.end(upper));
      const int other = fit_.on[node] != nobody ? fit_.on[node] : fit_.inside[node];
      if (other != part && other != nobody) neighbour = other;
    }
    ++fit_.unresolved[{part, neighbour}];
  }

  /// Whether the next node on a side of the block already lies where this one would go.
  bool taken(const Place& place, const Vector2& by, int part) const {
    for (int axis = 0; axis < 2; ++axis)
      if (lattice_.on_side(place, 1 - axis))
        for (const int way : {-1, 1}) {
          Place next = place;
          next[axis] += way;
          if (!lattice_.has_node(next) || fit_.on[lattice_.node(next)] != part) continue;
          const double apart = way * lattice_.step(axis) + fit_.moved[lattice_.node(next)][axis] - by[axis];
          if (std::abs(apart) < nearest * lattice_.step(axis)) return true;
        }
    return false;
  }

  /// Where an interface meets a side of the block so flat that the wedge between them is thinner than part of
  /// a square, the interface is led through the node on the side.
  bool blunt(const Crossing& crossing, int part) {
    for (const int upper : {0, 1}) {
      const Place place = crossing.end(upper);
      const int node = lattice_.node(place);
      const bool side = lattice_.on_side(place, crossing.axis),
                 other = lattice_.on_side(place, 1 - crossing.axis);
      if (!side || other || std::abs(crossing.part - upper) > thinnest || fit_.on[node] != nobody) continue;
      if (fit_.inside[node] != nobody && fit_.inside[node] != part) continue;
      fit_.on[node] = part;
      fit_.touches[node] = {crossing.body, place};
      ++fit_.blunted;
      return true;
    }
    return false;
  }

  const Lattice& lattice_;
  const std::vector<Body>& bodies_;
  std::vector<Crossing> crossings_;
  Fit fit_;
};

}  // namespace

Foot Fit::foot(int node, const Vector2& moved_by) const {
  const OnInterface& touch = touches.at(node);
  if (contour) {
    const Vector2 place = lattice.position(touch.seen);
    // Where the grey is flat the node stays.
    return contour->near(place + moved_by).value_or(Foot{place + moved[node], {}});
  }
  return bodies[touch.body].nearest(lattice.position(touch.seen) + moved_by);
}

Fit fit(const Lattice& lattice, const std::vector<Body>& bodies) { return Fitter(lattice, bodies).work(); }

}  // namespace slipscale::morphology
