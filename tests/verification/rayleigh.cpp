#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "free_body.hpp"
#include "report.hpp"
#include "slipscale/base/print.hpp"

using namespace slipscale;
using namespace slipscale::testing_support;

namespace {

constexpr double poisson = 0.25, wave_length = 1, depth = 4;  // m

/// Rayleigh's equation for ξ = (c/c_s)²: (2 − ξ)² = 4 √(1 − ξ) √(1 − ξ (c_s/c_d)²), by bisection.
double rayleigh_root(double speed_ratio) {
  const auto function = [&](double xi) {
    return std::pow(2 - xi, 2) - 4 * std::sqrt((1 - xi) * (1 - xi * speed_ratio * speed_ratio));
  };
  double low = 0.1, high = 1;  // negative, positive
  for (int n = 0; n < 60; ++n) (function((low + high) / 2) < 0 ? low : high) = (low + high) / 2;
  return low;
}

/// The wave on the free surface y = 0 of the half-space y > 0: two potentials that decay like exp(−qy) and
/// exp(−sy), in the ratio that leaves the surface free of shear; Rayleigh's equation makes it free of
/// pressure.
struct RayleighWave {
  double k, q, s, omega;

  RayleighWave(double fast, double slow) : k(2 * std::numbers::pi / wave_length) {
    const double speed = slow * std::sqrt(rayleigh_root(slow / fast));
    omega = k * speed;
    q = k * std::sqrt(1 - std::pow(speed / fast, 2));
    s = k * std::sqrt(1 - std::pow(speed / slow, 2));
  }

  Vector2 amplitude(double y) const {
    const double sum = k * k + s * s;
    return {std::exp(-q * y) - 2 * q * s / sum * std::exp(-s * y),
            q / k * (2 * k * k / sum * std::exp(-s * y) - std::exp(-q * y))};
  }
  Vector2 displacement(const Vector2& x) const {
    const Vector2 a = amplitude(x[1]);
    return {a[0] * std::cos(k * x[0]), a[1] * std::sin(k * x[0])};
  }
  Vector2 velocity(const Vector2& x) const {
    const Vector2 a = amplitude(x[1]);
    return {omega * a[0] * std::sin(k * x[0]), -omega * a[1] * std::cos(k * x[0])};
  }
};

/// A strip of one wave length, periodic in x; at its far side the wave has decayed to 1e-4.
Mesh strip(Shape shape, int across) {
  Block block;
  block.nx = across;
  block.ny = static_cast<int>(depth / wave_length) * across;
  block.width = wave_length;
  block.height = depth;
  block.shape = shape;
  block.periodic_x = true;
  return block_mesh(block);
}

struct Outcome {
  double speed;  ///< m/s, from the phase of u_x at the free surface
  double error;  ///< relative L2 error of u over the whole strip
};

/// The wave after four periods.
Outcome four_periods(const Model& model, const RayleighWave& wave, long steps_a_period) {
  const double period = 2 * std::numbers::pi / wave.omega;
  FreeBody body(
      model, period / static_cast<double>(steps_a_period),
      [&](const Vector2& x) { return wave.displacement(x); },
      [&](const Vector2& x) { return wave.velocity(x); });
  const auto surface = [](const Vector2& x) { return x[1] < 1e-9; };
  const auto before = body.component({wave.k, 0}, {1, 0}, surface);
  for (long n = 0; n < 4 * steps_a_period; ++n) body.advance();
  const double late = std::arg(body.component({wave.k, 0}, {1, 0}, surface) / before);
  return {wave.omega / wave.k * (1 - late / (8 * std::numbers::pi)),
          body.relative_error([&](const Vector2& x) { return wave.displacement(x); })};
}

}  // namespace

/// ν = 1/4 has the closed form ξ = 2 − 2/√3 (Rayleigh 1885); ν = .3 c/c_s = .9274 (textbooks).
TEST(RayleighWave, RootHasTheKnownValues) {
  EXPECT_NEAR(rayleigh_root(1 / std::sqrt(3)), 2 - 2 / std::sqrt(3), 1e-13);
  EXPECT_NEAR(std::sqrt(rayleigh_root(std::sqrt(0.2 / 0.7))), 0.9274, 5e-5);
}

/// Second order in h and Δt together, on 32 and 64 cells a wave length.
TEST(RayleighWave, AlongAFreeSurfaceIsSecondOrder) {
  const Material solid = isotropic(2.5, poisson, 1);  // c_s = 1, c_d = √3 m/s
  const double fast = std::sqrt(3), exact = std::sqrt(2 - 2 / std::sqrt(3));
  const RayleighWave wave(fast, 1);
  const double bound = dispersion(wave.k, wave_length / 64, fast, exact);
  for (const auto& [shape, name] :
       {std::pair{Shape::triangles, "P1"}, {Shape::quadrilaterals, "Q1"}, {Shape::mixed, "P1 and Q1"}}) {
    std::array<Outcome, 2> found{};
    long steps = 0;
    for (int k : {0, 1}) {
      const Mesh mesh = strip(shape, 32 << k);
      const Model model(mesh, {solid}, Model::Storage::full);
      const double limit = stable_step(largest_frequency(PETSC_COMM_WORLD, model).sharp, 0.5, {});
      steps = k == 0 ? std::lround(std::ceil(2 * std::numbers::pi / wave.omega / (0.9 * limit))) : 2 * steps;
      found[k] = four_periods(model, wave, steps);
    }
    const double order = std::log2((found[0].speed - exact) / (found[1].speed - exact)),
                 field_order = std::log2(found[0].error / found[1].error);
    SCOPED_TRACE(name);
    EXPECT_NEAR(order, 2, 0.1);
    EXPECT_GE(field_order, 1.9);
    EXPECT_LE(std::abs(found[1].speed / exact - 1), bound);
    report({"Rayleigh wave, nu = 1/4, 64 cells a wave length",
            std::string(name) + ": phase speed/c_s; error of u after four periods",
            format("{:.5f} within {:.1f} %; order 2", exact, 100 * bound),
            format("{:.5f}; {:.4f}", found[1].speed, found[1].error),
            format("{:.2f}; {:.2f}", order, field_order), "exact root of Rayleigh's equation"});
  }
}
