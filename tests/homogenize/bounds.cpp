#include "slipscale/homogenize/effective.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "stiffnesses.hpp"

using namespace slipscale;
using namespace slipscale::testing_support;

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
  three.push_back({"pore", 0, {isotropic_stiffness(1, 0.1), 1000, ""}});
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
