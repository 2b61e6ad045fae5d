#include "slipscale/record/stress_measures.hpp"

#include <gtest/gtest.h>

#include <cmath>

using namespace slipscale;

namespace {

Material with(const Eigen::Matrix3d& stiffness) {
  Material material;
  material.stiffness = stiffness;
  return material;
}

}  // namespace

TEST(TransverseRatio, IsPoissonsRatio) {
  for (const double poisson : {0.0, 0.25, 0.49, -0.3})
    EXPECT_NEAR(transverse_ratio(with(isotropic_stiffness(45e9, poisson))), poisson, 1e-12);
}

TEST(TransverseRatio, IsNotKnownOfALaminate) {
  Eigen::Matrix3d stiffness = isotropic_stiffness(45e9, 0.25);
  stiffness(0, 0) *= 1.01;
  EXPECT_TRUE(std::isnan(transverse_ratio(with(stiffness))));
  stiffness = isotropic_stiffness(45e9, 0.25);
  stiffness(2, 2) *= 1.01;
  EXPECT_TRUE(std::isnan(transverse_ratio(with(stiffness))));
}

// Uniaxial tension s, pure shear s: s and s√3. Plane strain under σ_xx alone: s√(1 − ν + ν²).
TEST(VonMises, OfSimpleStates) {
  const double tension[] = {3, 0, 0}, shear[] = {0, 0, 3}, hydrostatic[] = {5, 5, 0};
  EXPECT_DOUBLE_EQ(von_mises(tension, 0), 3);
  EXPECT_DOUBLE_EQ(von_mises(shear, 0), 3 * std::sqrt(3.0));
  EXPECT_DOUBLE_EQ(von_mises(hydrostatic, 5), 0);
  EXPECT_NEAR(von_mises(tension, 0.3 * 3), 3 * std::sqrt(1 - 0.3 + 0.09), 1e-14);
}

TEST(PrincipalStresses, OfShearAndOfRotatedTension) {
  const double shear[] = {0, 0, 3};
  EXPECT_DOUBLE_EQ(principal_stresses(shear)[0], 3);
  EXPECT_DOUBLE_EQ(principal_stresses(shear)[1], -3);
  const double angle = 0.7, c = std::cos(angle), s = std::sin(angle);
  const double turned[] = {4 * c * c - s * s, 4 * s * s - c * c, 5 * s * c};  // 4 along it, −1 across
  EXPECT_NEAR(principal_stresses(turned)[0], 4, 1e-14);
  EXPECT_NEAR(principal_stresses(turned)[1], -1, 1e-14);
}
