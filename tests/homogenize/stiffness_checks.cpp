#include "slipscale/homogenize/effective.hpp"

#include <gtest/gtest.h>

#include "stiffnesses.hpp"

using namespace slipscale;
using namespace slipscale::testing_support;

namespace {

/// A of the second phase of a laminate of normal y, and its C: ε_xx is common, σ_yy and σ_xy are.
struct Laminate {
  Eigen::Matrix3d stiffness = Eigen::Matrix3d::Zero(), mean_second = Eigen::Matrix3d::Identity();
};
Laminate laminate_of(const std::vector<Phase>& phases) {
  const Eigen::Matrix3d &c1 = phases[0].material.stiffness, &c2 = phases[1].material.stiffness;
  const double f1 = phases[0].fraction, f2 = phases[1].fraction;
  Laminate exact;
  // With s = (σ_yy, σ_xy) common and x = ε_xx: (ε_yy, γ) = D⁻¹(s − b x) in each phase, D the stiffness of
  // (yy, xy) and b its coupling to xx.
  const auto d = [](const Eigen::Matrix3d& c) -> Eigen::Matrix2d { return c.bottomRightCorner<2, 2>(); };
  const auto b = [](const Eigen::Matrix3d& c) -> Eigen::Vector2d { return c.bottomLeftCorner<2, 1>(); };
  const Eigen::Matrix2d mean = (f1 * d(c1).inverse() + f2 * d(c2).inverse()).inverse();
  const Eigen::Vector2d offset = mean * (f1 * d(c1).inverse() * b(c1) + f2 * d(c2).inverse() * b(c2));
  const auto localisation = [&](const Eigen::Matrix3d& c) {
    Eigen::Matrix3d a = Eigen::Matrix3d::Identity();
    a.bottomRightCorner<2, 2>() = d(c).inverse() * mean;
    a.bottomLeftCorner<2, 1>() = d(c).inverse() * (offset - b(c));
    return a;
  };
  exact.mean_second = localisation(c2);
  exact.stiffness = f1 * c1 * localisation(c1) + f2 * c2 * exact.mean_second;
  return exact;
}

}  // namespace

TEST(TwoPhaseIdentity, HoldsForTheLaminate) {
  const auto phases = composite(0.5);
  const Laminate exact = laminate_of(phases);
  EXPECT_LT((exact.stiffness - laminate()).cwiseAbs().maxCoeff(), 5e-7);  // the six decimals of the reference
  EXPECT_LT(two_phase_identity(phases, exact.stiffness, exact.mean_second), 1e-14);
  // An error of 1e-3 in A is seen.
  EXPECT_GT(two_phase_identity(phases, exact.stiffness, 1.001 * exact.mean_second), 5e-4);
}

TEST(TwoPhaseIdentity, HoldsForAnisotropicPhasesAndSharedModuli) {
  for (const auto& phases :
       {mixture(plane(50, 5), lower_symmetry(), 0.3), mixture(plane(3, 2), plane(40, 2), 0.3)}) {
    const Laminate exact = laminate_of(phases);
    EXPECT_LT(two_phase_identity(phases, exact.stiffness, exact.mean_second), 1e-13);
  }
  const auto same = mixture(plane(3, 2), plane(3, 2), 0.3);
  EXPECT_LT(two_phase_identity(same, plane(3, 2), Eigen::Matrix3d::Identity()), 1e-9);
}

TEST(SymmetryDefect, IsTheLargestDifference) {
  Eigen::Matrix3d c = plane(3, 1);
  c(0, 2) = 0.01;
  EXPECT_NEAR(symmetry_defect(c), 0.01 / 4, 1e-16);
  EXPECT_EQ(symmetry_defect(lower_symmetry()), 0);
}

TEST(Richardson, IsExactForAnErrorOfSecondOrder) {
  const Eigen::Matrix3d exact = lower_symmetry(), slope = plane(7, -3);
  const double h = 0.1;
  const auto estimate = richardson(exact + slope * h * h, exact + slope * h * h / 4);
  EXPECT_LT((estimate.error - slope * h * h).cwiseAbs().maxCoeff(), 1e-13);
  EXPECT_LT((estimate.extrapolated - exact).cwiseAbs().maxCoeff(), 1e-13);
}
