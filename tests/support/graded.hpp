#pragma once

#include <algorithm>
#include <functional>
#include <memory>

#include "slipscale/mesh/mesh.hpp"
#include "slipscale/solid/material.hpp"

namespace slipscale::testing_support {

/// A material whose cells have `base` times a factor >= 1 of their place, stiffness and density by different
/// ones. Collective.
inline Material graded(const Mesh& mesh, Material base, const std::function<double(const Vector2&)>& stiffer,
                       const std::function<double(const Vector2&)>& heavier) {
  auto grading = std::make_shared<Grading>();
  for (int cell = 0; cell < mesh.cells.size(); ++cell) {
    Vector2 middle{};
    const auto corners = mesh.cells.corners_of(cell);
    for (const Vector2& x : corners)
      for (int axis = 0; axis < 2; ++axis) middle[axis] += x[axis] / static_cast<double>(corners.size());
    grading->of_cell.push_back({base.stiffness * stiffer(middle), base.density * heavier(middle)});
    grading->modulus = std::max(grading->modulus, grading->of_cell.back().stiffness.cwiseAbs().maxCoeff());
  }
  MPI_Allreduce(MPI_IN_PLACE, &grading->modulus, 1, MPI_DOUBLE, MPI_MAX, mesh.comm);
  grading->fastest = {base.stiffness, base.density};
  base.grading = std::move(grading);
  return base;
}

}  // namespace slipscale::testing_support
