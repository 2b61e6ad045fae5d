#include <algorithm>
#include <cmath>
#include <optional>

#include "contour.hpp"
#include "fitting.hpp"

namespace slipscale::morphology {
namespace {

constexpr int inclusion = 0;       ///< the part above the level
constexpr double farthest = 0.75;  ///< in cells, that a node is moved
constexpr double nearest = 0.2;    ///< in cells, that two nodes on a side may come
/// In cells: a tip that reaches past a line of the lattice without meeting a node there is cut off; a longer
/// one is more than a grid of this size can show.
constexpr double deepest_lost = 0.5;
constexpr int slices = 8;  ///< in which a tip is followed as far

/// An edge of the lattice between a node inside and one outside.
struct Crossing {
  int axis;     ///< along which the edge runs
  Place place;  ///< of its lower node
  double part;  ///< of the edge below the crossing
  std::array<std::optional<Vector2>, 2> move;

  Place end(int upper) const {
    Place at = place;
    at[axis] += upper;
    return at;
  }
};

/// All interfaces are of one part: an edge with a node on one of them joins no inside to an outside, and the
/// nearer node of an edge in the block is always free to move.
class ContourFitter {
 public:
  ContourFitter(const Lattice& lattice, const std::vector<Body>& none, const Contour& contour)
      : lattice_(lattice), contour_(contour), fit_{lattice, none, {}, {}, {}, {}, {}, 0, 0, {}, &contour} {
    fit_.inside.assign(lattice.nodes(), nobody);
    fit_.on.assign(lattice.nodes(), nobody);
    fit_.moved.assign(lattice.nodes(), {});
  }

  Fit work() {
    for (int node = 0; node < lattice_.nodes(); ++node)
      if (contour_.inside(lattice_.position(lattice_.place(node)))) fit_.inside[node] = inclusion;
    for (int axis = 0; axis < 2; ++axis)
      for (int node = 0; node < lattice_.nodes(); ++node)
        if (const Place place = lattice_.place(node); place[axis] < lattice_.cells(axis)) look(axis, place);
    for (Crossing& crossing : crossings_)
      for (const int upper : {0, 1}) crossing.move[upper] = move(crossing, upper);
    // As with inclusions: on a side of the block there is one point for its nodes.
    std::ranges::stable_sort(crossings_, {}, [&](const Crossing& c) {
      return std::pair(!leaves_side(c), std::min(cost(c.move[0]), cost(c.move[1])));
    });
    for (const Crossing& crossing : crossings_) settle(crossing);
    return std::move(fit_);
  }

 private:
  /// Of several crossings the nearest two go as a pair, until one or none is left.
  void look(int axis, const Place& place) {
    Place next = place;
    ++next[axis];
    const double from = lattice_.line(axis, place[axis]), to = lattice_.line(axis, next[axis]),
                 at = lattice_.line(1 - axis, place[1 - axis]);
    std::vector<double> found = contour_.crossings(axis, at, from, to);
    while (found.size() > 1) {
      std::size_t least = 0;
      for (std::size_t k = 1; k + 1 < found.size(); ++k)
        if (found[k + 1] - found[k] < found[least + 1] - found[least]) least = k;
      if (!ends(axis, at, found[least], found[least + 1], 1) &&
          !ends(axis, at, found[least], found[least + 1], -1))
        ++fit_.unresolved[{inclusion, nobody}];
      found.erase(found.begin() + static_cast<std::ptrdiff_t>(least),
                  found.begin() + static_cast<std::ptrdiff_t>(least) + 2);
    }
    if (fit_.inside[lattice_.node(place)] == fit_.inside[lattice_.node(next)]) return;
    // Rounding may take a crossing in a node from one of its edges and not from the other.
    const bool upper = std::abs(contour_.above(lattice_.position(next))) <
                       std::abs(contour_.above(lattice_.position(place)));
    const double part = found.empty() ? (upper ? 1 : 0) : (found[0] - from) / (to - from);
    crossings_.push_back({axis, place, part, {}});
  }

  /// Whether what lies between two crossings is a tip that ends soon on this side of the line. It is followed
  /// from line to line, along slopes of 45 degrees at most.
  bool ends(int axis, double at, double low, double high, int way) const {
    const double stride = deepest_lost / slices * lattice_.step(1 - axis);
    Vector2 x{};
    x[axis] = 0.5 * (low + high);
    x[1 - axis] = at;
    const bool phase = contour_.inside(x);
    for (int slice = 1; slice <= slices; ++slice) {
      const double line = at + way * slice * stride, from = low - stride, to = high + stride;
      std::vector<double> bounds = contour_.crossings(axis, line, from, to);
      bounds.insert(bounds.begin(), from);
      bounds.push_back(to);
      x[1 - axis] = line;
      x[axis] = from;
      bool here = contour_.inside(x) == phase;
      double first = 1, last = -1;
      for (std::size_t k = 0; k + 1 < bounds.size(); ++k, here = !here) {
        if (!here) continue;
        if (first > last) first = bounds[k];
        last = bounds[k + 1];
      }
      if (first > last) return true;
      low = first;
      high = last;
    }
    return false;
  }

  /// Along the edge; along the side for nodes on a side of the block.
  std::optional<Vector2> move(const Crossing& crossing, int upper) const {
    constexpr double same = 1e-9;
    const Place place = crossing.end(upper);
    const int axis = crossing.axis, across = 1 - axis;
    const double part = crossing.part - upper;
    Vector2 by{};
    by[axis] = part * lattice_.step(axis);
    if (!lattice_.on_side(place, axis)) return by;
    if (std::abs(part) < same) return Vector2{};
    if (lattice_.on_side(place, across)) return std::nullopt;  // a corner of the block
    const Vector2 from = lattice_.position(place);
    const double reach = farthest * lattice_.step(across);
    by = {};
    bool found = false;
    for (const double x : contour_.crossings(across, from[axis], from[across] - reach, from[across] + reach))
      if (!found || std::abs(x - from[across]) < std::abs(by[across])) {
        by[across] = x - from[across];
        found = true;
      }
    return found ? std::optional(by) : std::nullopt;
  }

  bool leaves_side(const Crossing& c) const {
    return lattice_.on_side(c.end(0), c.axis) || lattice_.on_side(c.end(1), c.axis);
  }

  double cost(const std::optional<Vector2>& move) const {
    return move ? std::hypot((*move)[0] / lattice_.step(0), (*move)[1] / lattice_.step(1)) : 1e300;
  }

  /// The nearer node of the edge is moved, or else the farther. Where neither can, the interface meets a side
  /// too flat or too near to a corner: it is led through the node there.
  void settle(const Crossing& crossing) {
    for (const int upper : {0, 1})
      if (fit_.on[lattice_.node(crossing.end(upper))] != nobody) return;
    const int nearer = cost(crossing.move[1]) < cost(crossing.move[0]) ? 1 : 0;
    for (const int upper : {nearer, 1 - nearer}) {
      const Place place = crossing.end(upper);
      if (cost(crossing.move[upper]) > farthest || taken(place, *crossing.move[upper])) continue;
      fit_.squeezed += upper != nearer;
      return put(place, *crossing.move[upper]);
    }
    ++fit_.blunted;
    put(crossing.end(crossing.part > 0.5 ? 1 : 0), {});
  }

  void put(const Place& place, const Vector2& by) {
    const int node = lattice_.node(place);
    fit_.on[node] = inclusion;
    fit_.moved[node] = by;
    fit_.touches[node] = {inclusion, place};
  }

  /// Whether the next node on a side of the block already lies where this one would go.
  bool taken(const Place& place, const Vector2& by) const {
    for (int axis = 0; axis < 2; ++axis)
      if (lattice_.on_side(place, 1 - axis))
        for (const int way : {-1, 1}) {
          Place next = place;
          next[axis] += way;
          if (!lattice_.has_node(next)) continue;
          const double apart = way * lattice_.step(axis) + fit_.moved[lattice_.node(next)][axis] - by[axis];
          if (way * apart < nearest * lattice_.step(axis)) return true;
        }
    return false;
  }

  const Lattice& lattice_;
  const Contour& contour_;
  std::vector<Crossing> crossings_;
  Fit fit_;
};

}  // namespace

Fit fit(const Lattice& lattice, const std::vector<Body>& none, const Contour& contour) {
  return ContourFitter(lattice, none, contour).work();
}

}  // namespace slipscale::morphology
