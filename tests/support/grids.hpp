#pragma once

#include <cmath>
#include <functional>

#include "block_mesh.hpp"
#include "slipscale/mesh/plane_grid.hpp"

namespace slipscale::testing_support {

/// The structured rectangle of `Block`, with its shapes, distortion and regions, as a plain grid; `lower` is
/// its lower left corner.
inline PlaneGrid block_grid(const Block& block, const Vector2& lower = {}) {
  PlaneGrid grid;
  grid.regions = {"matrix", "inclusion"};
  const double dx = block.width / block.nx, dy = block.height / block.ny;
  for (int j = 0; j <= block.ny; ++j)
    for (int i = 0; i <= block.nx; ++i) {
      const bool inside = i > 0 && i < block.nx && j > 0 && j < block.ny;
      const double move = inside ? block.distortion : 0;
      grid.points.push_back({lower[0] + dx * (i + move * std::sin(12.9898 * i + 78.233 * j)),
                             lower[1] + dy * (j + move * std::sin(39.346 * i + 11.135 * j))});
    }
  const auto add = [&](std::initializer_list<int> corners, int region) {
    grid.corners.insert(grid.corners.end(), corners);
    grid.first.push_back(static_cast<int>(grid.corners.size()));
    grid.region.push_back(region - 1);
  };
  for (int j = 0; j < block.ny; ++j)
    for (int i = 0; i < block.nx; ++i) {
      const int a = j * (block.nx + 1) + i, b = a + 1, d = a + block.nx + 1, c = d + 1;
      const int region = block.region(lower[0] + dx * (i + 0.5), lower[1] + dy * (j + 0.5));
      if (block.shape == Shape::quadrilaterals || (block.shape == Shape::mixed && (i + j) % 2 == 0)) {
        add({a, b, c, d}, region);
      } else {
        add({a, b, c}, region);
        add({a, c, d}, region);
      }
    }
  return grid;
}

/// Of triangles, quadrilaterals and both.
inline std::array<Block, 3> distorted_blocks(int nx, int ny, double distortion) {
  std::array<Block, 3> blocks;
  const Shape shapes[] = {Shape::triangles, Shape::quadrilaterals, Shape::mixed};
  for (std::size_t k = 0; k < 3; ++k) {
    blocks[k].nx = nx;
    blocks[k].ny = ny;
    blocks[k].shape = shapes[k];
    blocks[k].distortion = distortion;
  }
  return blocks;
}

}  // namespace slipscale::testing_support
