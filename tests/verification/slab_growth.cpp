#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "report.hpp"
#include "slab_lattice.hpp"
#include "slab_run.hpp"
#include "slipscale/base/print.hpp"
#include "slipscale/solid/material.hpp"

using namespace slipscale;
using namespace slipscale::testing_support;

namespace {

/// k = c_s = ρ = 1, so that K = k c_s T is T and s = p.
SlidingSlab isotropic_slab(double poisson, double height, double friction, double time, double damping = 0) {
  return {isotropic_stiffness(2 * (1 + poisson), poisson), 1, height, 1, friction, time, damping};
}

SlidingSlab orthotropic_slab(double c11, double c22, double c12, double time) {
  SlidingSlab slab = isotropic_slab(0.3, 2, 0.5, time);
  slab.stiffness << c11, c12, 0, c12, c22, 0, 0, 0, 1;
  return slab;
}

/// The laminate 30/80 GPa with layers along the surface, in units of its C66.
constexpr double along = 71.228771 / 16.783217, across = 58.741259 / 16.783217, mixed = 25.174825 / 16.783217;

struct Listed {
  double friction, time;
  Complex mode;
};
const Listed listed[] = {{0.5, 0, {0.229977, -3.419962}},   {0.5, 0.1, {0.204618, -3.364298}},
                         {0.5, 0.2, {0.164154, -3.331447}}, {0.5, 0.5, {0.067599, -3.328372}},
                         {0.3, 0, {0.147386, -3.428771}},   {0.3, 0.2, {0.100730, -3.368346}}};

/// Where the fastest mode of a slab is looked for, and with how many elements a wavelength.
struct Case {
  const char* text;
  SlidingSlab slab;
  Complex near;
  int elements = 128;
  double start = 16, end = 40;  ///< of the samples that are analysed, s
};

Complex mode_found(const Case& c, int elements) {
  SlabMesh mesh;
  mesh.elements = elements;
  mesh.end = c.end;
  const SlabMotion motion = run_slab(c.slab, mesh);
  EXPECT_TRUE(motion.always_slipping) << c.text;
  return nearest(exponents(motion.component(1, c.start), motion.interval, 1e-4), c.near);
}

std::string text_of(Complex s) { return format("{:.6f}, {:.6f}", s.real(), s.imag()); }

/// Asked for: .3 % in growth and .1 % in frequency at 128 elements a wavelength. Space and time are second
/// order, so half the elements give the order; with damping, which lags by half a step, it is not even.
void verify(const char* topic, const Case& c, double least_order) {
  const Complex expected = scaled_mode(c.slab, c.near), fine = mode_found(c, c.elements),
                coarse = mode_found(c, c.elements / 2);
  EXPECT_NEAR(fine.real() / expected.real(), 1, 3e-3) << c.text;
  EXPECT_NEAR(fine.imag() / expected.imag(), 1, 1e-3) << c.text;
  const double order = std::log2(std::abs(coarse - expected) / std::abs(fine - expected));
  EXPECT_GE(order, least_order) << c.text;
  report({topic, format("{}, {} elements", c.text, c.elements), text_of(expected) + " within 0.3 %, 0.1 %",
          text_of(fine), least_order > 0 ? format("{:.1f}", order) : "", "4 x 4 determinant, in the test"});
}

/// The stiffness of a solid turned by an angle, Voigt.
Eigen::Matrix3d turned(const Eigen::Matrix3d& c, double angle) {
  const double a = std::cos(angle), b = std::sin(angle);
  Eigen::Matrix3d bond;
  bond << a * a, b * b, -2 * a * b, b * b, a * a, 2 * a * b, a * b, -a * b, a * a - b * b;
  return bond * c * bond.transpose();
}

/// 2π m of length, a whole number of square elements for 32 and its multiples.
constexpr double length = 2 * std::numbers::pi, grid_height = length * 10 / 32;

}  // namespace

TEST(SlabDeterminant, HasTheListedModes) {
  for (const Listed& entry : listed) {
    const SlidingSlab slab = isotropic_slab(0.3, 2, entry.friction, entry.time);
    const Complex found = scaled_mode(slab, entry.mode);
    EXPECT_NEAR(found.real(), entry.mode.real(), 5.1e-7);
    EXPECT_NEAR(found.imag(), entry.mode.imag(), 5.1e-7);
  }
}

/// The quartic of the anisotropic solid and the two potentials of the isotropic one are different
/// derivations.
TEST(SlabDeterminant, AgreesWithTheTwoPotentials) {
  for (const double poisson : {0.0, 0.2, 0.4})
    for (const double height : {0.7, 2.0, 4.0})
      for (const double damping : {0.0, 0.03}) {
        const SlidingSlab slab = isotropic_slab(poisson, height, 0.6, 0.15, damping);
        const Complex mode = scaled_mode(slab, {0.1, -3});
        ASSERT_TRUE(std::isfinite(mode.real()));
        const Complex other = zero_near([&](Complex p) { return potential_determinant(slab, p); }, mode);
        EXPECT_LE(std::abs(other - mode), 1e-9);
      }
}

/// With C16 and C26 as well: the modes of ever finer lattices converge to it with order two.
TEST(SlabDeterminant, IsTheLimitOfTheLattice) {
  SlidingSlab slab = orthotropic_slab(8, 3, 1.5, 0.2);
  slab.stiffness = turned(slab.stiffness, 0.5);
  ASSERT_GT(std::abs(slab.stiffness(0, 2)), 0.3);
  const auto on_lattice = [&](int layers) { return lattice_modes({slab, slab.height / layers}); };
  const Complex mode =
      zero_near([&](Complex p) { return slab_determinant(slab, p); }, fastest(on_lattice(16)));
  const Complex coarse = nearest(on_lattice(16), mode), fine = nearest(on_lattice(32), mode);
  EXPECT_GE(std::log2(std::abs(coarse - mode) / std::abs(fine - mode)), 1.8);
  EXPECT_LE(std::abs(4.0 / 3 * fine - coarse / 3.0 - mode), 0.1 * std::abs(fine - mode));
}

TEST(SlabInstability, HasTheModeOfTheDeterminant) {
  const char* topic = "Frictional instability of a slab: growth, frequency over k c_s (K = k c_s T)";
  for (const Case& c :
       {Case{"kH 2, mu 0.5, nu 0.3, K 0.1", isotropic_slab(0.3, 2, 0.5, 0.1), {0.20, -3.36}},
        Case{"kH 2, mu 0.5, nu 0.3, K 0.2", isotropic_slab(0.3, 2, 0.5, 0.2), {0.16, -3.33}},
        Case{"kH 2, mu 0.5, nu 0.3, K 0.5", isotropic_slab(0.3, 2, 0.5, 0.5), {0.07, -3.33}},
        Case{"kH 2, mu 0.3, nu 0.3, K 0.2", isotropic_slab(0.3, 2, 0.3, 0.2), {0.10, -3.37}},
        Case{"kH 2, mu 0.7, nu 0.3, K 0.2", isotropic_slab(0.3, 2, 0.7, 0.2), {0.22, -3.30}},
        Case{"kH 2, mu 0.5, nu 0.2, K 0.2", isotropic_slab(0.2, 2, 0.5, 0.2), {0.13, -3.04}},
        Case{"kH 2, mu 0.5, nu 0.4, K 0.2", isotropic_slab(0.4, 2, 0.5, 0.2), {0.12, -3.84}, 192},
        Case{"kH 1, mu 0.5, nu 0.3, K 0.2", isotropic_slab(0.3, 1, 0.5, 0.2), {0.22, -5.98}, 192},
        Case{"kH 4, mu 0.5, nu 0.3, K 0.2", isotropic_slab(0.3, 4, 0.5, 0.2), {0.09, 1.34}, 128, 16, 60}})
    verify(topic, c, 1.9);
}

/// Coulomb's own mode, as long as the grid-scale mode below has not grown out of rounding.
TEST(SlabInstability, HasTheModeOfCoulombFriction) {
  for (const double friction : {0.3, 0.5}) {
    const Case c{"", isotropic_slab(0.3, 2, friction, 0), {friction * 0.47, -3.42}, 64, 0, 20};
    const Complex expected = scaled_mode(c.slab, c.near), fine = mode_found(c, 64),
                  coarse = mode_found(c, 32), found = (4.0 * fine - coarse) / 3.0;
    EXPECT_NEAR(found.real() / expected.real(), 1, 3e-3);
    EXPECT_NEAR(found.imag() / expected.imag(), 1, 1e-3);
    report({"Frictional instability of a slab: growth, frequency over k c_s (K = k c_s T)",
            format("kH 2, mu {:.1f}, nu 0.3, K 0 (Coulomb), from 32 and 64 elements", friction),
            text_of(expected) + " within 0.3 %, 0.1 %", format("{:.4f}, {:.4f}", found.real(), found.imag()),
            format("{:.1f}", std::log2(std::abs(coarse - expected) / std::abs(fine - expected))),
            "4 x 4 determinant, in the test"});
  }
}

TEST(SlabInstability, IsDampedAsTheDeterminantSays) {
  const char* topic = "Slab instability with stiffness damping: growth, frequency over k c_s";
  verify(topic, {"b k c_s 0.01, kH 2, mu 0.5, K 0.2", isotropic_slab(0.3, 2, 0.5, 0.2, 0.01), {0.11, -3.3}},
         0);
  verify(topic, {"b k c_s 0.02, kH 2, mu 0.5, K 0.2", isotropic_slab(0.3, 2, 0.5, 0.2, 0.02), {0.05, -3.3}},
         0);
}

/// Axes along the surface: for others the library refuses the uniform sliding state to start from.
TEST(SlabInstability, HasTheModeOfAnOrthotropicSlab) {
  const char* topic = "Slab instability, orthotropic, kH 2, mu 0.5, K 0.2: growth, frequency over k c_s";
  verify(topic, {"laminate 30/80 GPa along x", orthotropic_slab(along, across, mixed, 0.2), {0.16, -3.38}},
         1.9);
  verify(topic, {"laminate 30/80 GPa along y", orthotropic_slab(across, along, mixed, 0.2), {0.18, -3.49}},
         1.9);
  verify(topic, {"C11, C22, C12 = 8, 3.5, 1.5 C66", orthotropic_slab(8, 3.5, 1.5, 0.2), {0.16, 2.49}}, 1.9);
}

/// At grid scale the Coulomb problem has a mode of its own whose growth doubles with each
/// refinement; a half-space with μ < 1 has none.
TEST(GridScaleMode, GrowsFasterOnEveryFinerMeshWithCoulomb) {
  std::array<double, 3> found{}, expected{};
  for (std::size_t level = 0; level < 3; ++level) {
    const int elements = 32 << level, wave_number = elements * 9 / 32;
    const double h = length / elements;
    SlidingSlab slab = isotropic_slab(0.3, grid_height, 0.5, 0);
    const SlabMotion motion = run_slab(slab, {elements, length / wave_number, 80 * h, h / 4});
    ASSERT_TRUE(motion.always_slipping);
    found[level] = fastest(exponents(motion.component(wave_number, 40 * h), h / 4, 1e-4)).real();
    slab.wave_number = wave_number;
    expected[level] = with_time_step(fastest(lattice_modes({slab, h})), motion.time_step).real();
    EXPECT_NEAR(found[level] / expected[level], 1, 1e-3) << elements;
  }
  EXPECT_NEAR(found[1] / found[0], 2, 0.02);
  EXPECT_NEAR(found[2] / found[1], 2, 0.02);
  report({"Grid-scale mode, wavelength 3.56 h, mu 0.5, H 1.96",
          "Coulomb, growth rate over c_s/m with 32, 64, 128 elements in 6.28 m",
          format("{:.3f}, {:.3f}, {:.3f}: doubles", expected[0], expected[1], expected[2]),
          format("{:.3f}, {:.3f}, {:.3f}", found[0], found[1], found[2]), "",
          "eigenvalues of one column of nodes, in the test"});
}

/// The same with c_s T = 2h: no wave of up to 8h grows at more than a tenth of that rate. What is left is the
/// slab's own instability.
TEST(GridScaleMode, IsAbsentWithTheRegularisedLaw) {
  std::array<double, 2> largest{};
  double coulomb = 0;
  for (std::size_t level = 0; level < 2; ++level) {
    const int elements = 64 << level;
    const double h = length / elements;
    SlidingSlab slab = isotropic_slab(0.3, grid_height, 0.5, 2 * h);
    // No whole number of waves in the length: the seed holds every wave number.
    const SlabMotion motion = run_slab(slab, {elements, 3.7 * h, 400 * h, h});
    ASSERT_TRUE(motion.always_slipping);
    for (int wave_number = elements / 8; wave_number < elements / 2; ++wave_number) {
      const auto series = motion.component(wave_number, 100 * h);
      const Eigen::Map<const Eigen::VectorXcd> all(series.data(), static_cast<Eigen::Index>(series.size()));
      const double growth = std::log(all.tail(150).norm() / all.head(150).norm()) / 150;
      largest[level] = std::max(largest[level], growth);
    }
    slab.relaxation_time = 0;
    slab.wave_number = elements * 9 / 32;
    coulomb = fastest(lattice_modes({slab, h})).real() * h;
    EXPECT_LE(largest[level], 0.1 * coulomb) << elements;
  }
  report({"Grid-scale mode, wavelength 3.56 h, mu 0.5, H 1.96",
          "c_s T = 2h, growth rate over c_s/h of any wave from 2h to 8h, 64 and 128 elements",
          format("below a tenth of Coulomb's {:.3f}", coulomb),
          format("{:.4f}, {:.4f}", largest[0], largest[1]), "",
          "eigenvalues of one column of nodes, in the test"});
}
