#include "slipscale/record/stress_measures.hpp"

#include <cmath>
#include <limits>

namespace slipscale {

double transverse_ratio(const Material& material) {
  const Eigen::Matrix3d& c = material.stiffness;
  const double little = 1e-9 * c(0, 0);
  const bool isotropic = std::abs(c(0, 0) - c(1, 1)) <= little &&
                         std::abs(c(0, 0) - c(0, 1) - 2 * c(2, 2)) <= little && std::abs(c(0, 2)) <= little &&
                         std::abs(c(1, 2)) <= little;
  return isotropic ? c(0, 1) / (c(0, 0) + c(0, 1)) : std::numeric_limits<double>::quiet_NaN();
}

double von_mises(const double* stress, double zz) {
  const double xx = stress[0], yy = stress[1], xy = stress[2];
  return std::sqrt(0.5 * ((xx - yy) * (xx - yy) + (yy - zz) * (yy - zz) + (zz - xx) * (zz - xx)) +
                   3 * xy * xy);
}

std::array<double, 2> principal_stresses(const double* stress) {
  const double middle = 0.5 * (stress[0] + stress[1]);
  const double radius = std::hypot(0.5 * (stress[0] - stress[1]), stress[2]);
  return {middle + radius, middle - radius};
}

}  // namespace slipscale
