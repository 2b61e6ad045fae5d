#include <gtest/gtest.h>

#include <cstdio>
#include <numbers>

#include "cells_composite.hpp"
#include "relocalisation.hpp"
#include "report.hpp"
#include "slipscale/relocalize/boundary_layer.hpp"
#include "slipscale/solid/interface_forces.hpp"

using namespace slipscale;
using namespace slipscale::testing_support;

namespace {

constexpr double radius = 0.35682482323055424;  // of a disc of area .4
const std::string topic = "Relocalised square array of discs, f .4, 30/80 GPa, tiled",
                  source = "complex potentials, disc_arrays.py";

/// The array tiled over a block of 2 by 2 m with its corner nowhere special.
struct TiledArray {
  LocalisationTensors tensors;
  PlaneGrid macro = macro_block(2, 2);
  Targets targets;
  double size;
  static constexpr Vector2 origin{0.371, -0.219},
      disc{origin[0] + 0.5, origin[1] + 1.5};  ///< of a whole disc

  explicit TiledArray(int elements) : size(1.0 / elements) {
    const Mesh mesh = drawn_mesh(disc_array(Arrangement::square, 0.4, elements, CellShape::triangle));
    tensors = homogenised(mesh, two_materials(mesh, soft, stiff));
    targets = tiles(tensors, macro, origin);
  }

  Tensors stress(const PlaneTensor& strain) const {
    return relocalised(tensors, macro, targets, uniform(macro, strain));
  }

  /// Stress at `x`, GPa: polynomial of degree 2 through the disc's cells whose centres lie within `reach`, by
  /// least squares, as in cells_local.cpp.
  Eigen::Vector3d at(const Vector2& x, double reach, const Tensors& stress) const {
    Eigen::Matrix<double, 6, 6> normal = Eigen::Matrix<double, 6, 6>::Zero();
    Eigen::Matrix<double, 6, 3> right = Eigen::Matrix<double, 6, 3>::Zero();
    for (int cell = 0; cell < targets.grid.cells(); ++cell) {
      if (targets.grid.regions[targets.grid.region[cell]] != "inclusion") continue;
      const Vector2 middle = centre(targets.grid, cell);
      const double dx = (middle[0] - x[0]) / reach, dy = (middle[1] - x[1]) / reach;
      if (std::hypot(dx, dy) > 1) continue;
      const Eigen::Vector<double, 6> basis{1, dx, dy, dx * dx, dx * dy, dy * dy};
      normal += basis * basis.transpose();
      right += basis * (1e-9 * vector(stress[static_cast<std::size_t>(cell)])).transpose();
    }
    return normal.ldlt().solve(right).row(0);
  }
};

double order(const std::array<double, 3>& errors) { return 0.5 * std::log2(errors[0] / errors[2]); }

}  // namespace

/// Against the exact fields (disc_arrays.py): E_xx = 1 and E_xy = 1 (γ = 2). Bounds and orders are those of
/// the localisation tensors themselves in cells_local.cpp: second order at the centre, .05 % at 64 elements
/// and a quarter of it at 128; first order at the interface, where the mean over a cell is off by h/r times
/// the gradient 2.8 GPa a radius.
TEST(Relocalisation, HasTheReferenceValuesInADisc) {
  std::array<double, 3> centre_errors{}, interface_errors{};
  Eigen::Vector3d middle, edge;
  double shear = 0;
  for (int k = 0; k < 3; ++k) {
    const TiledArray array(32 << k);
    const Tensors stretched = array.stress({1, 0, 0}), sheared = array.stress({0, 0, 2});
    middle = array.at(TiledArray::disc, 4 * array.size, stretched);
    shear = array.at(TiledArray::disc, 4 * array.size, sheared)[2];
    edge = array.at({TiledArray::disc[0] + radius, TiledArray::disc[1]}, 6 * array.size, stretched);
    centre_errors[k] =
        std::max((middle - Eigen::Vector3d(67.506716, 22.360986, 0)).cwiseAbs().maxCoeff() / 67.506716,
                 std::abs(shear / 31.595221 - 1));
    interface_errors[k] = std::abs(edge[0] - 70.27563);
    EXPECT_LE(interface_errors[k], 2.8 * array.size / radius);
  }
  EXPECT_LE(centre_errors[1], 5e-4);
  EXPECT_LE(centre_errors[2], 1.25e-4);
  EXPECT_GE(order(centre_errors), 1.75);  // meshes that are not nested
  EXPECT_GE(order(interface_errors), 1);
  const std::string shown = format("{:.2f}", order(centre_errors));
  report({topic, "centre, E_xx = 1: stress xx; yy, GPa, 128 P1 elements per cell",
          "67.5067; 22.3610 +- 0.0084", format("{:.4f}; {:.4f}", middle[0], middle[1]), shown, source});
  report({topic, "centre, E_xy = 1: stress xy, GPa", "31.5952 +- 0.0039", format("{:.4f}", shear), shown,
          source});
  report({topic, "interface at 0 degrees, E_xx = 1: stress xx, GPa", "70.2756 +- 0.06",
          format("{:.4f}", edge[0]), format("{:.2f}", order(interface_errors)), source});
}

/// Recovered from the nodal forces of the disc's own cells: σ_xx at θ = 0, between the two nodes beside it.
TEST(InterfaceForces, HaveTheReferenceValueAtADisc) {
  std::array<double, 3> errors{};
  double traction = 0;
  for (int k = 0; k < 3; ++k) {
    const TiledArray array(32 << k);
    const Tensors stress = array.stress({1, 0, 0});
    const PlaneGrid& grid = array.targets.grid;
    const auto& names = grid.regions;
    const int region = static_cast<int>(std::find(names.begin(), names.end(), "inclusion") - names.begin());
    const auto found = find_inclusions(grid, region, joined_points(grid));
    const StressForces forces(grid, found);
    std::vector<PlaneTensor> needed;
    for (const int cell : forces.cells()) needed.push_back(stress[cell]);
    const auto all = forces(needed);
    const Inclusions& inclusions = found.inclusions;
    const auto disc = std::ranges::min_element(inclusions.centre, {}, [](const Vector2& centre) {
      return std::hypot(centre[0] - TiledArray::disc[0], centre[1] - TiledArray::disc[1]);
    });
    const int wanted = static_cast<int>(disc - inclusions.centre.begin());
    double before = -10, after = 10, at_before = 0, at_after = 0;
    for (std::size_t row = 0; row < all.size(); ++row) {
      const InterfaceNode& node = inclusions.interface[row];
      if (node.inclusion != wanted) continue;
      const double angle = std::remainder(node.angle, 2 * std::numbers::pi),
                   t = 1e-9 * tractions(node, all[row])[0];
      if (angle <= 0 && angle > before) before = angle, at_before = t;
      if (angle >= 0 && angle < after) after = angle, at_after = t;
    }
    traction = after > before ? (at_before * after - at_after * before) / (after - before) : at_after;
    errors[k] = std::abs(traction - 70.27563);
    EXPECT_LE(errors[k], 0.08 / (1 << k)) << (32 << k);  // of order one; at one place it changes sign
  }
  report({topic, "traction along the normal at 0 degrees, E_xx = 1, from nodal forces, GPa",
          "70.2756 +- 0.02", format("{:.4f}", traction), "-", source});
}
