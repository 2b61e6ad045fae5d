#pragma once

#include <vector>

#include "slipscale/homogenize/effective.hpp"

// Stiffnesses and mixtures that several tests of this room look at, in GPa; Voigt order (xx, yy, xy).

namespace slipscale::testing_support {

/// Plane isotropic C from the plane bulk modulus k and the shear modulus g.
inline Eigen::Matrix3d plane(double k, double g) {
  Eigen::Matrix3d c;
  c << k + g, k - g, 0, k - g, k + g, 0, 0, 0, g;
  return c;
}

inline std::vector<Phase> mixture(const Eigen::Matrix3d& first, const Eigen::Matrix3d& second,
                                  double fraction) {
  return {{"matrix", 1 - fraction, {first, 1000, ""}}, {"inclusion", fraction, {second, 2500, ""}}};
}

/// 30 and 80 GPa, ν = .3, in GPa as everything here.
inline std::vector<Phase> composite(double fraction) {
  return mixture(isotropic_stiffness(30, 0.3), isotropic_stiffness(80, 0.3), fraction);
}

inline Eigen::Matrix3d lower_symmetry() {
  Eigen::Matrix3d c;
  c << 90, 20, 5, 20, 40, -3, 5, -3, 15;
  return c;
}

/// Exact: half and half, normal y, GPa.
inline Eigen::Matrix3d laminate() {
  Eigen::Matrix3d c;
  c << 71.228771, 25.174825, 0, 25.174825, 58.741259, 0, 0, 0, 16.783217;
  return c;
}

}  // namespace slipscale::testing_support
