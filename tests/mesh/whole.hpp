#pragma once

#include <cmath>
#include <ostream>
#include <vector>

#include "scenes.hpp"

namespace slipscale::testing_support {

/// One kind of mesh and one way to cut it: what most tests of a distributed mesh go through.
struct Case {
  Shape shape;
  bool periodic;
  Partitioner partitioner;
  int refine;
};

inline std::vector<Case> all_cases() {
  std::vector<Case> cases;
  for (Shape shape : {Shape::triangles, Shape::quadrilaterals, Shape::mixed})
    for (bool periodic : {false, true}) {
      for (int refine : {0, 1, 2}) cases.push_back({shape, periodic, Partitioner::metis, refine});
      cases.push_back({shape, periodic, Partitioner::simple, 0});
      cases.push_back({shape, periodic, Partitioner::ptscotch, 1});
    }
  return cases;
}

inline std::ostream& operator<<(std::ostream& out, const Case& c) {
  return out << "shape " << static_cast<int>(c.shape) << (c.periodic ? ", periodic" : "") << ", partitioner "
             << static_cast<int>(c.partitioner) << ", refine " << c.refine;
}

/// 6 by 4 cells on [−1, 2] × [0, 1.5] m, inner nodes moved, two regions: `inclusion` is the right half.
inline Block block_of(const Case& c) {
  Block block;
  block.nx = 6;
  block.ny = 4;
  block.width = 3;
  block.height = 1.5;
  block.left = -1;
  block.shape = c.shape;
  block.periodic_x = c.periodic;
  block.distortion = 0.15;
  block.region = [](double x, double) { return x < 0.5 ? 1 : 2; };
  return block;
}

inline Mesh mesh_of(const Case& c) { return block_mesh(block_of(c), c.partitioner, c.refine); }

/// The same mesh, whole on every rank.
inline Mesh whole_mesh_of(const Case& c) {
  const std::string path = scratch("whole.msh");
  write_block(block_of(c), path);
  return read_mesh(PETSC_COMM_SELF, {path, Partitioner::metis, c.refine});
}

template <class Number>
Number over_ranks(Number value, MPI_Op operation = MPI_SUM) {
  auto total = static_cast<double>(value);
  MPI_Allreduce(MPI_IN_PLACE, &total, 1, MPI_DOUBLE, operation, PETSC_COMM_WORLD);
  return static_cast<Number>(total);
}

/// Area of a cell by the shoelace formula, m².
inline double cell_area(const Cells& cells, int cell) {
  double twice = 0;
  const int first = cells.first[cell], n = cells.corner_count(cell);
  for (int k = 0; k < n; ++k) {
    const Vector2 &a = cells.corners[first + k], &b = cells.corners[first + (k + 1) % n];
    twice += a[0] * b[1] - b[0] * a[1];
  }
  return 0.5 * twice;
}

}  // namespace slipscale::testing_support
