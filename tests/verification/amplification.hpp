#pragma once

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <vector>

#include "slipscale/dynamics/scheme.hpp"

namespace slipscale::testing_support {

/// One oscillator of frequency ω in the β2 scheme.
struct Oscillator {
  double omega;      ///< 1/s
  double time_step;  ///< s
  double beta2;
  Damping damping;

  /// The scheme line by line, with v and a kept: u_1, …, u_count from u_0 = 0 and v_0; damping lags by one
  /// step, so it starts from u_{−1} = −Δt v_0.
  std::vector<double> displacements(double v, int count) const {
    const double k = omega * omega;
    std::vector<double> all;
    double u = 0, old_u = -time_step * v, a = 0;
    for (int n = 0; n < count; ++n) {
      const double w = n == 0 ? v : v + time_step * (1 - beta2) * a;
      a = -k * u - damping.stiffness / time_step * k * (u - old_u) - damping.mass * w;
      if (n > 0) v = w + beta2 * time_step * a;
      old_u = u;
      u += time_step * w + (n == 0 ? 0.5 : beta2 + 0.5) * time_step * time_step * a;
      all.push_back(u);
    }
    return all;
  }

  /// [c0, c1, c2] of z³ + c2 z² + c1 z + c0, whose roots z carry u_n to u_{n+1}. With c = β2 + ½, d = aΔt,
  /// r = b/Δt and Ω = ωΔt the acceleration, from Δt w_n = Δu − c Δt² a_n, obeys
  ///     (1 − cd) Δt² a_n = −Ω²[(1 + r) u_n − r u_{n−1}] − d (u_{n+1} − u_n),
  /// and u_{n+1} − 2u_n + u_{n−1} = c Δt² a_n + (1 − c) Δt² a_{n−1}.
  Eigen::Vector3d polynomial() const {
    const double c = beta2 + 0.5, d = damping.mass * time_step, r = damping.stiffness / time_step,
                 stiffness = std::pow(omega * time_step, 2), inertia = 1 - c * d;
    return {-(1 - c) * stiffness * r, inertia - c * stiffness * r + (1 - c) * (stiffness * (1 + r) - d),
            -2 * inertia + c * (stiffness * (1 + r) - d) + (1 - c) * d};
  }

  Eigen::Vector3cd roots() const {
    const Eigen::Vector3d p = polynomial();
    Eigen::Matrix3d companion;
    companion << -p[2], -p[1], -p[0], 1, 0, 0, 0, 1, 0;
    return companion.eigenvalues();
  }
  double spectral_radius() const { return roots().cwiseAbs().maxCoeff(); }

  /// What |u_n| never exceeds as long as no root lies outside the unit circle: Σ|C_k| of u_n = Σ C_k
  /// z_k^(n−1).
  double largest_displacement(double v) const {
    const Eigen::Vector3cd z = roots();
    const auto u = displacements(v, 3);
    Eigen::Matrix3cd powers;
    powers << 1, 1, 1, z[0], z[1], z[2], z[0] * z[0], z[1] * z[1], z[2] * z[2];
    const Eigen::Vector3cd start(u[0], u[1], u[2]);
    return powers.fullPivLu().solve(start).cwiseAbs().sum();
  }
};

/// The step at which the first root leaves the unit circle, by bisection on the polynomial.
inline double polynomial_limit(double omega, double beta2, const Damping& damping) {
  double stable = 0.01 / omega, unstable = 2.1 / omega;
  for (int n = 0; n < 60; ++n) {
    const double middle = (stable + unstable) / 2;
    // A double root on the circle is known to √ε ≈ 1e-8 only.
    (Oscillator{omega, middle, beta2, damping}.spectral_radius() > 1 + 1e-7 ? unstable : stable) = middle;
  }
  return stable;
}

}  // namespace slipscale::testing_support
