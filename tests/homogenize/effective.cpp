#include "slipscale/homogenize/effective.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

using namespace slipscale;

namespace {

Material isotropic(double young, double poisson) {
  return {isotropic_stiffness(young, poisson), 1000 + young, "isotropic"};
}

/// Plane isotropic C from the plane bulk modulus k and the shear modulus g.
Eigen::Matrix3d plane(double k, double g) {
  Eigen::Matrix3d c;
  c << k + g, k - g, 0, k - g, k + g, 0, 0, 0, g;
  return c;
}

std::vector<Phase> mixture(const Eigen::Matrix3d& first, const Eigen::Matrix3d& second, double fraction) {
  return {{"matrix", 1 - fraction, {first, 1000, ""}}, {"inclusion", fraction, {second, 2500, ""}}};
}

/// 30 and 80 GPa, ν = .3, in GPa as everything here.
std::vector<Phase> composite(double fraction) {
  return mixture(isotropic_stiffness(30, 0.3), isotropic_stiffness(80, 0.3), fraction);
}

/// Exact: half and half, normal y, GPa.
Eigen::Matrix3d laminate() {
  Eigen::Matrix3d c;
  c << 71.228771, 25.174825, 0, 25.174825, 58.741259, 0, 0, 0, 16.783217;
  return c;
}

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

Eigen::Matrix3d lower_symmetry() {
  Eigen::Matrix3d c;
  c << 90, 20, 5, 20, 40, -3, 5, -3, 15;
  return c;
}

}  // namespace

TEST(Bounds, LaminateLiesBetweenThem) {
  const auto phases = composite(0.5);
  // It attains both: C66 is Reuss's, and under ε_yy = −ν/(1 − ν) ε_xx, which leaves σ_yy = 0 in either phase,
  // the strain is uniform. Six decimals are given.
  EXPECT_NEAR(excess(laminate(), reuss_bound(phases)), 0, 1e-8);
  EXPECT_NEAR(excess(voigt_bound(phases), laminate()), 0, 1e-8);
  EXPECT_NEAR(reuss_bound(phases)(2, 2), 16.783217, 5e-7);
  const auto bounds = hashin_shtrikman(phases).value();
  const auto e = engineering_constants(laminate());
  EXPECT_GT(e.bulk, bounds.bulk_low);
  EXPECT_LT(e.bulk, bounds.bulk_high);
  EXPECT_GT(e.shear_mean(), bounds.shear_low);
  EXPECT_LT(e.shear_mean(), bounds.shear_high);
  // Its least shear modulus is Reuss's: below the bound of isotropic mixtures, which does not hold for it.
  EXPECT_LT(e.shear_least, bounds.shear_low);
}

TEST(Bounds, ExcessSeesWhereOneFormIsNotAboveTheOther) {
  EXPECT_NEAR(excess(plane(3, 2), plane(3, 1)), 0, 1e-15);
  EXPECT_NEAR(excess(plane(3, 2), plane(1, 1)), 1.0 / 6, 1e-15);   // 2k = 6 is the largest, γ gains 1
  EXPECT_NEAR(excess(plane(3, 2), plane(1, 3)), -2.0 / 6, 1e-15);  // 2G: 4 − 6
}

/// Square and hexagonal arrays of discs, from a semi-analytic solution.
TEST(Bounds, ArraysOfDiscsLieBetweenHashinAndShtrikman) {
  struct Array {
    double fraction, k, g;
  };
  const double square20 = 0.5 * (47.555857849 + 19.987042639), square40 = 0.5 * (56.954383132 + 23.204850089);
  const double shear20 = 0.5 * (13.460227889 + 0.5 * (47.555857849 - 19.987042639)),
               shear40 = 0.5 * (15.726111201 + 0.5 * (56.954383132 - 23.204850089));
  for (const Array& array : {Array{0.2, square20, shear20}, Array{0.4, square40, shear40},
                             Array{0.4, 40.064667859, 16.257565649}}) {
    const auto bounds = hashin_shtrikman(composite(array.fraction)).value();
    EXPECT_GT(array.k, bounds.bulk_low);
    EXPECT_LT(array.k, bounds.bulk_high);
    EXPECT_GT(array.g, bounds.shear_low);
    EXPECT_LT(array.g, bounds.shear_high);
  }
}

/// Values from Hashin's form of 1965, k₁ + f₂/(1/(k₂ − k₁) + f₁/(k₁ + G₁)) and
/// G₁ + f₂/(1/(G₂ − G₁) + f₁(k₁ + 2G₁)/(2G₁(k₁ + G₁))), evaluated with 30 digits.
TEST(HashinShtrikman, AgreesWithThePublishedForm) {
  struct Row {
    double young1, poisson1, young2, poisson2, fraction;
    double bulk_low, bulk_high, shear_low, shear_high;
  };
  for (const Row& row :
       {Row{30, .3, 80, .3, .4, 40.0641025641, 41.80602006689, 16.22073578595, 17.02127659574},
        Row{30, .3, 80, .3, .5, 43.9150401837, 45.97701149425, 17.79964221825, 18.73657069188},
        Row{1, .3, 10, .3, .4, 1.674208144796, 2.62573964497, 0.6942737773409, 1.143837575064},
        Row{3, .4, 400, .2, .25, 7.434633929832, 36.48785202759, 1.674750965056, 16.89345302987}}) {
    const auto bounds = hashin_shtrikman(mixture(isotropic_stiffness(row.young1, row.poisson1),
                                                 isotropic_stiffness(row.young2, row.poisson2), row.fraction))
                            .value();
    EXPECT_NEAR(bounds.bulk_low / row.bulk_low, 1, 1e-12);
    EXPECT_NEAR(bounds.bulk_high / row.bulk_high, 1, 1e-12);
    EXPECT_NEAR(bounds.shear_low / row.shear_low, 1, 1e-12);
    EXPECT_NEAR(bounds.shear_high / row.shear_high, 1, 1e-12);
  }
}

TEST(HashinShtrikman, OrderAndNumberOfRegionsDoNotMatter) {
  const auto one = composite(0.3);
  auto other = one;
  std::swap(other[0], other[1]);
  other.push_back({"second family", 0.1, other[0].material});
  other[0].fraction -= 0.1;
  const auto a = hashin_shtrikman(one).value(), b = hashin_shtrikman(other).value();
  EXPECT_NEAR(a.bulk_low, b.bulk_low, 1e-13 * a.bulk_low);
  EXPECT_NEAR(a.bulk_high, b.bulk_high, 1e-13 * a.bulk_high);
  EXPECT_NEAR(a.shear_low, b.shear_low, 1e-13 * a.shear_low);
  EXPECT_NEAR(a.shear_high, b.shear_high, 1e-13 * a.shear_high);
}

/// The bounds enclose something where the phase of larger k has the smaller G, too, and lie within Voigt's
/// and Reuss's.
TEST(HashinShtrikman, BadlyOrderedPhases) {
  const auto phases = mixture(plane(50, 5), plane(20, 15), 0.4);
  const auto bounds = hashin_shtrikman(phases).value();
  const auto reuss = engineering_constants(reuss_bound(phases)),
             voigt = engineering_constants(voigt_bound(phases));
  EXPECT_LT(reuss.bulk, bounds.bulk_low);
  EXPECT_LT(bounds.bulk_low, bounds.bulk_high);
  EXPECT_LT(bounds.bulk_high, voigt.bulk);
  EXPECT_LT(reuss.shear, bounds.shear_low);
  EXPECT_LT(bounds.shear_low, bounds.shear_high);
  EXPECT_LT(bounds.shear_high, voigt.shear);
}

/// Hill: equal shear moduli, any geometry: 1/(k + G) = Σ f_i/(k_i + G); the bounds leave no room.
TEST(HashinShtrikman, MeetAtHillsSolution) {
  const double k1 = 3, k2 = 40, g = 2, f = 0.35;
  const auto bounds = hashin_shtrikman(mixture(plane(k1, g), plane(k2, g), f)).value();
  const double k = 1 / ((1 - f) / (k1 + g) + f / (k2 + g)) - g;
  EXPECT_NEAR(bounds.bulk_low, k, 1e-13 * k);
  EXPECT_NEAR(bounds.bulk_high, k, 1e-13 * k);
  EXPECT_NEAR(bounds.shear_low, g, 1e-13 * g);
  EXPECT_NEAR(bounds.shear_high, g, 1e-13 * g);
}

TEST(HashinShtrikman, CloseOnPhasesThatAreNearlyTheSame) {
  const double k = 10, g = 4, apart = 1e-9;
  const auto bounds =
      hashin_shtrikman(mixture(plane(k, g), plane(k * (1 + apart), g * (1 + apart)), 0.5)).value();
  for (const double found :
       {bounds.bulk_low / k, bounds.bulk_high / k, bounds.shear_low / g, bounds.shear_high / g})
    EXPECT_NEAR(found, 1 + apart / 2, 1e-14);
}

TEST(HashinShtrikman, OnlyForTwoIsotropicPhases) {
  EXPECT_FALSE(hashin_shtrikman(mixture(plane(3, 1), plane(3, 1), 0.5)));  // one elastic phase
  EXPECT_FALSE(hashin_shtrikman(mixture(plane(3, 1), lower_symmetry(), 0.5)));
  auto three = composite(0.5);
  three.push_back({"pore", 0, isotropic(1, 0.1)});
  EXPECT_FALSE(hashin_shtrikman(three));
}

TEST(Phases, OneStiffnessIsOnePhase) {
  std::vector<Phase> phases = composite(0.5);
  phases.push_back({"again", 0.25, phases[0].material});
  phases[0].fraction = 0.25;
  phases[2].material.density = 1;  // of no matter for the stiffness
  const auto distinct = elastic_phases(phases);
  ASSERT_EQ(distinct.size(), 2u);
  EXPECT_EQ(distinct[0].region, "matrix");
  EXPECT_EQ(distinct[0].fraction, 0.5);
  EXPECT_EQ(distinct[1].fraction, 0.5);
  EXPECT_EQ(mean_density(phases), 0.25 * 1000 + 0.5 * 2500 + 0.25);
}

TEST(Isotropy, IsSeen) {
  EXPECT_TRUE(is_isotropic(isotropic_stiffness(70e9, 0.49)));
  EXPECT_FALSE(is_isotropic(laminate()));
  for (const auto& [i, j] : {std::pair(0, 0), std::pair(2, 2), std::pair(0, 2), std::pair(1, 0)}) {
    Eigen::Matrix3d c = plane(3, 1);
    c(i, j) += 1e-6;
    EXPECT_FALSE(is_isotropic(c)) << i << j;
  }
}

/// In plane strain 1/S11 = E/(1 − ν²) and −S12/S11 = ν/(1 − ν).
TEST(EngineeringConstants, InvertIsotropicStiffness) {
  for (const double nu : {-0.4, 0.0, 0.25, 0.3, 0.49}) {
    const double young = 80e9;
    const auto e = engineering_constants(isotropic_stiffness(young, nu));
    EXPECT_NEAR(e.young / young, 1, 1e-12);
    EXPECT_NEAR(e.poisson, nu, 1e-12);
    EXPECT_NEAR(e.young_x / (young / (1 - nu * nu)), 1, 1e-12);
    EXPECT_NEAR(e.young_y / e.young_x, 1, 1e-12);
    EXPECT_NEAR(e.poisson_xy, nu / (1 - nu), 1e-12);
    EXPECT_NEAR(e.poisson_yx, nu / (1 - nu), 1e-12);
    const double g = young / (2 * (1 + nu));
    for (const double shear : {e.shear, e.shear_least, e.shear_most, e.shear_mean()})
      EXPECT_NEAR(shear / g, 1, 1e-12);
    EXPECT_NEAR(e.bulk / (g / (1 - 2 * nu)), 1, 1e-12);
    EXPECT_LT(e.anisotropy, 1e-13);
  }
}

/// S of an orthotropic plate by hand: with C12 = 20, C11 = 90, C22 = 40 the determinant is 3200.
TEST(EngineeringConstants, Orthotropic) {
  Eigen::Matrix3d c;
  c << 90, 20, 0, 20, 40, 0, 0, 0, 15;
  const auto e = engineering_constants(c);
  EXPECT_NEAR(e.young_x, 3200.0 / 40, 1e-12);
  EXPECT_NEAR(e.young_y, 3200.0 / 90, 1e-12);
  EXPECT_NEAR(e.poisson_xy, 20.0 / 40, 1e-14);
  EXPECT_NEAR(e.poisson_yx, 20.0 / 90, 1e-14);
  EXPECT_NEAR(e.shear, 15, 1e-13);
  EXPECT_NEAR(e.bulk, 42.5, 1e-13);
  EXPECT_NEAR(e.shear_least, 15, 1e-13);
  EXPECT_NEAR(e.shear_most, 22.5, 1e-13);
}

/// On the orthonormal basis of the change of area and the two shears C is diagonal: 2k, 2G of xx − yy, 2G of
/// xy. The nearest isotropic solid has the mean of the latter two in their place.
TEST(EngineeringConstants, Anisotropy) {
  const double k = 3, extension = 1.5, shear = 1;  // moduli of the area, of xx − yy and of xy
  Eigen::Matrix3d c;
  c << k + extension, k - extension, 0, k - extension, k + extension, 0, 0, 0, shear;
  const auto e = engineering_constants(c);
  const double off = extension - shear;
  EXPECT_NEAR(e.anisotropy, std::hypot(off, off) / std::hypot(2 * k, 2 * extension, 2 * shear), 1e-14);
}

/// Turning the axes changes the constants along them, not those of the nearest isotropic solid.
TEST(EngineeringConstants, InvariantsDoNotTurn) {
  const auto e = engineering_constants(lower_symmetry());
  for (const double angle : {0.3, 0.9, 2.0}) {
    const double c = std::cos(angle), s = std::sin(angle);
    Eigen::Matrix3d turn;  // strains (xx, yy, γ) on turned axes
    turn << c * c, s * s, c * s, s * s, c * c, -c * s, -2 * c * s, 2 * c * s, c * c - s * s;
    const auto turned = engineering_constants(turn.transpose() * lower_symmetry() * turn);
    EXPECT_NEAR(turned.bulk, e.bulk, 1e-12);
    EXPECT_NEAR(turned.shear_least, e.shear_least, 1e-12);
    EXPECT_NEAR(turned.shear_most, e.shear_most, 1e-12);
    EXPECT_NEAR(turned.young, e.young, 1e-12);
    EXPECT_NEAR(turned.poisson, e.poisson, 1e-13);
    EXPECT_NEAR(turned.anisotropy, e.anisotropy, 1e-13);
    EXPECT_GT(std::abs(turned.young_x - e.young_x), 1);
  }
}

TEST(SymmetryDefect, IsTheLargestDifference) {
  Eigen::Matrix3d c = plane(3, 1);
  c(0, 2) = 0.01;
  EXPECT_NEAR(symmetry_defect(c), 0.01 / 4, 1e-16);
  EXPECT_EQ(symmetry_defect(lower_symmetry()), 0);
}

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

TEST(Richardson, IsExactForAnErrorOfSecondOrder) {
  const Eigen::Matrix3d exact = lower_symmetry(), slope = plane(7, -3);
  const double h = 0.1;
  const auto estimate = richardson(exact + slope * h * h, exact + slope * h * h / 4);
  EXPECT_LT((estimate.error - slope * h * h).cwiseAbs().maxCoeff(), 1e-13);
  EXPECT_LT((estimate.extrapolated - exact).cwiseAbs().maxCoeff(), 1e-13);
}
