#pragma once

#include <functional>
#include <string>

namespace slipscale::testing_support {

enum class Shape { triangles, quadrilaterals, mixed };

/// A structured rectangle, written as MSH 4.1 text so that tests need no mesh generator.
/// Regions: `region(x, y)` of a cell's centre gives 1 or 2, named `matrix` and `inclusion` (the second only
/// when used). Boundaries: bottom, top, left, right.
struct Block {
  int nx = 4, ny = 4;
  double width = 1, height = 1;  ///< m
  double left = 0;               ///< x of the left side, m
  Shape shape = Shape::triangles;
  bool mirrored = false;    ///< triangles: the other diagonal
  bool periodic_x = false;  ///< left and right carry matching nodes
  bool periodic_y = false;  ///< bottom and top do
  double distortion = 0;    ///< inner nodes are moved by up to this part of the spacing, by a fixed pattern
  std::function<int(double, double)> region = [](double, double) { return 1; };
};

/// Writes the mesh on rank 0 of PETSC_COMM_WORLD; every rank may read it on return.
void write_block(const Block& block, const std::string& path);

/// A file name below the system's folder for temporary files, the same on every rank, new for every call.
/// Collective.
std::string scratch(const std::string& name);

/// Removes what `scratch` made room for; main() does when all tests have passed.
void remove_scratch();

}  // namespace slipscale::testing_support
