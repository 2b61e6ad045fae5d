#include "slipscale/morphology/drawing.hpp"

#include <algorithm>
#include <map>
#include <stdexcept>

namespace slipscale {
namespace {

/// A place on the rim of the block: counter-clockwise from the lower left corner, one side after the other.
double place_on_rim(const Vertex& vertex, const Box& block) {
  const double across = (vertex.x[0] - block.lower[0]) / block.width(),
               up = (vertex.x[1] - block.lower[1]) / block.height();
  if (vertex.sides & bottom && !(vertex.sides & left)) return across;
  if (vertex.sides & right) return 1 + up;
  if (vertex.sides & top) return 3 - across;
  return vertex.sides & bottom ? 0 : 4 - up;
}

struct Rim {
  int point;
  unsigned sides;
  double place;
};

class Drafter {
 public:
  Drafter(const Box& block, const std::vector<Piece>& pieces) : block_(block), pieces_(pieces) {}

  Drawing draw() {
    add_block_corners();
    for (std::size_t k = 0; k < pieces_.size(); ++k) add_piece(static_cast<int>(k));
    std::ranges::sort(rim_, {}, &Rim::place);
    add_matrix();
    return std::move(drawing_);
  }

 private:
  int add_point(const Vector2& x) {
    drawing_.points.push_back(x);
    return static_cast<int>(drawing_.points.size()) - 1;
  }

  int add_rim_point(const Vertex& vertex) {
    const int point = add_point(vertex.x);
    rim_.push_back({point, vertex.sides, place_on_rim(vertex, block_)});
    return point;
  }

  int add_segment(int from, int to, unsigned sides) {
    drawing_.segments.push_back({from, to, sides});
    return static_cast<int>(drawing_.segments.size());
  }

  void add_block_corners() {
    for (const unsigned sides : {left | bottom, right | bottom, right | top, left | top})
      corner_[sides] = add_rim_point({{sides & left ? block_.lower[0] : block_.upper[0],
                                       sides & bottom ? block_.lower[1] : block_.upper[1]},
                                      sides});
  }

  int point_of(const Vertex& vertex) {
    if (const auto corner = corner_.find(vertex.sides); corner != corner_.end()) return corner->second;
    return vertex.sides ? add_rim_point(vertex) : add_point(vertex.x);
  }

  void add_piece(int k) {
    const Piece& piece = pieces_[k];
    const std::size_t count = piece.corners.size();
    std::vector<int> points;
    for (const Vertex& vertex : piece.corners) points.push_back(point_of(vertex));
    Drawing::Loop loop;
    bool touches = false;
    for (std::size_t i = 0; i < count; ++i) {
      const std::size_t j = (i + 1) % count;
      const unsigned sides = piece.corners[i].sides & piece.corners[j].sides;
      loop.push_back(add_segment(points[i], points[j], sides));
      touches |= sides != 0;
      if (sides)
        covered_[points[i]] = points[j];
      else
        outline_to_[points[j]] = loop.back();
    }
    if (!touches) holes_.push_back(loop);
    drawing_.faces.push_back({{loop}, piece.region, piece.inclusion});
  }

  /// The part of the rim that begins at rim_[i] as a segment of the matrix, or 0 where a piece covers it.
  int rim_segment(std::size_t i) {
    const Rim &from = rim_[i], &to = rim_[(i + 1) % rim_.size()];
    if (const auto piece = covered_.find(from.point); piece != covered_.end() && piece->second == to.point)
      return 0;
    return add_segment(from.point, to.point, from.sides & to.sides);
  }

  /// Walks each part of the matrix along the rim, and back along the outlines of the pieces that cut it.
  void add_matrix() {
    std::map<int, std::pair<int, std::size_t>> matrix_from;  // point -> segment, place in rim_
    for (std::size_t i = 0; i < rim_.size(); ++i)
      if (const int segment = rim_segment(i)) matrix_from[rim_[i].point] = {segment, i};
    std::vector<Drawing::Loop> outlines;
    while (!matrix_from.empty()) {
      Drawing::Loop loop;
      const int start = matrix_from.begin()->first;
      int at = start;
      do {
        if (const auto next = matrix_from.find(at); next != matrix_from.end()) {
          loop.push_back(next->second.first);
          at = drawing_.segments[next->second.first - 1].to;
          matrix_from.erase(next);
        } else {
          const auto back = outline_to_.find(at);
          if (back == outline_to_.end())
            throw std::logic_error("the matrix has an open outline: two pieces touch");
          loop.push_back(-back->second);
          at = drawing_.segments[back->second - 1].from;
        }
      } while (at != start);
      outlines.push_back(loop);
    }
    add_matrix_faces(outlines);
  }

  std::vector<Vector2> corners_of(const Drawing::Loop& loop) const {
    std::vector<Vector2> corners;
    for (int segment : loop) {
      const auto& s = drawing_.segments[std::abs(segment) - 1];
      corners.push_back(drawing_.points[segment > 0 ? s.from : s.to]);
    }
    return corners;
  }

  static bool contains(const std::vector<Vector2>& corners, const Vector2& x) {
    bool in = false;
    for (std::size_t i = 0, j = corners.size() - 1; i < corners.size(); j = i++) {
      const Vector2 &a = corners[i], &b = corners[j];
      if ((a[1] > x[1]) != (b[1] > x[1]) && x[0] < (b[0] - a[0]) * (x[1] - a[1]) / (b[1] - a[1]) + a[0])
        in = !in;
    }
    return in;
  }

  void add_matrix_faces(const std::vector<Drawing::Loop>& outlines) {
    const std::size_t first = drawing_.faces.size();
    std::vector<std::vector<Vector2>> corners;
    for (const Drawing::Loop& outline : outlines) {
      drawing_.faces.push_back({{outline}, 0, -1});
      corners.push_back(corners_of(outline));
    }
    for (const Drawing::Loop& hole : holes_) {
      const Vector2& x = drawing_.points[drawing_.segments[hole.front() - 1].from];
      for (std::size_t k = 0; k < outlines.size(); ++k)
        if (outlines.size() == 1 || contains(corners[k], x)) {
          Drawing::Loop reversed;
          for (auto segment = hole.rbegin(); segment != hole.rend(); ++segment) reversed.push_back(-*segment);
          drawing_.faces[first + k].loops.push_back(reversed);
          break;
        }
    }
  }

  const Box& block_;
  const std::vector<Piece>& pieces_;
  Drawing drawing_;
  std::map<unsigned, int> corner_;  ///< Side bits of two sides -> point
  std::vector<Rim> rim_;
  std::map<int, int> covered_;  ///< rim point -> next rim point, where a piece lies on the rim between them
  std::map<int, int> outline_to_;  ///< point -> segment of a piece's outline in the block that ends there
  std::vector<Drawing::Loop> holes_;
};

}  // namespace

std::vector<int> Drawing::side(Side side) const {
  const int axis = side == bottom || side == top ? 0 : 1;
  std::vector<int> found;
  for (std::size_t k = 0; k < segments.size(); ++k)
    if (segments[k].sides & side) found.push_back(static_cast<int>(k) + 1);
  std::ranges::sort(found, {}, [&](int k) {
    return std::min(points[segments[k - 1].from][axis], points[segments[k - 1].to][axis]);
  });
  return found;
}

Drawing draw(const Box& block, const std::vector<Piece>& pieces) { return Drafter(block, pieces).draw(); }

}  // namespace slipscale
