#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "slipscale/dynamics/bulk.hpp"

using namespace slipscale;

namespace {

/// One step of one oscillator of frequency ω as the step loop makes it. State (u_n, w_n, a_{n−1}, u_{n−1}).
Eigen::Vector4d advance(const Eigen::Vector4d& state, double omega, double step, double beta2,
                        const Damping& damping) {
  const double inverse_mass = 1;
  const Vector2 force{omega * omega * state[0], 0}, previous{omega * omega * state[3], 0};
  Vector2 u{state[0], 0}, w{state[1], 0}, a{state[2], 0};
  Vector2 damping_loss{}, coming{}, scheme_loss{};
  constexpr BulkPhysics everything{true, true, true, true};
  FreeMotion(everything, Instructions::base, {&inverse_mass, &previous, &u, &w, &a}, beta2_step(step, beta2),
             damping, {0, 0}, {&damping_loss, &coming, &scheme_loss}, {})(0, 1, &force);
  return {u[0], w[0], a[0], state[0]};
}

double spectral_radius(double omega, double step, double beta2, const Damping& damping) {
  Eigen::Matrix4d amplification;
  for (int k = 0; k < 4; ++k)
    amplification.col(k) = advance(Eigen::Vector4d::Unit(k), omega, step, beta2, damping);
  return amplification.eigenvalues().cwiseAbs().maxCoeff();
}

}  // namespace

/// Stable iff aΔt + β2 Δt(Δt + 2b) ω² < 2, against the eigenvalues of the amplification
/// matrix. Two eigenvalues meet on the unit circle where nothing dissipates; there they are known to √ε ≈
/// 1e-8 only.
TEST(StableStep, IsWhereTheAmplificationMatrixLeavesTheUnitCircle) {
  constexpr double omega = 7;
  for (const double beta2 : {0.5, 0.6, 0.8, 1.0})
    for (const double a : {0.0, 0.5, 5.0})
      for (const double b : {0.0, 0.01, 0.1}) {
        const Damping damping{a, b};
        const double limit = stable_step(omega, beta2, damping);
        for (const double part : {0.05, 0.3, 0.6, 0.9, 0.999})
          EXPECT_LT(spectral_radius(omega, part * limit, beta2, damping), 1 + 1e-7)
              << "beta2 " << beta2 << " a " << a << " b " << b << " at " << part << " of the limit";
        for (const double part : {1.001, 1.1})
          EXPECT_GT(spectral_radius(omega, part * limit, beta2, damping), 1 + 1e-4)
              << "beta2 " << beta2 << " a " << a << " b " << b << " at " << part << " of the limit";
      }
}

/// ω Δt at the limit, undamped and with ξ = b ω/2 = .1.
TEST(StableStep, HasTheQuotedValues) {
  constexpr double omega = 3;
  for (const double beta2 : {0.5, 0.8, 1.0})
    EXPECT_DOUBLE_EQ(omega * stable_step(omega, beta2, {}), std::sqrt(2 / beta2));
  const Damping damping{0, 0.2 / omega};
  EXPECT_NEAR(omega * stable_step(omega, 0.5, damping), 1.8100, 5e-5);
  EXPECT_NEAR(omega * stable_step(omega, 0.8, damping), 1.3937, 5e-5);
}

/// Free oscillator, spectral radius √(1 − (β2−½)Ω²) while the roots are a complex pair.
TEST(FreeOscillator, DecaysAsTheSchemeSays) {
  constexpr double omega = 2;
  for (const double beta2 : {0.5, 0.6, 0.8, 1.0})
    for (const double phase : {0.1, 0.5, 0.9}) {
      EXPECT_NEAR(spectral_radius(omega, phase / omega, beta2, {}),
                  std::sqrt(1 - (beta2 - 0.5) * phase * phase), 1e-12)
          << "beta2 " << beta2 << " Omega " << phase;
    }
}
