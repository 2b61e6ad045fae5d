#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>
#include <numbers>

#include "free_body.hpp"
#include "report.hpp"
#include "slipscale/base/print.hpp"

using namespace slipscale;
using namespace slipscale::testing_support;

namespace {

constexpr double width = 1, height = 0.75;  // m; the wave runs along the diagonal of this cell
const Vector2 wave_number{2 * std::numbers::pi / width, 2 * std::numbers::pi / height};
const double wave_length = 2 * std::numbers::pi / std::hypot(wave_number[0], wave_number[1]);

struct PlaneWave {
  double speed;          ///< m/s
  Vector2 polarisation;  ///< unit vector
};

/// Christoffel equation: ρc² is an eigenvalue of the acoustic tensor C_ijkl n_j n_l, its eigenvector the
/// polarisation. The slower wave first.
std::array<PlaneWave, 2> christoffel(const Material& material, const Vector2& k) {
  const double length = std::hypot(k[0], k[1]), nx = k[0] / length, ny = k[1] / length;
  Eigen::Matrix<double, 3, 2> strain;  // of a displacement whose gradient points along n
  strain << nx, 0, 0, ny, ny, nx;
  const Eigen::Matrix2d acoustic = strain.transpose() * material.stiffness * strain;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(acoustic);
  std::array<PlaneWave, 2> waves;
  for (int i = 0; i < 2; ++i)
    waves[i] = {std::sqrt(solver.eigenvalues()[i] / material.density),
                {solver.eigenvectors()(0, i), solver.eigenvectors()(1, i)}};
  return waves;
}

Mesh torus(Shape shape, int across, double distortion = 0) {
  Block block;
  block.nx = across;
  block.ny = across * 3 / 4;
  block.width = width;
  block.height = height;
  block.shape = shape;
  block.distortion = distortion;
  block.periodic_x = block.periodic_y = true;
  return block_mesh(block);
}

struct Outcome {
  double speed;  ///< m/s
  double error;  ///< largest relative L2 error of u during the period
};

/// u = e cos(k·x − ωt) followed over one period.
Outcome one_period(const Model& model, const PlaneWave& wave, long steps) {
  const double period = wave_length / wave.speed, omega = 2 * std::numbers::pi / period;
  const auto at = [&](const Vector2& x, double amplitude, double phase) {
    const double value = amplitude * std::cos(wave_number[0] * x[0] + wave_number[1] * x[1] - phase);
    return Vector2{value * wave.polarisation[0], value * wave.polarisation[1]};
  };
  FreeBody body(
      model, period / static_cast<double>(steps), [&](const Vector2& x) { return at(x, 1, 0); },
      [&](const Vector2& x) { return at(x, omega, std::numbers::pi / 2); });
  const auto everywhere = [](const Vector2&) { return true; };
  const auto before = body.component(wave_number, wave.polarisation, everywhere);
  double error = 0;
  for (long n = 1; n <= steps; ++n) {
    body.advance();
    const double phase = 2 * std::numbers::pi * static_cast<double>(n) / static_cast<double>(steps);
    error = worse(error, body.relative_error([&](const Vector2& x) { return at(x, 1, phase); }));
  }
  const auto after = body.component(wave_number, wave.polarisation, everywhere);
  const double late = std::arg(after / before);  // behind the exact wave, which is back where it began
  return {wave.speed * (1 - late / (2 * std::numbers::pi)), error};
}

struct Elastic {
  std::string name;
  Material material;
};

/// The second couples shear to stretch.
std::vector<Elastic> solids() {
  Material anisotropic{{}, 2700, "anisotropic"};
  anisotropic.stiffness << 60e9, 15e9, 8e9, 15e9, 45e9, -5e9, 8e9, -5e9, 20e9;
  return {{"isotropic", isotropic(45e9, 0.3, 1800)}, {"anisotropic", anisotropic}};
}

struct Grid {
  std::string name;
  Shape shape;
  double distortion;
};

/// The wave on 32 × 24 cells and on twice as many with half the step.
void expect_second_order(const Elastic& solid, const Grid& grid, int which) {
  const auto waves = christoffel(solid.material, wave_number);
  const PlaneWave& wave = waves[which];
  long steps = 0;
  std::array<Outcome, 2> found{};
  for (int k : {0, 1}) {
    const Mesh mesh = torus(grid.shape, 32 << k, grid.distortion);
    const Model model(mesh, {solid.material}, Model::Storage::full);
    const double limit = stable_step(largest_frequency(PETSC_COMM_WORLD, model).sharp, 0.5, {});
    steps = k == 0 ? std::lround(std::ceil(wave_length / wave.speed / (0.9 * limit))) : 2 * steps;
    found[k] = one_period(model, wave, steps);
  }
  const double order = std::log2((found[0].speed - wave.speed) / (found[1].speed - wave.speed)),
               field_order = std::log2(found[0].error / found[1].error);
  const double bound = dispersion(2 * std::numbers::pi / wave_length, width / 64, waves[1].speed, wave.speed);
  SCOPED_TRACE(solid.name + ", " + grid.name);
  EXPECT_NEAR(order, 2, 0.1);
  EXPECT_GE(field_order, 1.9);
  EXPECT_LE(std::abs(found[1].speed / wave.speed - 1), bound);
  const std::string kind = (solid.name == "isotropic" ? "" : "quasi-") + std::string(which ? "P" : "S");
  report({"Plane wave at 53 deg, " + solid.name + ", 64x48",
          grid.name + ", " + kind + ": phase speed, m/s; largest error of u in a period",
          format("{:.2f} within {:.1f} %; order 2", wave.speed, 100 * bound),
          format("{:.2f}; {:.4f}", found[1].speed, found[1].error),
          format("{:.2f}; {:.2f}", order, field_order), "exact solution, Christoffel equation"});
}

}  // namespace

/// Without boundaries the fields in `FreeBody` and in `SlidingBody` are the same to the last bit, so what the
/// waves below verify is what slide computes.
TEST(PlaneWaves, FreeBodyMovesAsASlidingBodyDoes) {
  const Mesh mesh = torus(Shape::mixed, 12);
  const Model model(mesh, {solids()[1].material}, Model::Storage::full);
  Scene scene;
  scene.initial.velocity = {0.5, -0.25};
  scene.initial.amplitude = 2;
  scene.initial.wavelength = width;
  const double step = 0.5 * stable_step(largest_frequency(PETSC_COMM_WORLD, model).sharp, 0.5, {});
  SlidingBody body(PETSC_COMM_WORLD, model, scene, step);
  const std::vector<Vector2> start(body.next_predictor(), body.next_predictor() + mesh.nodes.owned);
  int next = 0;  // FreeBody asks for the owned nodes in their order
  FreeBody free(
      model, step,
      [](const Vector2&) {
        return Vector2{0, 0};
      },
      [&](const Vector2&) { return start[next++]; });
  for (int n = 0; n < 40; ++n) {
    body.advance(false);
    free.advance();
  }
  for (int i = 0; i < mesh.nodes.owned; ++i)
    ASSERT_EQ(body.next_displacement()[i], free.next_displacement()[i]);
}

TEST(PlaneWaves, SpeedsOfTheLibraryFollowFromTheChristoffelEquation) {
  for (const Elastic& solid : solids()) {
    const auto waves = christoffel(solid.material, wave_number);
    const double length = std::hypot(wave_number[0], wave_number[1]);
    const WaveSpeeds speeds = wave_speeds(solid.material, wave_number[0] / length, wave_number[1] / length);
    EXPECT_NEAR(speeds.slow / waves[0].speed, 1, 1e-12);
    EXPECT_NEAR(speeds.fast / waves[1].speed, 1, 1e-12);
  }
}

/// Second order in h and Δt together; phase speed within the dispersion of linear elements.
TEST(PlaneWaves, AtAnAngleAreSecondOrder) {
  for (const Elastic& solid : solids())
    for (const Grid& grid : {Grid{"P1", Shape::triangles, 0},
                             {"Q1", Shape::quadrilaterals, 0},
                             {"P1 and Q1 distorted", Shape::mixed, 0.1}})
      for (int which : {1, 0}) expect_second_order(solid, grid, which);
}
