// The coefficient of a face whose phases rub differently. A half-plane that slides slowly on a rigid surface,
// in contact and in slip everywhere, with τ = μ(x) p. Its surface stays level, u_y' = 0, which is
//     H[p] = β (τ − ⟨τ⟩),   β = (1 − 2ν)/(2(1 − ν)),   H the Hilbert transform (K. L. Johnson, Contact
//     Mechanics, 2.30).
// p + iH[p] is the boundary value of a function that is analytic in the half-plane, so F = p ∓ iβμp is one as
// well but for a constant, with F = ⟨p⟩ ∓ iβ⟨τ⟩ far away; there log F is the mean of log(p √(1 + β²μ²)) ∓ i
// arctan βμ. The phases of the two sides:
//     ⟨τ⟩/⟨p⟩ = tan⟨arctan βμ⟩ / β
// whatever the order of the phases. P. Ballard, F. Iurlano (2021) have this limit by homogenisation.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "report.hpp"
#include "travelling_waves.hpp"

using namespace slipscale;
using namespace slipscale::testing_support;

namespace {

constexpr double low = 0.2, high = 1.2, pressure = 1e-4;

double expected_of(double poisson) {
  const double beta = 0.5 * (1 - 2 * poisson) / (1 - poisson);
  return std::tan(0.5 * (std::atan(beta * low) + std::atan(beta * high))) / beta;
}

/// ⟨τ⟩/⟨p⟩ once a strip of so many periods of both phases, in equal parts, slides steadily, `across` elements
/// in all. A memory of friction and dampers keep it from squealing; the steady state knows nothing of them.
/// Of many periods the strip is lower, three of them high: what one does reaches no deeper than that.
double friction_of(int periods, int across, double poisson = 0) {
  const double expected = expected_of(poisson), height = std::min(0.75, 3.0 / periods);
  Scene scene;
  scene.conditions = {{"top", {0.0, 0.0}, 0, 0, 0}};
  scene.initial.pressure = pressure;
  scene.initial.shear = expected * pressure;
  scene.damping.mass = 4;
  scene.damping.stiffness = 0.01;
  scene.surface = Surface{"bottom", 0, 1, 0};
  scene.friction.law = FrictionChoice::Law::regularized;
  scene.friction.coefficient = 1;
  scene.friction.time = 0.2;
  const std::string wave = format("sin({:.17g}*x)", 2 * std::numbers::pi * periods);
  scene.friction.coefficient_formula = std::make_shared<const Formula>(
      format("{} + {}*(abs({}) < 1e-6 ? 0 : sign({}))", 0.5 * (low + high), 0.5 * (low - high), wave, wave),
      "x", Formula::Names{}, "coefficient of two phases");
  const Mesh mesh = block_mesh(wave_strip(height, across, Shape::quadrilaterals));
  const Model model(mesh, {isotropic(2 * (1 + poisson), poisson, 1)}, Model::Storage::full);
  const double step = 0.5 * stable_step(largest_frequency(PETSC_COMM_WORLD, model).sharp, 0.5, scene.damping);
  SlidingBody body(PETSC_COMM_WORLD, model, scene, step);
  const long steps = std::lround((height < 0.5 ? 6 : 12) / step);  // a low strip comes to rest sooner
  for (long n = 0; n <= steps; ++n) body.advance(n == steps);
  double sums[2] = {0, 0};
  for (const Vector2& force : body.contact().force) sums[0] += force[0], sums[1] += force[1];
  for (const ContactStatus status : body.contact().status) EXPECT_EQ(status, ContactStatus::slip);
  MPI_Allreduce(MPI_IN_PLACE, sums, 2, MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD);
  const Energy energy = body.energy();
  EXPECT_LE(energy.kinetic, 1e-10 * energy.strain);
  return sums[0] / sums[1];
}

}  // namespace

TEST(FrictionOfPhases, IsNotTheMeanOfTheirCoefficients) {
  const double mean = 0.5 * (low + high), expected = expected_of(0), coarse = friction_of(1, 32),
               fine = friction_of(1, 64);
  EXPECT_NEAR(fine, expected, 0.02 * expected);
  EXPECT_LT(std::abs(fine - expected), std::abs(coarse - expected));
  EXPECT_GT(mean, 1.05 * expected);
  const double many = friction_of(4, 128);
  EXPECT_NEAR(many, expected, 0.02 * expected);
  report(
      {format("Slow sliding, mu = {:g} and {:g} in equal parts, nu = {:g}: mean {:g}", low, high, 0.0, mean),
       "shear over normal force: one period of 64 elements; four of 32", format("{:.4f} +- 2 %", expected),
       format("{:.4f} ({:.4f} with 32); {:.4f}", fine, coarse, many), "",
       "tan<arctan(beta mu)>/beta, derived in the test"});
}

/// The more periods, the nearer to the half-plane of the derivation; the rest is the mesh's, first order at
/// the jumps of the coefficient.
TEST(FrictionOfPhases, IsTheSameForFinerPhases) {
  const double expected = expected_of(0);
  std::string found;
  for (const int periods : {8, 16, 32}) {
    const double friction = friction_of(periods, 16 * periods);
    EXPECT_NEAR(friction, expected, 0.02 * expected) << periods;
    found += (found.empty() ? "" : "; ") + format("{:.4f}", friction);
  }
  report({format("Slow sliding, mu = {:g} and {:g} in equal parts, nu = 0", low, high),
          "shear over normal force: 8; 16; 32 periods of 16 elements", format("{:.4f} +- 2 %", expected),
          found, "", "tan<arctan(beta mu)>/beta, derived in the test"});
}

TEST(FrictionOfPhases, KnowsPoissonsRatio) {
  for (const double poisson : {0.2, 0.35}) {
    const double expected = expected_of(poisson), coarse = friction_of(4, 64, poisson),
                 fine = friction_of(4, 128, poisson);
    EXPECT_NEAR(fine, expected, 0.01 * expected);
    EXPECT_LT(std::abs(fine - expected), std::abs(coarse - expected));
    EXPECT_GT(expected, 1.01 * expected_of(0));
    report({format("Slow sliding, mu = {:g} and {:g} in equal parts, nu = {:g}: mean {:g}", low, high,
                   poisson, 0.5 * (low + high)),
            "shear over normal force: four periods of 32 elements", format("{:.4f} +- 1 %", expected),
            format("{:.4f} ({:.4f} with 16)", fine, coarse), "",
            "tan<arctan(beta mu)>/beta, derived in the test"});
  }
}
