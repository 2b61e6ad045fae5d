// Plane dilatational waves on a side with dampers (J. Lysmer, R. L. Kuhlemeyer 1969): σ_yy = −ρ c_d v_y and
// σ_xy = −ρ c_s v_x leave two equations for the waves that come back, below.
#include <gtest/gtest.h>

#include <Eigen/Dense>

#include "report.hpp"
#include "travelling_waves.hpp"

using namespace slipscale;
using namespace slipscale::testing_support;

namespace {

constexpr double poisson = 0.25, height = 0.5, along = 2 * std::numbers::pi;  // k_x, 1/m
const double fast = std::sqrt(2 * (1 - poisson) / (1 - 2 * poisson));         // c_d; c_s = G = ρ = 1

/// Per unit of amplitude, of u = d cos(k·x − ωt): the sums σ_yy + ρ c_d v_y and σ_xy + ρ c_s v_x over −sin.
Eigen::Vector2d left_over(const TravellingWave& wave) {
  const auto& [dx, dy] = wave.direction;
  const auto& [kx, ky] = wave.wave_number;
  const double lame = fast * fast - 2;
  return {lame * (dx * kx + dy * ky) + 2 * dy * ky - fast * wave.frequency * dy,
          dx * ky + dy * kx - wave.frequency * dx};
}

/// The incident wave, and what comes back of it: dilatational and shear.
WaveField reflection(double degrees) {
  const double angle = degrees * std::numbers::pi / 180, shear_angle = std::asin(std::sin(angle) / fast);
  const double omega = along * fast / std::sin(angle);
  const double up = along / std::tan(angle), down = along / std::tan(shear_angle);
  WaveField field{{{1e-6, {std::sin(angle), std::cos(angle)}, {along, up}, omega},
                   {1, {std::sin(angle), -std::cos(angle)}, {along, -up}, omega},
                   {1, {std::cos(shear_angle), std::sin(shear_angle)}, {along, -down}, omega}}};
  Eigen::Matrix2d back;
  back << left_over(field.waves[1]), left_over(field.waves[2]);
  const Eigen::Vector2d size = -back.inverse() * left_over(field.waves[0]) * field.waves[0].amplitude;
  field.waves[1].amplitude = size[0];
  field.waves[2].amplitude = size[1];
  return field;
}

struct Outcome {
  double error;                    ///< of u
  std::array<double, 2> returned;  ///< |R_P|, |R_S| found in u
};

/// The amplitudes of the waves in an observed u, by least squares of their cosines and sines. Collective.
std::array<double, 2> returned(const SlidingBody& body, const WaveField& field) {
  using Normal = Eigen::Matrix<double, 6, 7>;
  Normal sums = Normal::Zero();
  const Nodes& nodes = body.model().mesh.nodes;
  for (int i = 0; i < nodes.owned; ++i)
    for (int axis = 0; axis < 2; ++axis) {
      Eigen::Matrix<double, 7, 1> row;
      for (int w = 0; w < 3; ++w) {
        const double phase = field.waves[w].phase(nodes.position[i], body.time());
        row[2 * w] = field.waves[w].direction[axis] * std::cos(phase);
        row[2 * w + 1] = field.waves[w].direction[axis] * std::sin(phase);
      }
      row[6] = body.displacement_n()[i][axis];
      sums += row.head<6>() * row.transpose();
    }
  MPI_Allreduce(MPI_IN_PLACE, sums.data(), 42, MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD);
  const Eigen::Matrix<double, 6, 1> size = sums.leftCols<6>().ldlt().solve(sums.col(6));
  const double incident = size.segment<2>(0).norm();
  return {size.segment<2>(2).norm() / incident, size.segment<2>(4).norm() / incident};
}

/// The field driven from below, under an open top, until it has crossed the strip a few times.
Outcome run(const WaveField& field, int across, Shape shape) {
  Scene scene;
  field.start(scene);
  BoundaryCondition top;
  top.boundary = "top";
  top.absorbing = true;
  scene.conditions = {top, field.follow("bottom")};
  const Mesh mesh = block_mesh(wave_strip(height, across, shape));
  const Model model(mesh, {isotropic(2 * (1 + poisson), poisson, 1)}, Model::Storage::full);
  const double end = 3 * height;
  const long steps = steps_to_end(model, end, 0.5);
  SlidingBody body(PETSC_COMM_WORLD, model, scene, end / static_cast<double>(steps));
  for (long n = 0; n <= steps; ++n) body.advance(n == steps);
  const Energy energy = body.energy();
  EXPECT_LE(std::abs(energy.residual), 1e-10 * energy.flowed);
  EXPECT_GT(energy.radiated, 0);
  return {relative_error(body, field, [](const Vector2&) { return Vector2{}; }), returned(body, field)};
}

/// Phases counted from the top, where the equations of the reflection hold.
WaveField from_top(WaveField field) {
  for (TravellingWave& wave : field.waves) wave.offset = -wave.wave_number[1] * height;
  return field;
}

}  // namespace

TEST(OpenEnd, ReflectsPlaneWavesAsItShould) {
  struct Angle {
    double degrees, p, s;
  };
  for (const Angle& angle :
       {Angle{30, .0160, .0090}, Angle{45, .0138, .0709}, Angle{60, .1340, .1340}, Angle{75, .4130, .1317}}) {
    const WaveField field = from_top(reflection(angle.degrees));
    const double incident = field.waves[0].amplitude;
    EXPECT_NEAR(std::abs(field.waves[1].amplitude) / incident, angle.p, 6e-5);
    EXPECT_NEAR(std::abs(field.waves[2].amplitude) / incident, angle.s, 6e-5);
    std::vector<Outcome> outcomes;
    for (const int across : {32, 64}) outcomes.push_back(run(field, across, Shape::quadrilaterals));
    const double order = std::log2(outcomes[0].error / outcomes[1].error);
    EXPECT_GE(order, 1.8) << angle.degrees;
    EXPECT_NEAR(outcomes[1].returned[0], angle.p, 0.01) << angle.degrees;
    EXPECT_NEAR(outcomes[1].returned[1], angle.s, 0.01) << angle.degrees;
    report({format("Open end under a plane dilatational wave at {:g} degrees, nu = .25", angle.degrees),
            "part that comes back as P; as S; relative error of u, 64 elements a wavelength along the side",
            format("{:.4f}; {:.4f}; order >= 1.8", angle.p, angle.s),
            format("{:.4f}; {:.4f}; {:.4f}", outcomes[1].returned[0], outcomes[1].returned[1],
                   outcomes[1].error),
            format("{:.2f}", order), "exact solution, in the test"});
  }
}
