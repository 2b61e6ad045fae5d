// Waves that a sliding half-plane carries by itself: G. G. Adams, "Self-excited oscillations of two elastic
// half-spaces sliding with a constant coefficient of friction", J. Appl. Mech. 62 (1995) 867, here on a rigid
// surface.
//
// A dilatational and a shear wave with potentials φ = A e^{iθ_d}, ψ = B e^{iθ_s}, θ = k(x − ct + qy), q² =
// c²/c_{d,s}² − 1, and u = (φ_x + ψ_y, φ_y − ψ_x):
//     u_y = 0 at y = 0:   B = q_d A
//     σ_xy = −G k² q_d (1 + q_s²) A e^{iθ},   σ_yy = −G k² (q_s² − 1 − 2 q_s q_d) A e^{iθ}
// so that σ_xy = μ σ_yy, slip under a surface that moves along +x, holds where
//     μ = q_d (1 + q_s²) / (q_s² − 1 − 2 q_s q_d).
// Both waves travel upwards: friction feeds what they carry away.
#include <gtest/gtest.h>

#include "report.hpp"
#include "travelling_waves.hpp"

using namespace slipscale;
using namespace slipscale::testing_support;

namespace {

constexpr double poisson = 0.3, friction = 0.5, height = 0.5, wave_number = 2 * std::numbers::pi;
const double fast = std::sqrt(2 * (1 - poisson) / (1 - 2 * poisson));  // c_d; c_s = G = ρ = 1

struct Pair {
  double speed, q_d, q_s;
  explicit Pair(double c) : speed(c), q_d(std::sqrt(c * c / (fast * fast) - 1)), q_s(std::sqrt(c * c - 1)) {}
  double normal() const { return q_s * q_s - 1 - 2 * q_s * q_d; }
  double friction() const { return q_d * (1 + q_s * q_s) / normal(); }
};

/// By bisection above c_d, where friction grows from 0.
Pair pair_of(double mu) {
  double below = fast, above = 1.1 * fast;
  for (int k = 0; k < 60; ++k) {
    const double middle = 0.5 * (below + above);
    (Pair(middle).friction() < mu ? below : above) = middle;
  }
  return Pair(below);
}

/// How far the motion after one wavelength is from the pair that it started from.
double error_after_one_wavelength(int across, Shape shape, bool& always_slips) {
  const Pair pair = pair_of(friction);
  constexpr double amplitude = 1e-6;  // k A
  const double omega = wave_number * pair.speed;
  // −a sin θ_d (1, q_d) − a sin θ_s (q_s q_d, −q_d), as cosines of θ + π/2: x is shifted by a quarter wave.
  const WaveField field{
      {{amplitude, {1, pair.q_d}, {wave_number, wave_number * pair.q_d}, omega},
       {amplitude, {pair.q_s * pair.q_d, -pair.q_d}, {wave_number, wave_number * pair.q_s}, omega}}};
  const double pressure = 2 * wave_number * amplitude * pair.normal();
  Scene scene;
  field.start(scene);
  scene.conditions = {field.follow("top")};
  scene.initial.pressure = pressure;
  scene.initial.shear = friction * pressure;
  scene.surface = Surface{"bottom", 0, 20 * omega * amplitude, 0};
  scene.friction.law = FrictionChoice::Law::coulomb;
  scene.friction.coefficient = friction;
  const Mesh mesh = block_mesh(wave_strip(height, across, shape));
  const Material material = isotropic(2 * (1 + poisson), poisson, 1);
  const Model model(mesh, {material}, Model::Storage::full);
  const double end = 1 / pair.speed;
  const long steps = steps_to_end(model, end, 0.5);
  SlidingBody body(PETSC_COMM_WORLD, model, scene, end / static_cast<double>(steps));
  for (long n = 0; n <= steps; ++n) {
    body.advance(n == steps);
    for (const ContactStatus status : body.contact().status)
      always_slips = always_slips && status == ContactStatus::slip;
  }
  const Energy energy = body.energy();
  EXPECT_LE(std::abs(energy.residual), 1e-10 * energy.flowed);
  return relative_error(body, field, [&](const Vector2& x) {
    return Vector2{friction * pressure * (height - x[1]) / material.c66(), -pressure * x[1] / material.c22()};
  });
}

}  // namespace

TEST(SlidingWaves, TravelWithOrderTwo) {
  const Pair pair = pair_of(friction);
  EXPECT_NEAR(pair.speed, 1.892430, 1e-6);
  EXPECT_NEAR(pair.friction(), friction, 1e-12);
  for (const auto& [shape, name] :
       {std::pair{Shape::quadrilaterals, "Q1"}, std::pair{Shape::triangles, "P1"}}) {
    bool slips = true;
    std::vector<double> errors;
    for (const int across : {16, 32, 64}) errors.push_back(error_after_one_wavelength(across, shape, slips));
    const double order = std::log2(errors[1] / errors[2]);
    EXPECT_TRUE(slips) << name;
    EXPECT_GE(order, 1.8) << name;
    EXPECT_LE(errors[2], 0.01) << name;
    report({format("Adams' pair of waves under a sliding half-plane, nu = .3, mu = .5: c/c_s {:.6f}; {}",
                   pair.speed, name),
            "u after one wavelength, relative error, 64 elements", "<= .01; order >= 1.8",
            format("{:.4f} ({:.4f} with 32)", errors[2], errors[1]), format("{:.2f}", order),
            "exact solution, in the test"});
  }
}
