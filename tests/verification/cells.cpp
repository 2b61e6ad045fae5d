#include <gtest/gtest.h>

#include <cmath>

#include "cells_checks.hpp"
#include "report.hpp"

using namespace slipscale;
using namespace slipscale::testing_support;

namespace {

constexpr double rounding = 1e-10;  ///< what is asked of laminates: exact in linear elements

struct Layer {
  double fraction;
  Eigen::Matrix3d stiffness;  ///< Pa
};

/// Any layers with normal along `axis`: the strain along the layers (index a) and the tractions across them
/// (indices b) are uniform. With ⟨·⟩ over the layers,
///   C_bb = ⟨C_bb⁻¹⟩⁻¹,  C_ba = C_bb ⟨C_bb⁻¹ C_ba⟩,  C_aa = ⟨C_aa − C_ab C_bb⁻¹ C_ba⟩ + C_ab C_bb⁻¹ C_ba.
/// (Milton, The Theory of Composites, section 9.2)
Eigen::Matrix3d laminate(const std::vector<Layer>& layers, int axis) {
  const int a = 1 - axis;
  const std::vector<int> along{a}, across{axis, 2};
  Eigen::Matrix2d compliance = Eigen::Matrix2d::Zero();
  Eigen::Vector2d coupling = Eigen::Vector2d::Zero();
  double own = 0;
  for (const auto& [fraction, c] : layers) {
    const Eigen::Matrix2d bb = c(across, across);
    const Eigen::Vector2d ba = c(across, along);
    compliance += fraction * bb.inverse();
    coupling += fraction * bb.inverse() * ba;
    own += fraction * (c(a, a) - ba.dot(bb.inverse() * ba));
  }
  const Eigen::Matrix2d bb = compliance.inverse();
  const Eigen::Vector2d ba = bb * coupling;
  Eigen::Matrix3d c;
  c(across, across) = bb;
  c(across, along) = ba;
  c(along, across) = ba.transpose();
  c(a, a) = own + ba.dot(coupling);
  return c;
}

/// A torus of aligned cells whose lower half (along `axis`) is matrix and whose upper half is inclusion.
Mesh layered(Shape shape, int axis) {
  Block block;
  block.nx = axis == 0 ? 8 : 5;
  block.ny = axis == 0 ? 5 : 8;
  block.shape = shape;
  block.periodic_x = block.periodic_y = true;
  block.region = [axis](double x, double y) { return (axis == 0 ? x : y) < 0.5 ? 1 : 2; };
  return block_mesh(block);
}

/// Makes a third region of the first quarter along `axis`, half of the matrix: the writer knows two regions.
void split_matrix(Mesh& mesh, int axis) {
  Region third{"third", 3, mesh.cells.total / 4, 0.25};
  for (Region& region : mesh.regions)
    if (region.name == "matrix") region.area = 0.25;
  for (int cell = 0; cell < mesh.cells.size(); ++cell) {
    double middle = 0;
    for (int c = mesh.cells.first[cell]; c < mesh.cells.first[cell + 1]; ++c)
      middle += mesh.cells.corners[c][axis] / mesh.cells.corner_count(cell);
    middle -= std::floor(middle);
    if (middle < 0.25) mesh.cells.region[cell] = static_cast<int>(mesh.regions.size());
  }
  mesh.regions.push_back(third);
}

Material anisotropic() {
  Material material{Eigen::Matrix3d::Zero(), 3000, "anisotropic"};
  material.stiffness << 60e9, 20e9, 5e9, 20e9, 50e9, -3e9, 5e9, -3e9, 18e9;
  return material;
}

const Material soft = isotropic(30e9, 0.3, 2000), stiff = isotropic(80e9, 0.3, 4000);

/// Layers along x, turned by 90° where the normal is x.
Eigen::Matrix3d found_laminate(Shape shape, int axis) {
  const Mesh mesh = layered(shape, axis);
  return solve(mesh, two_materials(mesh, soft, stiff)).stiffness;
}

}  // namespace

/// Exact: 71.228771, 58.741259, 25.174825, 16.783217 GPa, given to 8 digits; exact to rounding.
TEST(Laminate, OfTwoIsotropicLayersIsExact) {
  for (int axis : {0, 1}) {
    const int along = 1 - axis;
    const Eigen::Matrix3d exact = laminate({{0.5, soft.stiffness}, {0.5, stiff.stiffness}}, axis);
    EXPECT_NEAR(exact(along, along), 71.228771e9, 1e3);
    EXPECT_NEAR(exact(axis, axis), 58.741259e9, 1e3);
    EXPECT_NEAR(exact(0, 1), 25.174825e9, 1e3);
    EXPECT_NEAR(exact(2, 2), 16.783217e9, 1e3);
    double worst = 0;
    Eigen::Matrix3d found;
    for (const Shape shape : {Shape::triangles, Shape::quadrilaterals}) {
      found = found_laminate(shape, axis);
      const double error = relative_difference(found, exact);
      EXPECT_LE(error, rounding) << "axis " << axis;
      worst = worse(worst, error);
    }
    const std::string topic = format("Laminate 30/80 GPa, half and half, normal {}", axis == 0 ? 'x' : 'y');
    report({topic, "C along the layers; C across; C12; C66, GPa",
            "71.228771; 58.741259; 25.174825; 16.783217",
            format("{:.6f}; {:.6f}; {:.6f}; {:.6f}", 1e-9 * found(along, along), 1e-9 * found(axis, axis),
                   1e-9 * found(0, 1), 1e-9 * found(2, 2)),
            "", "exact solution"});
    report({topic, "largest relative error, P1 and Q1", "<= 1e-10", shown_error(worst, 1e-12), "",
            "exact solution"});
  }
}

TEST(Laminate, OfAnisotropicAndThreeLayersIsExact) {
  double worst = 0;
  for (int axis : {0, 1})
    for (const Shape shape : {Shape::triangles, Shape::quadrilaterals}) {
      Mesh mesh = layered(shape, axis);
      split_matrix(mesh, axis);
      std::vector<Material> materials = two_materials(mesh, soft, anisotropic());
      materials.back() = stiff;
      const Eigen::Matrix3d exact =
          laminate({{0.25, soft.stiffness}, {0.5, anisotropic().stiffness}, {0.25, stiff.stiffness}}, axis);
      EXPECT_GT(std::abs(exact(0, 2)), 1e9);  // the coupling is of a size that shows
      const double error = relative_difference(solve(mesh, materials).stiffness, exact);
      EXPECT_LE(error, rounding) << "axis " << axis;
      worst = worse(worst, error);
    }
  report({"Laminate, three layers, one anisotropic", "largest relative error, P1 and Q1, normals x and y",
          "<= 1e-10", shown_error(worst, 1e-12), "", "exact solution"});
}

/// A homogeneous body has its own stiffness under any of the three conditions, on any mesh.
TEST(HomogeneousCell, HasItsOwnStiffness) {
  double worst = 0;
  for (const CellBoundary boundary : {CellBoundary::periodic, CellBoundary::kubc, CellBoundary::subc})
    for (const Shape shape : {Shape::triangles, Shape::quadrilaterals, Shape::mixed}) {
      Block block;
      block.nx = 6;
      block.ny = 5;
      block.height = 0.7;
      block.shape = shape;
      block.distortion = 0.2;
      block.periodic_x = block.periodic_y = boundary == CellBoundary::periodic;
      const CellSolution solution = solve(block_mesh(block), {anisotropic()}, boundary);
      double error = worse(relative_difference(solution.stiffness, anisotropic().stiffness),
                           relative_difference(solution.energy_stiffness, anisotropic().stiffness));
      for (const Eigen::Matrix3d& a : solution.localisation)
        error = worse(error, largest(a - Eigen::Matrix3d::Identity()));
      EXPECT_LE(error, rounding) << name(boundary);
      worst = worse(worst, error);
    }
  report({"Homogeneous cell, anisotropic, distorted mesh",
          "largest relative error of C and of A - I, periodic, kubc and subc", "<= 1e-10",
          shown_error(worst, 1e-12), "", "exact solution"});
}

/// Waves much longer than the layers travel across them at c² = 1/(⟨ρ⟩⟨1/M⟩), M = λ + 2G or G (Backus,
/// J. Geophys. Res. 67 (1962) 4427). C_eff is given to slide as six numbers, as a user would.
TEST(Laminate, GivesSlideTheSpeedsOfLongWaves) {
  const Eigen::Matrix3d c = found_laminate(Shape::triangles, 1);
  const PetscChoice given(
      {{"-material_all_stiffness", format("{:.12g},{:.12g},{:.12g},{:.12g},{:.12g},{:.12g}", c(0, 0), c(1, 1),
                                          c(0, 1), c(2, 2), c(0, 2), c(1, 2))},
       {"-material_all_density", "3000"}});
  Options options("slide", material_schema());
  options.know_names("region", {"block", "all"});
  const Material material = read_materials(options, {"block"}).front();
  const auto mean_compliance = [](int k) { return 0.5 / soft.stiffness(k, k) + 0.5 / stiff.stiffness(k, k); };
  const double fast = std::sqrt(1 / (3000 * mean_compliance(1))),
               slow = std::sqrt(1 / (3000 * mean_compliance(2)));
  const WaveSpeeds across = wave_speeds(material, 0, 1);
  EXPECT_NEAR(across.fast / fast, 1, rounding);
  EXPECT_NEAR(across.slow / slow, 1, rounding);
  report({"Laminate 30/80 GPa, 2000/4000 kg/m3, as slide's material", "wave speeds across the layers, m/s",
          format("{:.4f}; {:.4f}", fast, slow), format("{:.4f}; {:.4f}", across.fast, across.slow), "",
          "Backus 1962"});
}
