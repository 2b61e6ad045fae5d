#include <algorithm>
#include <cmath>

#include "slipscale/base/error.hpp"
#include "slipscale/base/print.hpp"
#include "slipscale/morphology/drawing.hpp"

namespace slipscale {
namespace {

/// The part of a convex polygon with n·x <= at; corners on the cut lie on it exactly as computed.
std::vector<Vertex> half(const std::vector<Vertex>& polygon, const Vector2& n, double at) {
  std::vector<Vertex> kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vertex &a = polygon[i], &b = polygon[(i + 1) % polygon.size()];
    const double over_a = n[0] * a.x[0] + n[1] * a.x[1] - at, over_b = n[0] * b.x[0] + n[1] * b.x[1] - at;
    if (over_a <= 0) kept.push_back(a);
    if ((over_a <= 0) == (over_b <= 0)) continue;
    const double part = over_a / (over_a - over_b);
    Vertex cut{{a.x[0] + part * (b.x[0] - a.x[0]), a.x[1] + part * (b.x[1] - a.x[1])}, a.sides & b.sides};
    for (int axis = 0; axis < 2;
         ++axis)  // along a side this coordinate does not change, not even by rounding
      if (a.x[axis] == b.x[axis]) cut.x[axis] = a.x[axis];
    kept.push_back(cut);
  }
  return kept;
}

std::vector<Vertex> rectangle(const Box& block) {
  return {{block.lower, left | bottom},
          {{block.upper[0], block.lower[1]}, right | bottom},
          {block.upper, right | top},
          {{block.lower[0], block.upper[1]}, left | top}};
}

/// Along a periodic axis the extent of the block must hold a whole number of periods.
void refuse_misfit(const Laminate& laminate, const Room& room, const Vector2& n) {
  for (int axis = 0; axis < 2; ++axis) {
    const double periods =
        (axis == 0 ? room.block.width() : room.block.height()) * std::abs(n[axis]) / laminate.period;
    if (!room.periodic[axis] || std::abs(periods - std::round(periods)) < 1e-9 * std::max(1.0, periods))
      continue;
    throw UserError("the layers do not continue across the periodic sides: the block holds " +
                    format("{:.6g} periods along {}; ", periods, axis == 0 ? 'x' : 'y') +
                    (std::round(periods) >= 1 ? format("give -layer_period {:.15g}",
                                                       laminate.period * periods / std::round(periods))
                                              : std::string("give a smaller -layer_period")) +
                    ", or change -angle");
  }
}

/// How near interfaces come to a corner of the block, or to a side that they are parallel to.
double nearness(const Laminate& laminate, const Box& block, const Vector2& n, double origin) {
  double nearest = laminate.period;
  for (const double x : {block.lower[0], block.upper[0]})
    for (const double y : {block.lower[1], block.upper[1]})
      for (const double face : {-0.5, 0.5}) {
        const double phase = (n[0] * x + n[1] * y - origin) / laminate.period - face * laminate.fraction;
        nearest = std::min(nearest, std::abs(phase - std::round(phase)) * laminate.period);
      }
  return nearest;
}

/// Points on opposite periodic sides are made equal bit by bit.
void match_sides(std::vector<Piece>& pieces, const Room& room) {
  for (int axis = 0; axis < 2; ++axis) {
    if (!room.periodic[axis]) continue;
    const unsigned low = axis == 0 ? left : bottom, high = axis == 0 ? right : top;
    std::vector<double> at;
    for (const Piece& piece : pieces)
      for (const Vertex& corner : piece.corners)
        if (corner.sides & low) at.push_back(corner.x[1 - axis]);
    for (Piece& piece : pieces)
      for (Vertex& corner : piece.corners)
        if (corner.sides & high)
          corner.x[1 - axis] = *std::ranges::min_element(
              at, {}, [&](double value) { return std::abs(value - corner.x[1 - axis]); });
  }
}

/// So that one lies in the middle of the block, or else as far from its corners as can be.
double origin_of(const Laminate& laminate, const Box& block, const Vector2& n, double clearance) {
  const double middle =
      0.5 * (n[0] * (block.lower[0] + block.upper[0]) + n[1] * (block.lower[1] + block.upper[1]));
  double origin = middle;  // centre line of a layer of inclusion
  if (nearness(laminate, block, n, origin) < clearance)
    for (int i = 1; i < 64; ++i)
      if (const double shifted = middle + i * laminate.period / 64;
          nearness(laminate, block, n, shifted) > nearness(laminate, block, n, origin))
        origin = shifted;
  return origin;
}

}  // namespace

LayerStack stack(const Laminate& laminate, const Room& room, double clearance) {
  LayerStack stack{{-std::sin(laminate.angle), std::cos(laminate.angle)}, {}};
  Vector2& n = stack.normal;
  for (double& component : n)  // a quarter turn is one exactly
    if (std::abs(component - std::round(component)) < 1e-14) component = std::round(component);
  refuse_misfit(laminate, room, n);
  const double origin = origin_of(laminate, room.block, n, clearance);
  double from = 0, to = 0;
  for (const Vertex& corner : rectangle(room.block)) {
    const double at = (n[0] * corner.x[0] + n[1] * corner.x[1] - origin) / laminate.period;
    from = std::min(from, std::floor(at));
    to = std::max(to, std::ceil(at));
  }
  for (double k = from; k <= to; ++k)
    stack.layers.push_back({static_cast<int>(k - from),
                            origin + (k - 0.5 * laminate.fraction) * laminate.period,
                            origin + (k + 0.5 * laminate.fraction) * laminate.period});
  return stack;
}

std::vector<Piece> layers(const Laminate& laminate, const Room& room, double clearance) {
  const LayerStack drawn = stack(laminate, room, clearance);
  const Vector2& n = drawn.normal;
  std::vector<Piece> pieces;
  for (const LayerStack::Layer& layer : drawn.layers) {
    const auto corners = half(half(rectangle(room.block), n, layer.high), {-n[0], -n[1]}, -layer.low);
    if (corners.size() >= 3) pieces.push_back({corners, layer.number, 1});
  }
  match_sides(pieces, room);
  return pieces;
}

}  // namespace slipscale
