#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <cmath>

#include "amplification.hpp"
#include "report.hpp"
#include "scenes.hpp"
#include "slipscale/base/print.hpp"

using namespace slipscale;
using namespace slipscale::testing_support;

namespace {

constexpr double betas[] = {0.5, 0.6, 0.8, 1.0};
const Vector2 start_velocity{0.7, -0.4};  // m/s

/// A block of two by two distorted cells, triangles and quadrilaterals, held at its top: 12 modes, all of
/// them set in motion by a uniform velocity.
Mesh small_block() {
  Block block;
  block.nx = block.ny = 2;
  block.shape = Shape::mixed;
  block.distortion = 0.2;
  return block_mesh(block);
}

struct SmallBody {
  SmallBody() : mesh(small_block()), model(mesh, {isotropic(1, 0.3, 1)}, Model::Storage::full) {
    find_modes();
  }

  /// Component of every mode in `field` [owned], [modes]. Collective.
  Eigen::VectorXd in_modes(const Vector2* field) const {
    const auto whole = whole_field(PETSC_COMM_WORLD, mesh, field);
    return weighted_shapes.transpose() * Eigen::Map<const Eigen::VectorXd>(whole[0].data(), shapes.rows());
  }
  double highest() const { return omega[omega.size() - 1]; }

  const Mesh mesh;
  const Model model;
  Eigen::VectorXd omega;            ///< ascending, 1/s
  Eigen::MatrixXd shapes;           ///< [2 nodes, modes], φᵀMφ = 1, zero at the top
  Eigen::MatrixXd weighted_shapes;  ///< Mφ
  Eigen::VectorXd start;            ///< of every mode's velocity

 private:
  void find_modes();
};

void SmallBody::find_modes() {
  const auto size = 2 * mesh.nodes.total;
  Eigen::MatrixXd stiffness(size, size);
  Eigen::VectorXd mass(size), uniform(size);
  std::vector<Vector2> unit(mesh.nodes.number.size()), force(unit), owned(unit);
  for (int column = 0; column < size; ++column) {
    for (int i = 0; i < mesh.nodes.size(); ++i)
      for (int axis = 0; axis < 2; ++axis) unit[i][axis] = 2 * mesh.nodes.number[i] + axis == column;
    model.multiply(unit.data(), force.data());
    const auto whole = whole_field(PETSC_COMM_WORLD, mesh, force.data());
    stiffness.col(column) = Eigen::Map<const Eigen::VectorXd>(whole[0].data(), size);
    uniform[column] = start_velocity[column % 2];
  }
  for (int i = 0; i < mesh.nodes.owned; ++i) owned[i] = {model.mass[i], 0};
  for (int i : mesh.find_boundary("top")->nodes) owned[i][1] = 1;
  const auto whole = whole_field(PETSC_COMM_WORLD, mesh, owned.data());
  std::vector<int> free;
  for (int row = 0; row < size; ++row) {
    mass[row] = whole[row / 2][0];
    if (whole[row / 2][1] == 0) free.push_back(row);
  }
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(
      stiffness(free, free), Eigen::MatrixXd(mass(free).asDiagonal()));
  omega = solver.eigenvalues().cwiseSqrt();
  shapes = Eigen::MatrixXd::Zero(size, omega.size());
  shapes(free, Eigen::all) = solver.eigenvectors();
  weighted_shapes = mass.asDiagonal() * shapes;
  start = weighted_shapes.transpose() * uniform;
}

struct Choice {
  double beta2;
  Damping damping;
};

/// Every β2 without damping, with either kind and with both: ratio .1 of each kind at the frequency `omega`.
std::vector<Choice> choices(double omega) {
  std::vector<Choice> all;
  for (const double beta2 : betas)
    for (const double mass : {0.0, 0.2 * omega})
      for (const double stiffness : {0.0, 0.2 / omega}) all.push_back({beta2, {mass, stiffness}});
  return all;
}

Scene scene_of(const Choice& choice) {
  Scene scene;
  scene.conditions = {{"top", {0.0, 0.0}, 0, 0, 0}};
  scene.initial.velocity = start_velocity;
  scene.beta2 = choice.beta2;
  scene.damping = choice.damping;
  return scene;
}

std::string name_of(const Choice& choice, double omega) {
  std::string name = format("beta2 {:.1f}", choice.beta2);
  if (choice.damping.mass > 0) name += format(", a = {:.1f} omega", choice.damping.mass / omega);
  if (choice.damping.stiffness > 0) name += format(", b = {:.1f}/omega", choice.damping.stiffness * omega);
  return name;
}

/// u_1, …, u_count of every mode, [modes, count].
Eigen::MatrixXd modal_history(const SmallBody& small, const Choice& choice, double time_step, int count) {
  SlidingBody body(PETSC_COMM_WORLD, small.model, scene_of(choice), time_step);
  Eigen::MatrixXd history(small.omega.size(), count);
  for (int n = 0; n < count; ++n) {
    body.advance(false);
    history.col(n) = small.in_modes(body.next_displacement());
  }
  return history;
}

/// The dominant pair of roots in a decaying signal: u_{n+1} = 2 Re(z) u_n − |z|² u_{n−1}, by least squares
/// over the samples from `first` to `last`. {|z|, arg z}.
std::array<double, 2> fitted_pair(const Eigen::VectorXd& u, int first, int last) {
  Eigen::MatrixXd past(last - first, 2);
  past << u.segment(first, last - first), -u.segment(first - 1, last - first);
  const Eigen::Vector2d fit = past.colPivHouseholderQr().solve(u.segment(first + 1, last - first));
  const double radius = std::sqrt(fit[1]);
  return {radius, std::acos(fit[0] / (2 * radius))};
}

}  // namespace

/// Every mode of the body is an oscillator and obeys its amplification polynomial.
TEST(Scheme, EveryModeFollowsTheAmplificationPolynomial) {
  const SmallBody small;
  for (const Choice& choice : choices(small.highest())) {
    SCOPED_TRACE(name_of(choice, small.highest()));
    const double step = 0.9 * stable_step(small.highest(), choice.beta2, choice.damping);
    const Eigen::MatrixXd found = modal_history(small, choice, step, 60);
    for (int j = 0; j < small.omega.size(); ++j) {
      const Oscillator oscillator{small.omega[j], step, choice.beta2, choice.damping};
      const auto exact = oscillator.displacements(small.start[j], 60);
      const Eigen::Vector3d p = oscillator.polynomial();
      const double scale = found.row(j).cwiseAbs().maxCoeff();
      for (int n = 0; n < 60; ++n) ASSERT_NEAR(found(j, n), exact[n], 1e-10 * scale) << "mode " << j;
      for (int n = 3; n < 60; ++n)
        ASSERT_NEAR(found(j, n) + p[2] * found(j, n - 1) + p[1] * found(j, n - 2) + p[0] * found(j, n - 3), 0,
                    1e-11 * scale);
    }
  }
}

/// Spectral radius and phase a step of the highest mode at Ω = `phase`, as fitted and by the polynomial.
struct Rotation {
  std::array<double, 2> found, exact;
};

Rotation rotation(const SmallBody& small, const Choice& choice, double phase) {
  const double omega = small.highest(), step = phase / omega;
  const Eigen::VectorXd history =
      modal_history(small, choice, step, 40).row(small.omega.size() - 1).transpose();
  const Eigen::Vector3cd roots = Oscillator{omega, step, choice.beta2, choice.damping}.roots();
  const auto largest = *std::max_element(
      roots.begin(), roots.end(), [](const auto& x, const auto& y) { return std::abs(x) < std::abs(y); });
  // By the 25th step what is left of the third root is below rounding.
  return {fitted_pair(history, 25, 35), {std::abs(largest), std::abs(std::arg(largest))}};
}

/// Undamped the radius is √(1 − (β2−½)Ω²), and the phase differs from Ω in second order.
TEST(Scheme, SpectralRadiusAndPhase) {
  const SmallBody small;
  for (const Choice& choice : choices(small.highest())) {
    const auto [found, exact] = rotation(small, choice, 0.5);
    SCOPED_TRACE(name_of(choice, small.highest()));
    EXPECT_NEAR(found[0], exact[0], 1e-9);
    EXPECT_NEAR(found[1], exact[1], 1e-9);
    std::string order;
    const bool undamped = choice.damping.mass + choice.damping.stiffness == 0;
    if (undamped) {
      EXPECT_NEAR(found[0], std::sqrt(1 - (choice.beta2 - 0.5) * 0.25), 1e-9);
      const double phase_order =
          std::log2((found[1] / 0.5 - 1) / (rotation(small, choice, 0.25).found[1] / 0.25 - 1));
      EXPECT_NEAR(phase_order, 2, 0.1);
      order = format("{:.2f}", phase_order);
    }
    if (undamped || (choice.damping.mass > 0 && choice.damping.stiffness > 0 && choice.beta2 == 0.8))
      report({"Time scheme, highest mode of a small body at omega dt = 0.5",
              name_of(choice, small.highest()) + ": spectral radius; relative phase error",
              format("{:.6f}; {:+.6f}", exact[0], exact[1] / 0.5 - 1),
              format("{:.6f}; {:+.6f}", found[0], found[1] / 0.5 - 1), order,
              "roots of the amplification polynomial"});
  }
}

/// 0.5 % above the limit of `stable_step` the highest mode grows by the root outside the unit circle.
TEST(Scheme, LimitIsSharp) {
  const SmallBody small;
  const double omega = small.highest();
  for (const Choice& choice : choices(omega)) {
    SCOPED_TRACE(name_of(choice, omega));
    const double limit = stable_step(omega, choice.beta2, choice.damping),
                 exact = polynomial_limit(omega, choice.beta2, choice.damping);
    EXPECT_NEAR(limit / exact, 1, 1e-6);
    const Eigen::VectorXd history =
        modal_history(small, choice, 1.005 * limit, 400).row(small.omega.size() - 1).transpose();
    const double growth = -history[399] / history[398],
                 root = Oscillator{omega, 1.005 * limit, choice.beta2, choice.damping}.spectral_radius();
    EXPECT_GT(root, 1.001);
    EXPECT_NEAR(growth, root, 1e-8);
    if (choice.damping.mass == 0)
      report({"Stability limit", name_of(choice, omega) + ": omega dt; growth a step at 1.005 of it",
              format("{:.4f}; {:.6f}", omega * exact, root), format("{:.4f}; {:.6f}", omega * limit, growth),
              "", "roots of the amplification polynomial"});
  }
}

/// At 0.995 of the limit no component ever exceeds what the exact roots allow, Σ over modes |φ| Σ|C_k|.
TEST(Scheme, StaysBoundedBelowTheLimit) {
  const SmallBody small;
  double worst = 0;
  for (const Choice& choice : choices(small.highest())) {
    const double step = 0.995 * stable_step(small.highest(), choice.beta2, choice.damping);
    Eigen::VectorXd amplitude(small.omega.size());
    for (int j = 0; j < small.omega.size(); ++j)
      amplitude[j] =
          Oscillator{small.omega[j], step, choice.beta2, choice.damping}.largest_displacement(small.start[j]);
    const Eigen::VectorXd bound = small.shapes.cwiseAbs() * amplitude;
    SlidingBody body(PETSC_COMM_WORLD, small.model, scene_of(choice), step);
    std::vector<Vector2> largest(static_cast<std::size_t>(small.mesh.nodes.owned), {0, 0});
    for (int n = 0; n < 100000; ++n) {
      body.advance(false);
      for (int i = 0; i < small.mesh.nodes.owned; ++i)
        for (int axis = 0; axis < 2; ++axis)
          largest[i][axis] = std::max(largest[i][axis], std::abs(body.next_displacement()[i][axis]));
    }
    const auto whole = whole_field(PETSC_COMM_WORLD, small.mesh, largest.data());
    for (int row = 0; row < bound.size(); ++row) {
      EXPECT_LE(whole[row / 2][row % 2], (1 + 1e-9) * bound[row]) << name_of(choice, small.highest());
      if (bound[row] > 0) worst = worse(worst, whole[row / 2][row % 2] / bound[row]);
    }
  }
  report({"Stability limit",
          "largest u over its bound, 1e5 steps at 0.995 of the limit, 4 beta2 x 4 dampings", "<= 1",
          format("{:.3f}", worst), "", "exact roots and modes"});
}
