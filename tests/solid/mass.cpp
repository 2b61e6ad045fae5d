#include "slipscale/solid/mass.hpp"
#include "slipscale/solid/eigenvalue_bound.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "bodies.hpp"
#include "slipscale/dynamics/model.hpp"
#include "slipscale/solid/element.hpp"

using namespace slipscale;
using namespace slipscale::testing_support;

TEST(Mass, SumsToDensityTimesArea) {
  for (const Body& body : all_bodies()) {
    SCOPED_TRACE(testing::Message() << body);
    const Mesh mesh = block_mesh(block_of(body));
    const auto mass = lumped_mass(mesh, two_materials());
    double sum = std::accumulate(mass.begin(), mass.end(), 0.0);
    MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPI_DOUBLE, MPI_SUM, PETSC_COMM_WORLD);
    const double expected = 1800 * mesh.regions[0].area + 2700 * mesh.regions[1].area;
    EXPECT_NEAR(sum, expected, 1e-13 * expected);
    for (double m : mass) EXPECT_GT(m, 0);
  }
}

/// Trapezoid with parallel sides 2 (below) and 1 (above), height 1: the Jacobian is J = (3 − η)/8, and
/// ∫∫ ¼(1 ± ξ)(1 ∓ η) J dξ dη is 5/12 for the two lower corners and 1/3 for the upper ones.
TEST(Mass, TrapezoidHasItsRowSums) {
  const std::vector<Vector2> trapezoid{{0, 0}, {2, 0}, {1, 1}, {0, 1}};
  const auto areas = corner_areas(trapezoid);
  const double below = 5.0 / 12, above = 1.0 / 3;
  EXPECT_NEAR(areas[0], below, 1e-15);
  EXPECT_NEAR(areas[1], below, 1e-15);
  EXPECT_NEAR(areas[2], above, 1e-15);
  EXPECT_NEAR(areas[3], above, 1e-15);
}

TEST(Mass, TriangleSharesItsAreaEqually) {
  const std::vector<Vector2> triangle{{0, 0}, {3, 1}, {1, 2}};
  const auto areas = corner_areas(triangle);
  for (int k = 0; k < 3; ++k) EXPECT_NEAR(areas[k], 2.5 / 3, 1e-15);
  EXPECT_EQ(areas[3], 0);
}

/// Irons and Treharne: the largest element eigenvalue bounds the body's largest frequency. For one
/// homogeneous mesh the bound is not far away either.
TEST(Mass, ElementEigenvalueBoundsTheFrequency) {
  for (const Body& body : all_bodies()) {
    SCOPED_TRACE(testing::Message() << body);
    const Mesh mesh = block_mesh(block_of(body));
    const Model model(mesh, two_materials(), Model::Storage::full);
    const FrequencyBounds bounds = largest_frequency(PETSC_COMM_WORLD, model);
    EXPECT_NEAR(bounds.safe * bounds.safe, critical_cell(PETSC_COMM_WORLD, mesh, two_materials()).eigenvalue,
                1e-12 * bounds.safe * bounds.safe);
    EXPECT_LE(bounds.sharp, bounds.safe * 1.001);  // the sharp one is rounded up to four digits
    EXPECT_GT(bounds.sharp, 0);
  }
}

/// A body of one cell attains the bound.
TEST(Mass, OneCellAttainsTheBound) {
  Block block;
  block.nx = block.ny = 1;
  block.shape = Shape::quadrilaterals;
  block.height = 0.7;
  const std::string path = scratch("cell.msh");
  write_block(block, path);
  const Mesh mesh = read_mesh(PETSC_COMM_SELF, {path});
  const Model model(mesh, {anisotropic()}, Model::Storage::full);
  const FrequencyBounds bounds = largest_frequency(PETSC_COMM_SELF, model);
  EXPECT_NEAR(bounds.sharp / bounds.safe, 1, 1e-3);
}

/// Of equal squares the stiffer ones set the step, the first of them, and what its step is to that of the
/// median cell follows from the stiffness: √¼; in its region none is worse.
TEST(CriticalCell, IsTheFirstOfTheStiffestCells) {
  Block block;
  block.nx = 20;
  block.ny = 12;
  block.shape = Shape::quadrilaterals;
  block.region = [](double x, double y) { return std::hypot(x - 0.7, y - 0.4) < 0.2 ? 2 : 1; };
  const Material soft = isotropic(1e9, 0.3, 1000), stiff = isotropic(4e9, 0.3, 1000);
  const std::string path = scratch("critical.msh");
  write_block(block, path);
  const Mesh whole = read_mesh(PETSC_COMM_SELF, {path}), mesh = read_mesh(PETSC_COMM_WORLD, {path});
  const CriticalCell alone = critical_cell(PETSC_COMM_SELF, whole, {soft, stiff}),
                     found = critical_cell(PETSC_COMM_WORLD, mesh, {soft, stiff});
  EXPECT_EQ(found.eigenvalue, alone.eigenvalue);
  EXPECT_EQ(found.number, alone.number);
  EXPECT_EQ(found.centre, alone.centre);
  EXPECT_EQ(mesh.regions[found.region].name, "inclusion");
  EXPECT_LT(std::hypot(found.centre[0] - 0.7, found.centre[1] - 0.4), 0.2);
  EXPECT_NEAR(found.smallest_angle, 90, 1e-9);
  EXPECT_NEAR(found.largest_angle, 90, 1e-9);
  EXPECT_NEAR(found.of_median, 0.5, 0.005);
  EXPECT_NEAR(found.of_median_in_region, 1, 0.01);
  EXPECT_EQ(found.of_median, alone.of_median);
  const int cell = static_cast<int>(found.number);
  const auto shape = whole.shape_of(cell);
  const std::size_t corners = whole.cells.nodes_of(cell).size();
  EXPECT_EQ(largest_element_eigenvalue({shape.data(), corners}, stiff.stiffness, stiff.density),
            found.eigenvalue);
}
