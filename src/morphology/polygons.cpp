#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "sides.hpp"
#include "slipscale/mesh/shape_functions.hpp"
#include "slipscale/morphology/drawing.hpp"

namespace slipscale {
namespace {

/// A corner of a piece that may be moved along `way` to correct the area.
struct Corner {
  Vertex at;
  Vector2 way{};  ///< outward normal times curvature times half width; zero on sides
};

/// One copy of the block's rectangle in the periodic plane.
using Tile = std::array<int, 2>;

struct CutInclusion {
  std::map<Tile, std::vector<Corner>> pieces;
};

double extent(const Box& block, int axis) { return block.upper[axis] - block.lower[axis]; }

/// The lines x[axis] = low + k extent that the inclusion reaches, as k.
std::vector<int> lines(const Inclusion& inclusion, const Room& room, int axis) {
  const double length = extent(room.block, axis);
  const Vector2 n = axis == 0 ? Vector2{1, 0} : Vector2{0, 1};
  const double from = inclusion.centre[axis] - support(inclusion, {-n[0], -n[1]}) - room.block.lower[axis],
               to = inclusion.centre[axis] + support(inclusion, n) - room.block.lower[axis];
  std::vector<int> found;
  for (int k = static_cast<int>(std::ceil(from / length)); k * length <= to; ++k)
    if (room.periodic[axis] || k == 0 || k == 1) found.push_back(k);
  return found;
}

struct Crossing {
  double t;
  int axis, line;
};

std::vector<Crossing> all_crossings(const Inclusion& inclusion, const Room& room) {
  std::vector<Crossing> found;
  for (int axis = 0; axis < 2; ++axis)
    for (int line : lines(inclusion, room, axis))
      for (double t : crossings(inclusion, axis, room.block.lower[axis] + line * extent(room.block, axis)))
        found.push_back({t, axis, line});
  std::ranges::sort(found, {}, &Crossing::t);
  return found;
}

Tile tile_of(const Vector2& x, const Box& block) {
  return {static_cast<int>(std::floor((x[0] - block.lower[0]) / extent(block, 0))),
          static_cast<int>(std::floor((x[1] - block.lower[1]) / extent(block, 1)))};
}

bool in_body(const Tile& tile, const Room& room) {
  return (room.periodic[0] || tile[0] == 0) && (room.periodic[1] || tile[1] == 0);
}

/// The point moved into the block from its tile; exactly on the side when it is a crossing.
Vertex in_block(Vector2 x, const Tile& tile, const Box& block, const Crossing* crossing) {
  Vertex vertex;
  for (int axis = 0; axis < 2; ++axis) x[axis] -= tile[axis] * extent(block, axis);
  if (crossing) {
    const bool low = crossing->line == tile[crossing->axis];
    x[crossing->axis] = low ? block.lower[crossing->axis] : block.upper[crossing->axis];
    vertex.sides = crossing->axis == 0 ? (low ? left : right) : (low ? bottom : top);
  }
  vertex.x = x;
  return vertex;
}

/// Values of t at which straight sides and rounded corners of a rectangle meet, ascending over one turn.
std::vector<double> seams(const Inclusion& inclusion) {
  if (inclusion.shape != Shape::rectangle) return {};
  const double arc = 0.5 * std::numbers::pi * inclusion.corner,
               half_short = inclusion.half_width - inclusion.corner,
               half_long = inclusion.half_length - inclusion.corner, whole = perimeter(inclusion);
  std::vector<double> at{half_short / whole};
  for (const double piece : {arc, 2 * half_long, arc, 2 * half_short, arc, 2 * half_long, arc})
    at.push_back(at.back() + piece / whole);
  return at;
}

/// Values of t that divide the outline from t0 to t1 into at least `least` parts of about `length`, both ends
/// included. Curved parts between seams get a point of their own, because only such points correct the area.
std::vector<double> division(const Inclusion& inclusion, double t0, double t1, double length, int least) {
  std::vector<double> ends{t0};
  for (const int turn : {0, 1})
    for (const double seam : seams(inclusion))
      if (seam + turn > t0 + 1e-9 && seam + turn < t1 - 1e-9 && seam + turn > ends.back() + 1e-9)
        ends.push_back(seam + turn);
  ends.push_back(t1);
  std::vector<double> at{t0};
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    const double span = ends[i + 1] - ends[i];
    const bool curved = outline(inclusion, ends[i] + 0.5 * span).curvature > 0;
    const int count = std::max({1, curved ? 2 : 1, ends.size() == 2 ? least : 1,
                                static_cast<int>(std::lround(span * perimeter(inclusion) / length))});
    for (int k = 1; k <= count; ++k) at.push_back(ends[i] + k * span / count);
  }
  return at;
}

/// Corners along the outline from t0 to t1; the ends are crossings, or else the same point.
void add_arc(CutInclusion& cut, const Inclusion& inclusion, const Room& room, double length, double t0,
             double t1, const Crossing* first, const Crossing* last) {
  const Tile tile = tile_of(outline(inclusion, 0.5 * (t0 + t1)).x, room.block);
  if (!in_body(tile, room)) return;
  auto& piece = cut.pieces[tile];
  const std::vector<double> at = division(inclusion, t0, t1, length, first ? 2 : 6);
  for (std::size_t i = 0; i < at.size(); ++i) {
    const Crossing* crossing = i == 0 ? first : i + 1 == at.size() ? last : nullptr;
    if (i + 1 == at.size() && !last) break;
    const OutlinePoint point = outline(inclusion, at[i]);
    const double weight = crossing ? 0 : point.curvature * inclusion.half_width;
    piece.push_back({in_block(point.x, tile, room.block, crossing),
                     {weight * point.normal[0], weight * point.normal[1]}});
  }
}

bool inside(const Inclusion& inclusion, const Vector2& x) {
  Inclusion point;
  point.centre = x;
  return separation(inclusion, point) < 0;
}

/// The block's own corners that lie in the inclusion belong to its pieces.
void add_block_corners(CutInclusion& cut, const Inclusion& inclusion, const Room& room) {
  const Box& block = room.block;
  for (auto& [tile, piece] : cut.pieces)
    for (const unsigned sides : {left | bottom, right | bottom, right | top, left | top}) {
      const Vector2 x{sides & left ? block.lower[0] : block.upper[0],
                      sides & bottom ? block.lower[1] : block.upper[1]};
      if (inside(inclusion, {x[0] + tile[0] * extent(block, 0), x[1] + tile[1] * extent(block, 1)}))
        piece.push_back({{x, sides}});
    }
}

void sort_around_middle(std::vector<Corner>& corners) {
  Vector2 middle{};
  for (const Corner& corner : corners)
    for (int axis = 0; axis < 2; ++axis)
      middle[axis] += corner.at.x[axis] / static_cast<double>(corners.size());
  std::ranges::sort(corners, {}, [&](const Corner& corner) {
    return std::atan2(corner.at.x[1] - middle[1], corner.at.x[0] - middle[0]);
  });
}

CutInclusion cut_at_sides(const Inclusion& inclusion, const Room& room, double length) {
  CutInclusion cut;
  const std::vector<Crossing> all = all_crossings(inclusion, room);
  if (all.empty()) {
    add_arc(cut, inclusion, room, length, 0, 1, nullptr, nullptr);
  } else {
    for (std::size_t i = 0; i < all.size(); ++i) {
      const Crossing& first = all[i];
      const Crossing& last = all[(i + 1) % all.size()];
      add_arc(cut, inclusion, room, length, first.t, last.t + (i + 1 == all.size() ? 1 : 0), &first, &last);
    }
    add_block_corners(cut, inclusion, room);
  }
  for (auto& [tile, piece] : cut.pieces) sort_around_middle(piece);
  return cut;
}

double area_moved(const CutInclusion& cut, double distance) {
  double sum = 0;
  for (const auto& [tile, piece] : cut.pieces) {
    std::vector<Vector2> corners;
    for (const Corner& corner : piece)
      corners.push_back(
          {corner.at.x[0] + distance * corner.way[0], corner.at.x[1] + distance * corner.way[1]});
    sum += polygon_area(corners);
  }
  return sum;
}

/// The distance that gives the pieces together the area `wanted`; secant, the area being quadratic in it.
double correction(const CutInclusion& cut, double wanted, double scale) {
  double before = 0, at = 1e-3 * scale;
  double error_before = area_moved(cut, before) - wanted;
  for (int i = 0; i < 50; ++i) {
    const double error = area_moved(cut, at) - wanted;
    if (std::abs(error) <= 1e-13 * wanted || error == error_before) break;
    const double next = at - error * (at - before) / (error - error_before);
    before = at;
    error_before = error;
    at = next;
  }
  return at;
}

}  // namespace

double polygon_area(const std::vector<Vector2>& corners) { return cell_area(corners); }

std::vector<Piece> polygons(const std::vector<Inclusion>& inclusions, const Room& room, double length) {
  std::vector<Piece> pieces;
  for (std::size_t k = 0; k < inclusions.size(); ++k) {
    const Inclusion& inclusion = inclusions[k];
    const CutInclusion cut = cut_at_sides(inclusion, room, length);
    const double distance = correction(cut, morphology::area_in_block(inclusion, room), inclusion.half_width);
    for (const auto& [tile, corners] : cut.pieces) {
      Piece piece{{}, static_cast<int>(k), inclusion.family + 1};
      for (const Corner& corner : corners)
        piece.corners.push_back(
            {{corner.at.x[0] + distance * corner.way[0], corner.at.x[1] + distance * corner.way[1]},
             corner.at.sides});
      pieces.push_back(std::move(piece));
    }
  }
  return pieces;
}

}  // namespace slipscale
