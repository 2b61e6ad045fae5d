#include "slipscale/solid/element.hpp"

#include <cmath>

namespace slipscale {
namespace {

/// Shape functions of the bilinear cell and their derivatives at (ξ, η) in [−1, 1]².
struct Bilinear {
  std::array<double, 4> value;
  std::array<Vector2, 4> slope;  ///< d/dξ, d/dη

  Bilinear(double xi, double eta) {
    static constexpr std::array<Vector2, 4> sign{{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}};
    for (int k = 0; k < 4; ++k) {
      value[k] = 0.25 * (1 + sign[k][0] * xi) * (1 + sign[k][1] * eta);
      slope[k] = {0.25 * sign[k][0] * (1 + sign[k][1] * eta), 0.25 * sign[k][1] * (1 + sign[k][0] * xi)};
    }
  }
};

Eigen::Matrix2d jacobian(std::span<const Vector2> corners, const Bilinear& shape) {
  Eigen::Matrix2d j = Eigen::Matrix2d::Zero();
  for (int k = 0; k < 4; ++k)
    for (int row = 0; row < 2; ++row)
      for (int axis = 0; axis < 2; ++axis) j(row, axis) += shape.slope[k][row] * corners[k][axis];
  return j;
}

void put_gradient(StrainDisplacement& b, int corner, double dx, double dy) {
  b(0, 2 * corner) = dx;
  b(1, 2 * corner + 1) = dy;
  b(2, 2 * corner) = dy;
  b(2, 2 * corner + 1) = dx;
}

StrainDisplacement quadrilateral_strain(std::span<const Vector2> corners, const Bilinear& shape) {
  const Eigen::Matrix2d inverse = jacobian(corners, shape).inverse();
  StrainDisplacement b = StrainDisplacement::Zero(3, 8);
  for (int k = 0; k < 4; ++k)
    put_gradient(b, k, inverse(0, 0) * shape.slope[k][0] + inverse(0, 1) * shape.slope[k][1],
                 inverse(1, 0) * shape.slope[k][0] + inverse(1, 1) * shape.slope[k][1]);
  return b;
}

double triangle_area(std::span<const Vector2> x) {
  return 0.5 * ((x[1][0] - x[0][0]) * (x[2][1] - x[0][1]) - (x[1][1] - x[0][1]) * (x[2][0] - x[0][0]));
}

StrainDisplacement triangle_strain(std::span<const Vector2> x) {
  const double twice = 2 * triangle_area(x);
  StrainDisplacement b = StrainDisplacement::Zero(3, 6);
  for (int k = 0; k < 3; ++k) {
    const Vector2 &p = x[(k + 1) % 3], &q = x[(k + 2) % 3];
    put_gradient(b, k, (p[1] - q[1]) / twice, (q[0] - p[0]) / twice);
  }
  return b;
}

/// Calls `visit(shape, weight)` at the 2×2 Gauss points; the weight carries the Jacobian, m².
template <class Visit>
void gauss(std::span<const Vector2> corners, Visit&& visit) {
  const double g = 1 / std::sqrt(3.0);
  for (const double eta : {-g, g})
    for (const double xi : {-g, g}) {
      const Bilinear shape(xi, eta);
      visit(shape, jacobian(corners, shape).determinant());
    }
}

}  // namespace

ElementStiffness element_stiffness(std::span<const Vector2> corners, const Eigen::Matrix3d& elasticity) {
  if (corners.size() == 3) {
    const StrainDisplacement b = triangle_strain(corners);
    return triangle_area(corners) * (b.transpose() * elasticity * b);
  }
  ElementStiffness k = ElementStiffness::Zero(8, 8);
  gauss(corners, [&](const Bilinear& shape, double weight) {
    const StrainDisplacement b = quadrilateral_strain(corners, shape);
    k += weight * (b.transpose() * elasticity * b);
  });
  return k;
}

std::array<double, 4> corner_areas(std::span<const Vector2> corners) {
  std::array<double, 4> areas{};
  if (corners.size() == 3) {
    for (int k = 0; k < 3; ++k) areas[k] = triangle_area(corners) / 3;
    return areas;
  }
  gauss(corners, [&](const Bilinear& shape, double weight) {
    for (int k = 0; k < 4; ++k) areas[k] += weight * shape.value[k];
  });
  return areas;
}

StrainDisplacement centre_strain_displacement(std::span<const Vector2> corners) {
  return corners.size() == 3 ? triangle_strain(corners) : quadrilateral_strain(corners, Bilinear(0, 0));
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

double largest_element_eigenvalue(std::span<const Vector2> corners, const Eigen::Matrix3d& elasticity,
                                  double density) {
  ElementStiffness k = element_stiffness(corners, elasticity);
  const auto areas = corner_areas(corners);
  for (int i = 0; i < k.rows(); ++i)
    for (int j = 0; j < k.cols(); ++j) k(i, j) /= density * std::sqrt(areas[i / 2] * areas[j / 2]);
  const Eigen::SelfAdjointEigenSolver<ElementStiffness> solver(k, Eigen::EigenvaluesOnly);
  return solver.eigenvalues().maxCoeff();
}

}  // namespace slipscale
