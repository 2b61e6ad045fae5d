#include "slipscale/solid/element.hpp"

#include <cmath>

#include "slipscale/mesh/shape_functions.hpp"

namespace slipscale {
namespace {

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

ElementStiffness mean_dilatation_stiffness(std::span<const Vector2> corners,
                                           const Eigen::Matrix3d& elasticity) {
  if (corners.size() == 3) return element_stiffness(corners, elasticity);
  Eigen::Matrix<double, 1, 8> mean = Eigen::Matrix<double, 1, 8>::Zero();
  double area = 0;
  gauss(corners, [&](const Bilinear& shape, double weight) {
    const StrainDisplacement b = quadrilateral_strain(corners, shape);
    mean += weight * (b.row(0) + b.row(1));
    area += weight;
  });
  mean /= area;
  ElementStiffness k = ElementStiffness::Zero(8, 8);
  gauss(corners, [&](const Bilinear& shape, double weight) {
    StrainDisplacement b = quadrilateral_strain(corners, shape);
    const Eigen::Matrix<double, 1, 8> change = 0.5 * (mean - b.row(0) - b.row(1));
    b.topRows<2>().rowwise() += change;
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
