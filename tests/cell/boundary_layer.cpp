#include "slipscale/cell/boundary_layer.hpp"

#include <gtest/gtest.h>
#include <petscsys.h>

#include <cmath>
#include <numeric>

#include "slipscale/base/error.hpp"
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
    int rank = 0, ranks = 1;
    MPI_Comm_rank(PETSC_COMM_WORLD, &rank);
    MPI_Comm_size(PETSC_COMM_WORLD, &ranks);
    static_cast<RankShare&>(*this) = rank_share(static_cast<std::size_t>(grid.cells()), rank, ranks);
  }
};

/// Strain and stress of a displacement of the points, on this rank's cells.
struct State {
  std::vector<PlaneTensor> strain, stress;
};

State state(const PlaneGrid& grid, const RankShare& mine, const std::vector<Vector2>& u) {
  State found;
  for (std::size_t cell = mine.begin; cell < mine.end; ++cell) {
    const int c = static_cast<int>(cell);
    const StrainDisplacement b = centre_strain_displacement(grid.corners_of(c));
    Eigen::Vector3d e = Eigen::Vector3d::Zero();
    for (int k = 0; k < 3; ++k) {
      const Vector2& corner = u[grid.corners[grid.first[c] + k]];
      e += b.middleCols(2 * k, 2) * Eigen::Vector2d(corner[0], corner[1]);
    }
    const Eigen::Vector3d s = stiffness[grid.region[c]] * e;
    found.strain.push_back({e[0], e[1], e[2]});
    found.stress.push_back({s[0], s[1], s[2]});
  }
  return found;
}

/// A smooth displacement, and the same with the points below the inner edge moved about.
std::vector<Vector2> displacement(const PlaneGrid& grid, double disturbance) {
  std::vector<Vector2> u;
  for (const Vector2& x : grid.points) {
    const double a = x[0] / side, b = x[1] / side;
    const double moved = b < 5.5 ? disturbance : 0;
    u.push_back({1e-9 * (a * 0.3 - b * 0.7) + moved * std::sin(3 * a + 5 * b),
                 1e-9 * (-b + 0.1 * a * b) + moved * std::cos(2 * a - b)});
  }
  return u;
}

const PlaneTensor load{2e5, -1.5e6, 4e5};  // uniform, so it balances its tractions

State corrected(const PlaneGrid& grid, double disturbance) {
  const Share mine(grid);
  State found = state(grid, mine, displacement(grid, disturbance));
  BoundaryLayer layer(PETSC_COMM_WORLD, grid, stiffness, mine, depth);
  layer.correct(std::vector<PlaneTensor>(mine.count(), load), found.strain, found.stress);
  return found;
}

double largest(const std::vector<PlaneTensor>& rows) {
  double most = 0;
  for (const PlaneTensor& row : rows)
    for (const double value : row) most = std::max(most, std::abs(value));
  return most;
}

}  // namespace

// What the start has wrong below the inner edge does not matter: the corrector takes it out.
TEST(BoundaryLayer, ForgetsTheStartBelowTheInnerEdge) {
  const PlaneGrid grid = lattice();
  const State calm = corrected(grid, 0), moved = corrected(grid, 2e-10);
  for (std::size_t k = 0; k < calm.stress.size(); ++k)
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(moved.stress[k][i], calm.stress[k][i], 1e-10 * largest(calm.stress));
      EXPECT_NEAR(moved.strain[k][i], calm.strain[k][i], 1e-10 * largest(calm.strain));
    }
}

// Below the inner edge the corrected stress carries the load's tractions: no nodal force is left.
TEST(BoundaryLayer, BalancesTheLoad) {
  const PlaneGrid grid = lattice();
  const Share mine(grid);
  const auto residual = [&](const State& now) {
    std::vector<double> force(2 * grid.points.size(), 0);
    for (std::size_t cell = mine.begin; cell < mine.end; ++cell) {
      const int c = static_cast<int>(cell);
      const StrainDisplacement b = centre_strain_displacement(grid.corners_of(c));
      const PlaneTensor& s = now.stress[cell - mine.begin];
      const Eigen::Matrix<double, 6, 1> f =
          area(grid, c) * b.transpose() * Eigen::Vector3d(s[0] - load[0], s[1] - load[1], s[2] - load[2]);
      for (int k = 0; k < 3; ++k)
        for (int i = 0; i < 2; ++i)
          force[2 * static_cast<std::size_t>(grid.corners[grid.first[c] + k]) + i] += f[2 * k + i];
    }
    MPI_Allreduce(MPI_IN_PLACE, force.data(), static_cast<int>(force.size()), MPI_DOUBLE, MPI_SUM,
                  PETSC_COMM_WORLD);
    double most = 0;
    for (std::size_t p = 0; p < grid.points.size(); ++p)
      if (grid.points[p][1] < 5.5 * side)
        most = std::max({most, std::abs(force[2 * p]), std::abs(force[2 * p + 1])});
    return most;
  };
  const double before = residual(state(grid, mine, displacement(grid, 0)));
  EXPECT_GT(before, 0.1 * side * std::abs(load[1]));
  EXPECT_LT(residual(corrected(grid, 0)), 1e-9 * before);
}

// Above the strip nothing changes, and the stress stays C : strain.
TEST(BoundaryLayer, LeavesTheRestAlone) {
  const PlaneGrid grid = lattice();
  const Share mine(grid);
  const State before = state(grid, mine, displacement(grid, 0)), after = corrected(grid, 0);
  for (std::size_t k = 0; k < mine.count(); ++k) {
    const int cell = static_cast<int>(mine.begin + k);
    if (centre(grid, cell)[1] > depth) {
      EXPECT_EQ(after.stress[k], before.stress[k]);
      EXPECT_EQ(after.strain[k], before.strain[k]);
    }
    const PlaneTensor& e = after.strain[k];
    const Eigen::Vector3d s = stiffness[grid.region[cell]] * Eigen::Vector3d(e[0], e[1], e[2]);
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(after.stress[k][i], s[i], 1e-10 * largest(after.stress));
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
