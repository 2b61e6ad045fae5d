#include "slipscale/mesh/shape_functions.hpp"

namespace slipscale {

Bilinear::Bilinear(double xi, double eta) {
  static constexpr std::array<Vector2, 4> sign{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
  for (int k = 0; k < 4; ++k) {
    value[k] = 0.25 * (1 + sign[k][0] * xi) * (1 + sign[k][1] * eta);
    slope[k] = {0.25 * sign[k][0] * (1 + sign[k][1] * eta), 0.25 * sign[k][1] * (1 + sign[k][0] * xi)};
  }
}

Eigen::Matrix2d jacobian(std::span<const Vector2> corners, const Bilinear& shape) {
  Eigen::Matrix2d j = Eigen::Matrix2d::Zero();
  for (int k = 0; k < 4; ++k)
    for (int row = 0; row < 2; ++row)
      for (int axis = 0; axis < 2; ++axis) j(row, axis) += shape.slope[k][row] * corners[k][axis];
  return j;
}

double triangle_area(std::span<const Vector2> x) { return cell_area(x.first(3)); }

double cell_area(std::span<const Vector2> x) {
  // As seen from the first corner, so that it is as exact far from the origin.
  double twice = 0;
  for (std::size_t k = 2; k < x.size(); ++k)
    twice += (x[k - 1][0] - x[0][0]) * (x[k][1] - x[0][1]) - (x[k - 1][1] - x[0][1]) * (x[k][0] - x[0][0]);
  return 0.5 * twice;
}

bool shape_values_at(std::span<const Vector2> corners, const Vector2& point, std::array<double, 4>& values) {
  constexpr double tolerance = 1e-9;
  values.fill(0);
  if (corners.size() == 3) {
    const double area = triangle_area(corners);
    bool inside = true;
    for (int k = 0; k < 3; ++k) {
      const std::array<Vector2, 3> part{point, corners[(k + 1) % 3], corners[(k + 2) % 3]};
      values[k] = triangle_area(part) / area;
      inside = inside && values[k] >= -tolerance;
    }
    return inside;
  }
  Eigen::Vector2d local = Eigen::Vector2d::Zero();  // Newton; converges in a few steps for convex cells
  for (int iteration = 0; iteration < 30; ++iteration) {
    const Bilinear shape(local[0], local[1]);
    Eigen::Vector2d miss(point[0], point[1]);
    for (int k = 0; k < 4; ++k) miss -= shape.value[k] * Eigen::Vector2d(corners[k][0], corners[k][1]);
    const Eigen::Vector2d step = jacobian(corners, shape).transpose().inverse() * miss;
    local += step;
    if (!(local.norm() < 10)) return false;  // far outside
    if (step.norm() < 1e-14) break;
  }
  values = Bilinear(local[0], local[1]).value;
  return local.cwiseAbs().maxCoeff() <= 1 + tolerance;
}

}  // namespace slipscale
