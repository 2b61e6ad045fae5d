#include "slipscale/relocalize/boundary_layer.hpp"

#include <gtest/gtest.h>
#include <petscsys.h>

#include <cmath>
#include <numeric>

#include "slipscale/base/error.hpp"
#include "slipscale/base/parallel.hpp"
#include "slipscale/solid/element.hpp"
#include "slipscale/solid/material.hpp"

using namespace slipscale;

namespace {

constexpr int across = 12, up = 10;
constexpr double side = 1e-4, depth = 6.5 * side;  // the inner edge at six rows

/// Triangles on a lattice that is sheared a little, the cells of a chequerboard stiffer.
PlaneGrid lattice() {
  PlaneGrid grid;
  grid.regions = {"matrix", "inclusion"};
  for (int j = 0; j <= up; ++j)
    for (int i = 0; i <= across; ++i) grid.points.push_back({side * (i + 0.1 * std::sin(1.7 * j)), side * j});
  const auto point = [](int i, int j) { return j * (across + 1) + i; };
  for (int j = 0; j < up; ++j)
    for (int i = 0; i < across; ++i)
      for (const auto& corners : {std::array{point(i, j), point(i + 1, j), point(i + 1, j + 1)},
                                  std::array{point(i, j), point(i + 1, j + 1), point(i, j + 1)}}) {
        grid.corners.insert(grid.corners.end(), corners.begin(), corners.end());
        grid.first.push_back(static_cast<int>(grid.corners.size()));
        grid.region.push_back((i / 3 + j / 3) % 2);
      }
  return grid;
}

const std::vector<Eigen::Matrix3d> stiffness{isotropic_stiffness(30e9, 0.3), isotropic_stiffness(80e9, 0.2)};

struct Share : RankShare {
  explicit Share(const PlaneGrid& grid) {
    const int rank = rank_of(PETSC_COMM_WORLD), ranks = ranks_of(PETSC_COMM_WORLD);
    static_cast<RankShare&>(*this) = rank_share(static_cast<std::size_t>(grid.cells()), rank, ranks);
  }
};

/// Fields of this rank's cells.
struct State {
  std::vector<PlaneTensor> strain, stress;
};

/// The same in all cells: what is there before the correction does not matter where it is replaced.
State uniform(const RankShare& mine, const PlaneTensor& strain, const PlaneTensor& stress) {
  return {std::vector<PlaneTensor>(mine.count(), strain), std::vector<PlaneTensor>(mine.count(), stress)};
}

PlaneTensor tensor(const Eigen::Vector3d& x) { return {x[0], x[1], x[2]}; }
Eigen::Vector3d vector(const PlaneTensor& x) { return {x[0], x[1], x[2]}; }

const PlaneTensor wrong_strain{1, 2, 3}, wrong_stress{4e9, 5e9, 6e9};

State corrected(const PlaneGrid& grid, const std::vector<Eigen::Matrix3d>& c, const State& run) {
  const Share mine(grid);
  State local = uniform(mine, wrong_strain, wrong_stress);
  BoundaryLayer layer(PETSC_COMM_WORLD, grid, c, mine, depth);
  layer.correct(run.strain, run.stress, local.strain, local.stress);
  return local;
}

double largest(const std::vector<PlaneTensor>& rows) {
  double most = 0;
  for (const PlaneTensor& row : rows)
    for (const double value : row) most = std::max(most, std::abs(value));
  return most;
}

constexpr double kept = 0.5 * depth;  // replaced below this height

/// ∫ ε(φ):σ at the points, N/m, from the stress of all ranks.
std::vector<Vector2> nodal_forces(const PlaneGrid& grid, const RankShare& mine,
                                  const std::vector<PlaneTensor>& stress) {
  std::vector<Vector2> force(grid.points.size(), Vector2{});
  for (std::size_t cell = mine.begin; cell < mine.end; ++cell) {
    const int c = static_cast<int>(cell);
    const Eigen::Matrix<double, 6, 1> f = area(grid, c) *
                                          centre_strain_displacement(grid.corners_of(c)).transpose() *
                                          vector(stress[cell - mine.begin]);
    for (int k = 0; k < 3; ++k)
      for (int i = 0; i < 2; ++i) force[grid.corners[grid.first[c] + k]][i] += f[2 * k + i];
  }
  MPI_Allreduce(MPI_IN_PLACE, force.data(), static_cast<int>(2 * force.size()), MPI_DOUBLE, MPI_SUM,
                PETSC_COMM_WORLD);
  return force;
}

const PlaneTensor pressing{1e-6, -4e-5, 1e-5}, load{2e5, -1.5e6, 4e5};

}  // namespace

// Nothing to correct: C is C_eff everywhere.
TEST(BoundaryLayer, LeavesAUniformMaterialAsItIs) {
  const PlaneGrid grid = lattice();
  const Share mine(grid);
  const std::vector<Eigen::Matrix3d> same(2, stiffness[0]);
  const PlaneTensor stress = tensor(stiffness[0] * vector(pressing));
  const State found = corrected(grid, same, uniform(mine, pressing, stress));
  for (std::size_t k = 0; k < mine.count(); ++k) {
    const bool replaced = centre(grid, static_cast<int>(mine.begin + k))[1] < kept;
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(found.strain[k][i], replaced ? pressing[i] : wrong_strain[i], 1e-12 * 4e-5);
      EXPECT_NEAR(found.stress[k][i], replaced ? stress[i] : wrong_stress[i], 1e-12 * 2e6);
    }
  }
}

// Columns of two materials with ν = 0, pressed by e on a rigid surface: σ_yy = E e in each, so that the
// stiffer ones bear more of the pressure, and nothing else. The run knows the mean only.
TEST(BoundaryLayer, ColumnsOnARigidSurface) {
  PlaneGrid grid = lattice();
  for (Vector2& x : grid.points) x[0] = side * std::round(x[0] / side);
  for (int cell = 0; cell < grid.cells(); ++cell)
    grid.region[cell] = static_cast<int>(centre(grid, cell)[0] / (3 * side)) % 2;
  const std::vector<Eigen::Matrix3d> columns{isotropic_stiffness(30e9, 0), isotropic_stiffness(80e9, 0)};
  const Share mine(grid);
  const double e = -3e-5;
  const State found = corrected(grid, columns, uniform(mine, {0, e, 0}, {0, 55e9 * e, 0}));
  for (std::size_t k = 0; k < mine.count(); ++k) {
    const int cell = static_cast<int>(mine.begin + k);
    if (centre(grid, cell)[1] > 2.1 * side) continue;  // as far as the inner edge does not reach
    const double modulus = grid.region[cell] == 0 ? 30e9 : 80e9;
    EXPECT_NEAR(found.stress[k][1], modulus * e, 1e-9 * 80e9 * std::abs(e)) << cell;
    EXPECT_NEAR(found.stress[k][0], 0, 1e-9 * 80e9 * std::abs(e)) << cell;
  }
}

// Below the kept half no force is left at a node, but those of the surface: pressure where it is closed, and
// friction in proportion, as in the run. The stress stays C : strain.
TEST(BoundaryLayer, BalancesTheRunAndRubsAsItDoes) {
  const PlaneGrid grid = lattice();
  const Share mine(grid);
  const State run = uniform(mine, pressing, load);
  const State found = corrected(grid, stiffness, run);
  const auto force = nodal_forces(grid, mine, found.stress), expected = nodal_forces(grid, mine, run.stress);
  const double scale = side * std::abs(load[1]);
  for (std::size_t p = 0; p < grid.points.size(); ++p) {
    if (grid.points[p][1] > kept - 1.5 * side) continue;
    if (grid.points[p][1] > 0.5 * side) {
      EXPECT_NEAR(force[p][0], expected[p][0], 1e-8 * scale);
      EXPECT_NEAR(force[p][1], expected[p][1], 1e-8 * scale);
    } else {
      EXPECT_GE(force[p][1], -1e-8 * scale);
      EXPECT_NEAR(force[p][0], expected[p][0] / expected[p][1] * force[p][1], 1e-8 * scale);
    }
  }
  for (std::size_t k = 0; k < mine.count(); ++k) {
    const int cell = static_cast<int>(mine.begin + k);
    if (centre(grid, cell)[1] > kept) continue;
    const Eigen::Vector3d s = stiffness[grid.region[cell]] * vector(found.strain[k]);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(found.stress[k][i], s[i], 1e-10 * largest(run.stress));
  }
}

// Where the run's contact is open the surface bears nothing.
TEST(BoundaryLayer, OpenNodesAreFree) {
  const PlaneGrid grid = lattice();
  const Share mine(grid);
  State run = uniform(mine, pressing, load);
  for (std::size_t k = 0; k < mine.count(); ++k)
    if (centre(grid, static_cast<int>(mine.begin + k))[0] > 0.5 * across * side) run.stress[k] = {2e5, 0, 0};
  const auto force = nodal_forces(grid, mine, corrected(grid, stiffness, run).stress);
  double pressed = 0;
  for (std::size_t p = 0; p < grid.points.size(); ++p) {
    if (grid.points[p][1] > 0.5 * side) continue;
    if (grid.points[p][0] > (0.5 * across + 0.5) * side && grid.points[p][0] < (across - 0.5) * side) {
      EXPECT_NEAR(force[p][0], 0, 1e-8 * side * 1.5e6);
      EXPECT_NEAR(force[p][1], 0, 1e-8 * side * 1.5e6);
    }
    EXPECT_GE(force[p][1], -1e-8 * side * 1.5e6);
    pressed += force[p][1];
  }
  EXPECT_GT(pressed, 0);
}

// However many nodes open and close from frame to frame, the stiffness is factorised once, and each frame is
// corrected as if it were the only one.
TEST(BoundaryLayer, FactorisesOnce) {
  const PlaneGrid grid = lattice();
  const Share mine(grid);
  BoundaryLayer layer(PETSC_COMM_WORLD, grid, stiffness, mine, depth);
  for (const double open_from : {2.0, 0.5, 0.25, 0.75, 2.0}) {
    State run = uniform(mine, pressing, load);
    for (std::size_t k = 0; k < mine.count(); ++k)
      if (centre(grid, static_cast<int>(mine.begin + k))[0] > open_from * across * side)
        run.stress[k] = {2e5, 0, 0};
    State local = uniform(mine, wrong_strain, wrong_stress);
    layer.correct(run.strain, run.stress, local.strain, local.stress);
    EXPECT_EQ(layer.factorisations(), 1);
    const State alone = corrected(grid, stiffness, run);
    for (std::size_t k = 0; k < mine.count(); ++k)
      for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(local.stress[k][i], alone.stress[k][i], 1e-8 * std::abs(load[1])) << open_from;
  }
}

// Tiles that touch share no points of their own: joined, they carry load across.
TEST(BoundaryLayer, JoinsPointsOfTiles) {
  PlaneGrid tiles = lattice();
  const PlaneGrid one = lattice();
  std::vector<int> all(static_cast<std::size_t>(one.cells()));
  std::iota(all.begin(), all.end(), 0);
  append_cells(tiles, one, all, {across * side, 0});
  const std::vector<int> joint = joined_points(tiles);
  const int joints = 1 + *std::max_element(joint.begin(), joint.end());
  EXPECT_EQ(tiles.points.size(), 2u * (across + 1) * (up + 1));
  EXPECT_EQ(joints, (2 * across + 1) * (up + 1));
  for (std::size_t p = 0; p < joint.size(); ++p)
    for (std::size_t q = 0; q < p; ++q) {
      const double apart =
          std::hypot(tiles.points[p][0] - tiles.points[q][0], tiles.points[p][1] - tiles.points[q][1]);
      ASSERT_EQ(joint[p] == joint[q], apart < 1e-6 * side) << p << " and " << q;
    }
}

TEST(BoundaryLayer, RefusesAStripOfNothingOrAll) {
  const PlaneGrid grid = lattice();
  const Share mine(grid);
  for (const double wrong : {0.1 * side, 2 * up * side}) {
    try {
      const BoundaryLayer layer(PETSC_COMM_WORLD, grid, stiffness, mine, wrong);
      FAIL() << "a strip of " << wrong << " m was taken";
    } catch (const UserError& error) {
      EXPECT_NE(std::string(error.what()).find("-relocalize_strip"), std::string::npos) << error.what();
    }
  }
}
