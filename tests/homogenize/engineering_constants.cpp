#include "slipscale/homogenize/effective.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "stiffnesses.hpp"

using namespace slipscale;
using namespace slipscale::testing_support;

TEST(Isotropy, IsSeen) {
  EXPECT_TRUE(is_isotropic(isotropic_stiffness(70e9, 0.49)));
  EXPECT_FALSE(is_isotropic(laminate()));
  for (const auto& [i, j] : {std::pair(0, 0), std::pair(2, 2), std::pair(0, 2), std::pair(1, 0)}) {
    Eigen::Matrix3d c = plane(3, 1);
    c(i, j) += 1e-6;
    EXPECT_FALSE(is_isotropic(c)) << i << j;
  }
}

/// In plane strain 1/S11 = E/(1 − ν²) and −S12/S11 = ν/(1 − ν).
TEST(EngineeringConstants, InvertIsotropicStiffness) {
  for (const double nu : {-0.4, 0.0, 0.25, 0.3, 0.49}) {
    const double young = 80e9;
    const auto e = engineering_constants(isotropic_stiffness(young, nu));
    EXPECT_NEAR(e.young / young, 1, 1e-12);
    EXPECT_NEAR(e.poisson, nu, 1e-12);
    EXPECT_NEAR(e.young_x / (young / (1 - nu * nu)), 1, 1e-12);
    EXPECT_NEAR(e.young_y / e.young_x, 1, 1e-12);
    EXPECT_NEAR(e.poisson_xy, nu / (1 - nu), 1e-12);
    EXPECT_NEAR(e.poisson_yx, nu / (1 - nu), 1e-12);
    const double g = young / (2 * (1 + nu));
    for (const double shear : {e.shear, e.shear_least, e.shear_most, e.shear_mean()})
      EXPECT_NEAR(shear / g, 1, 1e-12);
    EXPECT_NEAR(e.bulk / (g / (1 - 2 * nu)), 1, 1e-12);
    EXPECT_LT(e.anisotropy, 1e-13);
  }
}

/// S of an orthotropic plate by hand: with C12 = 20, C11 = 90, C22 = 40 the determinant is 3200.
TEST(EngineeringConstants, Orthotropic) {
  Eigen::Matrix3d c;
  c << 90, 20, 0, 20, 40, 0, 0, 0, 15;
  const auto e = engineering_constants(c);
  EXPECT_NEAR(e.young_x, 3200.0 / 40, 1e-12);
  EXPECT_NEAR(e.young_y, 3200.0 / 90, 1e-12);
  EXPECT_NEAR(e.poisson_xy, 20.0 / 40, 1e-14);
  EXPECT_NEAR(e.poisson_yx, 20.0 / 90, 1e-14);
  EXPECT_NEAR(e.shear, 15, 1e-13);
  EXPECT_NEAR(e.bulk, 42.5, 1e-13);
  EXPECT_NEAR(e.shear_least, 15, 1e-13);
  EXPECT_NEAR(e.shear_most, 22.5, 1e-13);
}

/// On the orthonormal basis of the change of area and the two shears C is diagonal: 2k, 2G of xx − yy, 2G of
/// xy. The nearest isotropic solid has the mean of the latter two in their place.
TEST(EngineeringConstants, Anisotropy) {
  const double k = 3, extension = 1.5, shear = 1;  // moduli of the area, of xx − yy and of xy
  Eigen::Matrix3d c;
  c << k + extension, k - extension, 0, k - extension, k + extension, 0, 0, 0, shear;
  const auto e = engineering_constants(c);
  const double off = extension - shear;
  EXPECT_NEAR(e.anisotropy, std::hypot(off, off) / std::hypot(2 * k, 2 * extension, 2 * shear), 1e-14);
}

/// Turning the axes changes the constants along them, not those of the nearest isotropic solid.
TEST(EngineeringConstants, InvariantsDoNotTurn) {
  const auto e = engineering_constants(lower_symmetry());
  for (const double angle : {0.3, 0.9, 2.0}) {
    const double c = std::cos(angle), s = std::sin(angle);
    Eigen::Matrix3d turn;  // strains (xx, yy, γ) on turned axes
    turn << c * c, s * s, c * s, s * s, c * c, -c * s, -2 * c * s, 2 * c * s, c * c - s * s;
    const auto turned = engineering_constants(turn.transpose() * lower_symmetry() * turn);
    EXPECT_NEAR(turned.bulk, e.bulk, 1e-12);
    EXPECT_NEAR(turned.shear_least, e.shear_least, 1e-12);
    EXPECT_NEAR(turned.shear_most, e.shear_most, 1e-12);
    EXPECT_NEAR(turned.young, e.young, 1e-12);
    EXPECT_NEAR(turned.poisson, e.poisson, 1e-13);
    EXPECT_NEAR(turned.anisotropy, e.anisotropy, 1e-13);
    EXPECT_GT(std::abs(turned.young_x - e.young_x), 1);
  }
}
