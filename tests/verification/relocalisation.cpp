#include "relocalisation.hpp"

#include <gtest/gtest.h>

#include "report.hpp"

using namespace slipscale;
using namespace slipscale::testing_support;

namespace {

Mesh layered(Shape shape, int axis) {
  Block block;
  block.nx = axis == 0 ? 8 : 5;
  block.ny = axis == 0 ? 5 : 8;
  block.shape = shape;
  block.periodic_x = block.periodic_y = true;
  block.region = [axis](double x, double y) { return (axis == 0 ? x : y) < 0.5 ? 1 : 2; };
  return block_mesh(block);
}

/// Stress in the layers of a laminate, half and half, with normal along `axis`: strain along the layers and
/// tractions across them are uniform (Milton, The Theory of Composites, section 9.2).
std::array<Eigen::Vector3d, 2> layer_stresses(const std::array<Eigen::Matrix3d, 2>& c, int axis,
                                              const Eigen::Vector3d& strain) {
  const int a = 1 - axis;
  const std::vector<int> along{a}, across{axis, 2};
  Eigen::Matrix2d compliance = Eigen::Matrix2d::Zero();
  Eigen::Vector2d own = Eigen::Vector2d::Zero();
  for (const Eigen::Matrix3d& layer : c) {
    const Eigen::Matrix2d inverse = layer(across, across).inverse();
    compliance += 0.5 * inverse;
    own += 0.5 * inverse * layer(across, along) * strain[a];
  }
  const Eigen::Vector2d traction = compliance.inverse() * (strain(across) + own);
  std::array<Eigen::Vector3d, 2> stress;
  for (std::size_t k = 0; k < 2; ++k) {
    Eigen::Vector3d local = strain;
    local(across) = c[k](across, across).inverse() * (traction - c[k](across, along) * strain[a]);
    stress[k] = c[k] * local;
  }
  return stress;
}

/// A distorted periodic cell with discs and a stiff band.
LocalisationTensors composite() {
  Block block;
  block.nx = 24;
  block.ny = 20;
  block.shape = Shape::mixed;
  block.distortion = 0.15;
  block.periodic_x = block.periodic_y = true;
  block.region = [](double x, double y) { return std::hypot(x - 0.3, y - 0.4) < 0.27 || x > 0.9 ? 2 : 1; };
  const Mesh mesh = block_mesh(block);
  return homogenised(mesh, two_materials(mesh, soft, stiff));
}

}  // namespace

/// A body of one material: the local stress is C:E, to the solver's rounding.
TEST(Relocalisation, OfAUniformCellIsTheMacroscopicStress) {
  const Mesh mesh = layered(Shape::mixed, 0);
  const LocalisationTensors tensors = homogenised(mesh, two_materials(mesh, stiff, stiff));
  const PlaneGrid macro = macro_block(2.3, 1.7);
  const Targets targets = tiles(tensors, macro, {0.31, -0.77});
  const PlaneTensor strain{1e-4, -3e-4, 2e-4};
  const Eigen::Vector3d expected = stiff.stiffness * vector(strain);
  for (const PlaneTensor& stress : relocalised(tensors, macro, targets, uniform(macro, strain)))
    EXPECT_LE((vector(stress) - expected).norm(), 1e-12 * expected.norm());
}

TEST(Relocalisation, OfALaminateIsExact) {
  double worst = 0;
  for (const int axis : {0, 1})
    for (const Shape shape : {Shape::triangles, Shape::quadrilaterals, Shape::mixed}) {
      const Mesh mesh = layered(shape, axis);
      const LocalisationTensors tensors = homogenised(mesh, two_materials(mesh, soft, stiff));
      const PlaneGrid macro = macro_block(2.3, 1.7);
      const Targets targets = tiles(tensors, macro, {0.31, -0.77});
      const PlaneTensor strain{1e-4, -3e-4, 2e-4};
      const auto expected = layer_stresses({soft.stiffness, stiff.stiffness}, axis, vector(strain));
      const Tensors stress = relocalised(tensors, macro, targets, uniform(macro, strain));
      const std::vector<Vector2> middles = centres(targets.grid);
      for (std::size_t k = 0; k < stress.size(); ++k) {
        const double place = middles[k][axis] - (axis == 0 ? 0.31 : -0.77);
        const std::size_t layer = place - std::floor(place) < 0.5 ? 0 : 1;
        const double error = (vector(stress[k]) - expected[layer]).norm() / expected[layer].norm();
        EXPECT_LE(error, 1e-12);
        worst = worse(worst, error);
      }
    }
  report({"Relocalised laminate 30/80 GPa, tiled, P1, Q1 and mixed", "largest relative error of the stress",
          "<= 1e-12", shown_error(worst, 1e-12), "", "exact solution"});
}

/// Over the cells of one whole copy, which the block holds for each origin.
TEST(Relocalisation, HasTheEffectiveStressAsMean) {
  const LocalisationTensors tensors = composite();
  const PlaneGrid macro = macro_block(2.3, 2.7);
  const PlaneTensor strain{1e-4, -3e-4, 2e-4};
  const Eigen::Vector3d expected = tensors.effective * vector(strain);
  double worst = 0;
  for (const Vector2& origin : {Vector2{0, 0}, Vector2{0.371, 0.219}, Vector2{-7.45, 0.8}}) {
    const Targets targets = tiles(tensors, macro, origin);
    const Tensors stress = relocalised(tensors, macro, targets, uniform(macro, strain));
    // The first copy that lies in the block as a whole.
    const Vector2 low{origin[0] - std::floor(origin[0]), origin[1] - std::floor(origin[1])};
    const std::vector<Vector2> middles = centres(targets.grid);
    Eigen::Vector3d mean = Eigen::Vector3d::Zero();
    int cells = 0;
    for (std::size_t k = 0; k < stress.size(); ++k) {
      const double x = middles[k][0] - low[0], y = middles[k][1] - low[1];
      if (x < 0 || x > 1 || y < 0 || y > 1) continue;
      mean += area(targets.grid, static_cast<int>(k)) * vector(stress[k]);
      ++cells;
    }
    EXPECT_EQ(cells, tensors.grid.cells());
    const double error = (mean - expected).norm() / expected.norm();
    EXPECT_LE(error, 1e-10);
    worst = worse(worst, error);
  }
  report({"Relocalised composite, tiled from any origin", "mean stress of a cell against C_eff:E, relative",
          "<= 1e-10", shown_error(worst, 1e-12), "", "Hill's lemma"});
}

/// The shares of the ranks together are what one rank computes alone, to the bit.
TEST(Relocalisation, HasTheSameBitsOnAnyRanks) {
  const LocalisationTensors tensors = composite();
  const PlaneGrid macro = macro_block(2.3, 2.7);
  const Targets targets = tiles(tensors, macro, {0.371, 0.219});
  Tensors strain;
  for (const Vector2& x : centres(macro)) strain.push_back({std::sin(3 * x[0]), x[1] * x[1], x[0] * x[1]});
  Relocalisation relocalize(tensors, macro, Recovery::nodal, targets.sites);
  Tensors alone(relocalize.places());
  relocalize.macroscopic(strain, alone);
  relocalize.stress(alone, alone);
  EXPECT_EQ(relocalised(tensors, macro, targets, strain), alone);
}
