#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "cells_checks.hpp"
#include "cells_composite.hpp"
#include "report.hpp"

using namespace slipscale;
using namespace slipscale::testing_support;

namespace {

constexpr double bound = 5e-4;  ///< within .05 % at 64 elements per cell

struct Phases {
  std::string moduli;
  double matrix, inclusion;      ///< Young's moduli, GPa, ν = .3
  std::vector<double> expected;  ///< GPa
};

struct Discs {
  std::string name;
  Arrangement arrangement;
  double fraction;
  std::vector<Phases> phases;
};

/// Moduli by complex potentials: disc_arrays.py beside this file prints them, its test holds them to these
/// digits.
const std::vector<Discs> arrays = {{"Square array of discs, f .2",
                                    Arrangement::square,
                                    0.2,
                                    {{"C11; C12; C66", 30, 80, {47.555857849, 19.987042639, 13.460227889}}}},
                                   {"Square array of discs, f .4",
                                    Arrangement::square,
                                    0.4,
                                    {{"C11; C12; C66", 30, 80, {56.954383132, 23.204850089, 15.726111201}},
                                     {"C11; C12; C66", 1, 10, {2.473748907, .881331514, .636349459}}}},
                                   {"Hexagonal array of discs, f .4",
                                    Arrangement::hexagonal,
                                    0.4,
                                    {{"k; G", 30, 80, {40.064667859, 16.257565649}}}}};

/// The independent moduli, GPa. The mesh lacks the symmetry of the array, so equals are averaged.
std::vector<double> moduli(Arrangement arrangement, const Eigen::Matrix3d& c) {
  const double c11 = 0.5e-9 * (c(0, 0) + c(1, 1)), c12 = 1e-9 * c(0, 1), c66 = 1e-9 * c(2, 2);
  if (arrangement == Arrangement::square) return {c11, c12, c66};
  return {0.5 * (c11 + c12), 0.5 * (0.5 * (c11 - c12) + c66)};
}

double largest_error(const std::vector<double>& found, const std::vector<double>& expected) {
  double most = 0;
  for (std::size_t k = 0; k < found.size(); ++k) most = std::max(most, std::abs(found[k] / expected[k] - 1));
  return most;
}

std::string listed(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) text += (text.empty() ? "" : "; ") + format("{:.6g}", value);
  return text;
}

/// Over two doublings. The meshes are not nested: from one to the next the shape of the cells changes the
/// factor before h² by up to a third, and with it the order by log(4/3)/log(4) = .2.
double order(const std::array<double, 3>& errors) { return 0.5 * std::log2(errors[0] / errors[2]); }

const char* cell_name(CellShape shape) { return shape == CellShape::triangle ? "P1" : "Q1"; }

void check(const Discs& discs, CellShape shape) {
  std::vector<std::array<double, 3>> errors(discs.phases.size());
  std::vector<std::vector<double>> found(discs.phases.size());
  for (int k = 0; k < 3; ++k) {
    const Mesh mesh = drawn_mesh(disc_array(discs.arrangement, discs.fraction, 16 << k, shape));
    for (std::size_t p = 0; p < discs.phases.size(); ++p) {
      const Phases& phases = discs.phases[p];
      const CellSolution solution = solve(mesh, two_materials(mesh, isotropic(1e9 * phases.matrix, 0.3, 1),
                                                              isotropic(1e9 * phases.inclusion, 0.3, 1)));
      found[p] = moduli(discs.arrangement, solution.stiffness);
      errors[p][k] = largest_error(found[p], phases.expected);
    }
  }
  for (std::size_t p = 0; p < discs.phases.size(); ++p) {
    const Phases& phases = discs.phases[p];
    EXPECT_LE(errors[p][2], bound) << discs.name << ", " << cell_name(shape);
    EXPECT_NEAR(order(errors[p]), 2, 0.25) << discs.name << ", " << cell_name(shape);
    report({format("{}, {:g}/{:g} GPa", discs.name, phases.matrix, phases.inclusion),
            format("{}, GPa, 64 {} elements per cell", phases.moduli, cell_name(shape)),
            listed(phases.expected) + " +- .05 %", listed(found[p]), format("{:.2f}", order(errors[p])),
            "complex potentials, disc_arrays.py"});
  }
}

/// ν and E of plane bulk modulus k = λ + G and shear modulus G.
Material of_moduli(double k, double g) {
  const double poisson = (k - g) / (2 * k);
  return isotropic(2 * g * (1 + poisson), poisson, 1);
}

}  // namespace

TEST(DiscArrays, ConvergeToTheReferenceInTriangles) {
  for (const Discs& discs : arrays) check(discs, CellShape::triangle);
}

TEST(DiscArrays, ConvergeToTheReferenceInQuadrilaterals) {
  for (const Discs& discs : arrays) check(discs, CellShape::quadrilateral);
}

/// Hill, J. Mech. Phys. Solids 12 (1964) 199: with one shear modulus the composite is isotropic whatever its
/// geometry, with that G and 1/(k + G) = Σ f/(k_i + G), here k 20 and 100 GPa, G 10 GPa. The error is that
/// of the discretisation; the bound is the one asked of the arrays, whose contrast is less.
TEST(EqualShearModuli, GiveHillsStiffness) {
  const Material matrix = of_moduli(20e9, 10e9), inclusion = of_moduli(100e9, 10e9);
  for (const CellShape shape : {CellShape::triangle, CellShape::quadrilateral}) {
    std::array<double, 3> errors{};
    std::array<double, 3> found{};
    double bulk = 0;
    for (int k = 0; k < 3; ++k) {
      const Mesh mesh = drawn_mesh(random_discs(0.3, 0.22, 24 << k, shape));
      double compliance = 0;
      for (const Region& region : mesh.regions)
        compliance += region.area / mesh.area() / (region.name == "matrix" ? 30e9 : 110e9);
      bulk = 1 / compliance - 10e9;
      Eigen::Matrix3d exact = 10e9 * Eigen::Matrix3d::Identity();
      exact.topLeftCorner<2, 2>() << bulk + 10e9, bulk - 10e9, bulk - 10e9, bulk + 10e9;
      const Eigen::Matrix3d c = solve(mesh, two_materials(mesh, matrix, inclusion)).stiffness;
      errors[k] = relative_difference(c, exact);
      found = {0.25e-9 * (c(0, 0) + c(1, 1) + c(0, 1) + c(1, 0)), 1e-9 * c(2, 2), errors[k]};
    }
    EXPECT_LE(errors[2], bound) << cell_name(shape);
    EXPECT_NEAR(order(errors), 2, 0.25) << cell_name(shape);
    report({"Equal shear moduli, random discs",
            format("k; G, GPa, 96 {} elements per cell", cell_name(shape)),
            format("{:.4f}; 10.0000 +- .05 %", 1e-9 * bulk), format("{:.4f}; {:.4f}", found[0], found[1]),
            format("{:.2f}", order(errors)), "Hill 1964"});
  }
}
