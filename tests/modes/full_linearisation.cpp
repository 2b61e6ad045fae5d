#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "dense_body.hpp"
#include "scenes.hpp"
#include "slipscale/base/parallel.hpp"
#include "slipscale/modes/sliding_modes.hpp"

using namespace slipscale;
using namespace slipscale::testing_support;

namespace {

using Straight = BoundaryCondition::Straight;

/// 10 × 10 cells with soft inclusions, 1 m, 1 kg/m³, Young's modulus 1 Pa and less.
Block block(bool periodic) {
  Block block;
  block.nx = block.ny = 10;
  block.shape = Shape::mixed;
  block.distortion = 0.15;
  block.periodic_x = periodic;
  block.region = [](double x, double y) { return std::hypot(x - 0.4, y - 0.3) < 0.22 ? 2 : 1; };
  return block;
}

std::vector<Material> materials() { return {isotropic(1, 0.3, 1), isotropic(0.3, 0.2, 1.5)}; }

Scene scene(double coefficient, double time) {
  Scene scene;
  scene.conditions = {{"top", {0.0, -1e-3}, 0, 0, 0}};
  scene.surface = Surface{"bottom", 0, 1, 0};
  scene.friction.law = time > 0 ? FrictionChoice::Law::regularized : FrictionChoice::Law::coulomb;
  scene.friction.coefficient = coefficient;
  scene.friction.time = time;
  return scene;
}

struct Case {
  const char* text;
  Scene scene;
  bool periodic = false;
};

std::vector<Case> cases() {
  std::vector<Case> all{{"regularised", scene(0.4, 0.3)},    {"Coulomb", scene(0.6, 0)},
                        {"periodic", scene(0.5, 0.2), true}, {"backwards", scene(0.4, 0.3)},
                        {"damped", scene(0.5, 0.25)},        {"slip rate", scene(0.5, 0.25)},
                        {"level plate", scene(0.4, 0.3)},    {"tilting plate", scene(0.4, 0.3)},
                        {"along x", scene(0.4, 0.3)},        {"falling", scene(0.6, 0.3)},
                        {"falling along x", scene(0.6, 0.2)}};
  all[3].scene.surface->speed = -1;
  all[4].scene.damping = {0.05, 0.01};
  all[4].scene.beta2 = 0.7;
  all[5].scene.friction.by_slip_rate = true;
  all[5].scene.friction.length = 0.25 * 1.5;
  all[5].scene.friction.rate_reference = 0.5;
  const auto formula = [](const std::string& text) {
    return std::make_shared<const Formula>(text, "x", Formula::Names{}, "coefficient of a case");
  };
  all[8].scene.friction.coefficient_formula = formula("0.5 + x");
  for (const std::size_t k : {9, 10}) {
    all[k].scene.friction.law = FrictionChoice::Law::exponential;
    all[k].scene.friction.kinetic = {0.3};
    all[k].scene.friction.slip_rate = 2;
    all[k].scene.damping.stiffness = 0.005;
  }
  all[10].scene.surface->speed = -1;
  all[10].scene.friction.coefficient = 1;
  all[10].scene.friction.coefficient_formula = formula("0.4 + 0.3*x");
  all[10].scene.friction.kinetic = {1, formula("0.2*(1 + x)")};
  for (const std::size_t k : {6, 7}) {
    BoundaryCondition& top = all[k].scene.conditions[0];
    top.displacement[1].reset();
    top.straight = k == 6 ? Straight::rigid : Straight::tilting;
    top.plate_force = -1e-3;
    top.plate_mass = 0.3;
    all[k].scene.damping.stiffness = 0.01;
  }
  return all;
}

/// Whole-mesh numbers of the closed nodes, and their reactions.
struct ClosedNodes {
  std::vector<PetscInt> number;
  std::vector<double> reaction;
};

ClosedNodes closed_nodes(const Mesh& mesh, const SteadySliding& state) {
  std::vector<Vector2> mark(static_cast<std::size_t>(mesh.nodes.owned), {0, 0});
  for (std::size_t k = 0; k < state.nodes.size(); ++k)
    mark[state.nodes[k].node] = {static_cast<double>(state.is_closed[k]), state.reaction[k]};
  const auto whole = whole_field(PETSC_COMM_WORLD, mesh, mark.data());
  ClosedNodes found;
  for (std::size_t i = 0; i < whole.size(); ++i)
    if (whole[i][0] != 0) {
      found.number.push_back(static_cast<PetscInt>(i));
      found.reaction.push_back(whole[i][1]);
    }
  return found;
}

const Complex& nearest(const std::vector<Complex>& all, Complex p) {
  return *std::ranges::min_element(
      all, [&](const Complex& a, const Complex& b) { return std::abs(a - p) < std::abs(b - p); });
}

/// Each is one of the expected, and none that grows faster is left out.
void expect_same(const char* text, const std::vector<Complex>& found, std::vector<Complex> expected,
                 double to) {
  std::erase_if(expected, [&](const Complex& p) { return p.imag() > 2 * std::numbers::pi * to; });
  std::ranges::sort(expected, [](const Complex& a, const Complex& b) { return a.real() > b.real(); });
  ASSERT_GE(expected.size(), found.size()) << text;
  for (std::size_t k = 0; k < found.size(); ++k) {
    const Complex same = nearest(expected, found[k]);
    EXPECT_LE(std::abs(found[k] - same), 1e-8 * std::abs(same))
        << text << ", mode " << k << ": " << found[k] << " for " << same;
    EXPECT_NEAR(found[k].real(), expected[k].real(), 1e-8 * std::abs(found[k])) << text << ", mode " << k;
  }
}

constexpr double highest = 1.2;  ///< Hz
constexpr double step = 0.01;    ///< s

ModesChoice choice() {
  ModesChoice choice;
  choice.count = 8;
  choice.to = highest;
  choice.tolerance = 1e-11;
  return choice;
}

double time_of(const Scene& scene) { return sliding_law(scene).time; }

}  // namespace

/// Which no basis reduces: every mode that grows fastest, to eight digits, in continuous time and in the
/// scheme.
TEST(SlidingModes, AreThoseOfTheFullLinearisation) {
  for (const Case& c : cases()) {
    const Mesh mesh = block_mesh(block(c.periodic));
    const Model model(mesh, materials(), Model::Storage::full);
    const SteadySliding state = steady_sliding(PETSC_COMM_WORLD, model, c.scene);
    ASSERT_GT(state.in_contact, 0) << c.text;
    ModesBasis basis = basis_of_real_modes(state, choice(), 1.4);
    const ModesReport report =
        find_sliding_modes(basis, state, c.scene, choice(), SchemeStep{step, c.scene.beta2});
    ASSERT_EQ(report.modes.size(), 8u) << c.text;
    const ClosedNodes closed = closed_nodes(mesh, state);
    const DenseBody dense = dense_body(mesh, materials(), c.scene, closed.number, closed.reaction);
    std::vector<Complex> found, in_scheme;
    for (const ReportedMode& each : report.modes) {
      EXPECT_LE(each.mode.residual, 1e-11) << c.text;
      found.push_back(each.mode.exponent);
      ASSERT_TRUE(each.scheme) << c.text;
      in_scheme.push_back(each.scheme->exponent);
    }
    expect_same(c.text, found, exponents_of(dense, c.scene, time_of(c.scene)), highest);
    const auto all = scheme_exponents_of(dense, c.scene, time_of(c.scene), step);
    for (const Complex& p : in_scheme) {
      const Complex same = nearest(all, p);
      EXPECT_LE(std::abs(same - p), 1e-8 * std::abs(p)) << c.text << ": " << p << " for " << same;
    }
  }
}
