#pragma once

#include <Eigen/Dense>
#include <array>
#include <span>

#include "slipscale/base/vector2.hpp"

namespace slipscale {

/// Of linear triangles (three corners) and bilinear quadrilaterals (four). `corners` run counter-clockwise,
/// m.

/// Shape functions of the bilinear cell and their derivatives at (ξ, η) in [−1, 1]².
struct Bilinear {
  std::array<double, 4> value;
  std::array<Vector2, 4> slope;  ///< d/dξ, d/dη

  Bilinear(double xi, double eta);
};

/// d(x, y)/d(ξ, η) of a quadrilateral at the place of `shape`: rows ξ, η; columns x, y; m.
Eigen::Matrix2d jacobian(std::span<const Vector2> corners, const Bilinear& shape);

double triangle_area(std::span<const Vector2> corners);  ///< m², negative when clockwise
double cell_area(std::span<const Vector2> corners);      ///< the same of either kind of cell

/// Values of the shape functions at `point` when it lies in the cell (tolerance 1e-9 of its size); false
/// otherwise.
bool shape_values_at(std::span<const Vector2> corners, const Vector2& point, std::array<double, 4>& values);

}  // namespace slipscale
