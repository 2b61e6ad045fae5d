#pragma once

#include <array>
#include <string>
#include <vector>

#include "slipscale/base/vector2.hpp"

namespace slipscale {

/// A mesh as it is looked at before it is written.
struct CompositeMesh {
  struct Cell {
    std::array<int, 4> corners{};  ///< nodes, counter-clockwise
    int count = 3;                 ///< corners in use
    int region = 0;
    int inclusion = -1;  ///< that it is part of; -1 in the matrix
  };
  std::vector<Vector2> nodes;  ///< m
  std::vector<Cell> cells;
  std::vector<std::string> regions;  ///< names; 0 is the matrix

  std::vector<Vector2> corners(const Cell& cell) const {
    std::vector<Vector2> x;
    for (int i = 0; i < cell.count; ++i) x.push_back(nodes[cell.corners[i]]);
    return x;
  }
};

}  // namespace slipscale
