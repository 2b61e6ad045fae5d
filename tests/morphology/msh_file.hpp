#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "slipscale/base/vector2.hpp"

namespace slipscale::testing_support {

/// What a MSH 4.1 text file holds, read without gmsh.
struct MshFile {
  std::map<long, Vector2> nodes;
  struct Cell {
    int surface;  ///< tag of its entity
    std::vector<long> corners;
  };
  std::vector<Cell> cells;
  struct Pair {
    int dimension;
    Vector2 shift;  ///< of the affine map, m
    long node, master;
  };
  std::vector<Pair> pairs;
};

MshFile read_msh(const std::string& path);

}  // namespace slipscale::testing_support
