#pragma once

#include <array>

#include "slipscale/base/box.hpp"

namespace slipscale::morphology {

/// Column and row.
using Place = std::array<int, 2>;

/// Nodes of a Cartesian grid of columns × rows squares, row by row from the bottom. Along a periodic axis
/// the last line of nodes is the first one again, and places may be counted on beyond it.
class Lattice {
 public:
  Lattice(const Box& block, const std::array<bool, 2>& periodic, const std::array<int, 2>& cells)
      : block_(block), periodic_(periodic), cells_(cells) {
    for (int axis = 0; axis < 2; ++axis) {
      lines_[axis] = cells[axis] + (periodic[axis] ? 0 : 1);
      step_[axis] = block.extent(axis) / cells[axis];
    }
  }

  const Box& block() const { return block_; }
  bool periodic(int axis) const { return periodic_[axis]; }
  int cells(int axis) const { return cells_[axis]; }
  int lines(int axis) const { return lines_[axis]; }   ///< of nodes that differ
  double step(int axis) const { return step_[axis]; }  ///< m
  int nodes() const { return lines_[0] * lines_[1]; }

  int node(const Place& place) const { return wrapped(place[1], 1) * lines_[0] + wrapped(place[0], 0); }
  Place place(int node) const { return {node % lines_[0], node / lines_[0]}; }
  bool has_square(const Place& low) const { return has(low, cells_); }
  bool has_node(const Place& place) const { return has(place, lines_); }

  double line(int axis, int k) const {
    return k == cells_[axis] ? block_.upper[axis] : block_.lower[axis] + k * step_[axis];
  }
  Vector2 position(const Place& place) const { return {line(0, place[0]), line(1, place[1])}; }
  /// On a side of the block across the axis, periodic or not.
  bool on_side(const Place& place, int axis) const { return place[axis] % cells_[axis] == 0; }

 private:
  int wrapped(int k, int axis) const { return (k % lines_[axis] + lines_[axis]) % lines_[axis]; }
  bool has(const Place& place, const std::array<int, 2>& count) const {
    for (int axis = 0; axis < 2; ++axis)
      if (!periodic_[axis] && (place[axis] < 0 || place[axis] >= count[axis])) return false;
    return true;
  }

  Box block_;
  std::array<bool, 2> periodic_;
  std::array<int, 2> cells_, lines_;
  std::array<double, 2> step_;
};

}  // namespace slipscale::morphology
