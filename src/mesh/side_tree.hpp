#pragma once

#include <petscsys.h>

#include <vector>

#include "slipscale/base/box.hpp"

namespace slipscale::mesh_stages {

/// A side of a cell that has none beyond it.
struct OuterSide {
  PetscInt from = 0, to = 0;  ///< vertices, counter-clockwise around the cell
  Vector2 a{}, b{};           ///< where the cell sees them, m
};

/// Finds sides that may touch: those whose boxes do. A binary tree of boxes, each of which holds half of the
/// sides of the one above.
class SideTree {
 public:
  explicit SideTree(std::vector<OuterSide> sides);

  const std::vector<OuterSide>& sides() const { return sides_; }

  /// Calls `visit(one, two)` for each such pair of indices when the second is moved by `shift`. Both orders
  /// come, and a side with itself. Ends when `visit` returns false; returns false then.
  template <class Visit>
  bool near(const Vector2& shift, Visit visit) const {
    return sides_.empty() || join({0, 0, sides_.size()}, {0, 0, sides_.size()}, shift, visit);
  }

 private:
  static constexpr std::size_t leaf = 4;  ///< sides
  struct Part {
    std::size_t box, begin, end;
    std::size_t size() const { return end - begin; }
    Part low() const { return {2 * box + 1, begin, begin + size() / 2}; }
    Part high() const { return {2 * box + 2, begin + size() / 2, end}; }
  };

  void build(const Part& part);
  bool touch(const Box& one, const Box& two, const Vector2& shift) const;

  template <class Visit>
  bool join(const Part& one, const Part& two, const Vector2& shift, Visit& visit) const {
    if (!touch(boxes_[one.box], boxes_[two.box], shift)) return true;
    if (one.size() <= leaf && two.size() <= leaf) {
      for (std::size_t i = one.begin; i < one.end; ++i)
        for (std::size_t j = two.begin; j < two.end; ++j)
          if (touch(box_of(sides_[i]), box_of(sides_[j]), shift) && !visit(i, j)) return false;
      return true;
    }
    if (two.size() > one.size())
      return join(one, two.low(), shift, visit) && join(one, two.high(), shift, visit);
    return join(one.low(), two, shift, visit) && join(one.high(), two, shift, visit);
  }

  static Box box_of(const OuterSide& side);  ///< a little larger, by what counts as touching

  std::vector<OuterSide> sides_;
  std::vector<Box> boxes_;
};

}  // namespace slipscale::mesh_stages
