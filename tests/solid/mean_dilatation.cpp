#include <gtest/gtest.h>

#include <cmath>

#include "slipscale/solid/element.hpp"
#include "slipscale/solid/material.hpp"

using namespace slipscale;

namespace {

const std::array<Vector2, 4> corners{{{0, 0}, {1.1, 0.1}, {0.9, 1.2}, {-0.2, 0.8}}};

/// u = (ε_xx x + γ y/2, γ x/2 + ε_yy y) at the corners.
Eigen::VectorXd homogeneous(const Eigen::Vector3d& strain) {
  Eigen::VectorXd u(8);
  for (int k = 0; k < 4; ++k) {
    u[2 * k] = strain[0] * corners[k][0] + 0.5 * strain[2] * corners[k][1];
    u[2 * k + 1] = 0.5 * strain[2] * corners[k][0] + strain[1] * corners[k][1];
  }
  return u;
}

}  // namespace

/// What has one dilatation anyway is as before: homogeneous strains, and every strain of a triangle.
TEST(MeanDilatation, ChangesNoHomogeneousStrain) {
  const Eigen::Matrix3d c = isotropic_stiffness(1, 0.3);
  const ElementStiffness full = element_stiffness(corners, c), mean = mean_dilatation_stiffness(corners, c);
  for (int k = 0; k < 3; ++k) {
    const Eigen::VectorXd u = homogeneous(Eigen::Vector3d::Unit(k));
    EXPECT_LE((full * u - mean * u).norm(), 1e-14);
  }
  EXPECT_LE((mean - mean.transpose()).norm(), 1e-15);
  const std::span<const Vector2> triangle(corners.data(), 3);
  EXPECT_EQ(mean_dilatation_stiffness(triangle, c), element_stiffness(triangle, c));
}

/// Three rigid motions and no other that costs nothing; and of an incompressible cell one strain alone, the
/// dilatation, that costs all: full integration lets three cost all.
TEST(MeanDilatation, RestrainsTheDilatationAlone) {
  const double poisson = 0.4999999, bulk = 1 / (1 - 2 * poisson);
  const auto spectrum = [&](const ElementStiffness& k) {
    return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(k).eigenvalues().eval();
  };
  const auto count_above = [](const Eigen::VectorXd& values, double least) {
    return (values.array() > least).count();
  };
  const Eigen::Matrix3d c = isotropic_stiffness(1, poisson);
  const Eigen::VectorXd mean = spectrum(mean_dilatation_stiffness(corners, c)),
                        full = spectrum(element_stiffness(corners, c));
  EXPECT_LE(std::abs(mean[2]), 1e-8);
  EXPECT_GE(mean[3], 0.01);
  EXPECT_EQ(count_above(mean, 1e-3 * bulk), 1);
  EXPECT_EQ(count_above(full, 1e-3 * bulk), 3);
}
