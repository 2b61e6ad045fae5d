#include "slipscale/relocalize/comparison.hpp"

#include <gtest/gtest.h>
#include <petscsys.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include "slipscale/base/error.hpp"
#include "slipscale/base/parallel.hpp"

using namespace slipscale;

namespace {

using Stress = std::vector<std::array<double, 3>>;
constexpr auto reference = StressSource::reference, relocalised = StressSource::relocalised,
               homogeneous = StressSource::homogeneous;

/// A block of 20 x 10 mm of `n` x `n` cells with its lower left corner at (1, 2) mm; its right half is
/// region 1.
struct Grid {
  explicit Grid(int n) {
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        cells.area.push_back(20e-3 * 10e-3 / (n * n));
        cells.centroid.push_back({1e-3 + (i + 0.5) * 20e-3 / n, 2e-3 + (j + 0.5) * 10e-3 / n});
        cells.region.push_back(2 * i >= n ? 1 : 0);
      }
  }
  std::vector<BlockPart> parts() const { return block_parts(cells, {"matrix", "inclusion"}, zones); }

  ComparedCells cells;
  BlockZones zones{{{1e-3, 2e-3}, {21e-3, 12e-3}}, 2e-3, 1e-3, 2e-3};
};

Stress random_stress(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> normal(-15e6, 5e6);
  Stress stress(count);
  for (auto& cell : stress) cell = {normal(random), normal(random), normal(random)};
  return stress;
}

double area_of(const BlockPart& part, const ComparedCells& cells) {
  double area = 0;
  for (const std::size_t c : part.cells) area += cells.area[c];
  return area;
}

StressFields fields_of(const std::array<Stress, 3>& stress) { return {stress[0], stress[1], stress[2]}; }

/// Every n-th cell of a grid, this rank's on n ranks, and the stress there.
struct Share {
  Share(const Grid& grid, const std::array<Stress, 3>& whole) {
    const int rank = rank_of(PETSC_COMM_WORLD), ranks = ranks_of(PETSC_COMM_WORLD);
    for (std::size_t c = static_cast<std::size_t>(rank); c < grid.cells.area.size();
         c += static_cast<std::size_t>(ranks)) {
      cells.area.push_back(grid.cells.area[c]);
      cells.centroid.push_back(grid.cells.centroid[c]);
      cells.region.push_back(grid.cells.region[c]);
      for (std::size_t s = 0; s < 3; ++s) stress[s].push_back(whole[s][c]);
    }
    parts = block_parts(cells, {"matrix", "inclusion"}, grid.zones);
  }
  ComparedCells cells;
  std::array<Stress, 3> stress;
  std::vector<BlockPart> parts;
};

void sum_over_ranks(std::span<double> values) {
  MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_DOUBLE, MPI_SUM,
                PETSC_COMM_WORLD);
}

}  // namespace

TEST(BlockParts, AreasAreThoseOfTheDrawing) {
  const Grid grid(40);
  const auto parts = grid.parts();
  const std::vector<std::string> names{"all", "layer", "bulk", "matrix", "inclusion"};
  const std::vector<double> areas{20e-3 * 10e-3, 20e-3 * 1e-3, 16e-3 * 6e-3, 10e-3 * 10e-3, 10e-3 * 10e-3};
  ASSERT_EQ(parts.size(), names.size());
  for (std::size_t p = 0; p < parts.size(); ++p) {
    EXPECT_EQ(parts[p].name, names[p]);
    EXPECT_EQ(parts[p].phase, p >= 3);
    EXPECT_NEAR(area_of(parts[p], grid.cells), areas[p], 1e-12 * areas[0]) << names[p];
  }
}

TEST(BlockParts, PhasesPartitionTheBlockAndTheLayerLeavesTheBulkAlone) {
  const auto parts = Grid(40).parts();
  std::vector<std::size_t> both = parts[3].cells;
  both.insert(both.end(), parts[4].cells.begin(), parts[4].cells.end());
  std::sort(both.begin(), both.end());
  EXPECT_EQ(both, parts[0].cells);
  for (const std::size_t c : parts[1].cells)
    EXPECT_EQ(std::count(parts[2].cells.begin(), parts[2].cells.end(), c), 0);
}

TEST(BlockParts, RefusesALayerWithoutDepthAndABlockWithoutBulk) {
  Grid grid(4);
  grid.zones.bulk = 5e-3;  // half of the height
  EXPECT_THROW(grid.parts(), UserError);
  grid.zones.bulk = -1e-3;
  EXPECT_THROW(grid.parts(), UserError);
  grid.zones.bulk = 0;
  grid.zones.layer = 0;
  EXPECT_THROW(grid.parts(), UserError);
}

TEST(StressSums, ErrorsOfKnownFields) {
  // σ_ref = (1, 2, 0) s with s = 1 in the left and 3 in the right half; relocalised 10 % too large, and
  // homogeneous s = 2: error 1 on a reference whose square is 5 on average, 1/9 of it in the right half.
  const Grid grid(20);
  std::array<Stress, 3> stress;
  for (const int region : grid.cells.region) {
    const double s = region ? 3e6 : 1e6;
    stress[reference].push_back({s, 2 * s, 0});
    stress[relocalised].push_back({1.1 * s, 2.2 * s, 0});
    stress[homogeneous].push_back({2e6, 4e6, 0});
  }
  const auto sums = stress_sums(grid.parts(), grid.cells, fields_of(stress));
  for (std::size_t p = 0; p < sums.size(); ++p)
    for (std::size_t i = 0; i < 2; ++i)
      EXPECT_NEAR(sums[p].relative_error(relocalised, i), 0.1, 1e-13) << p << " " << i;
  EXPECT_NEAR(sums[0].relative_error(homogeneous, 1), std::sqrt(1.0 / 5), 1e-13);
  EXPECT_NEAR(sums[3].relative_error(homogeneous, 1), 1, 1e-13);
  EXPECT_NEAR(sums[4].relative_error(homogeneous, 1), 1.0 / 3, 1e-13);
  EXPECT_EQ(sums[0].relative_error(reference, 1), 0);
  EXPECT_TRUE(std::isnan(sums[0].relative_error(relocalised, 2)));  // no σ_xy to be measured against
  EXPECT_NEAR(sums[0].mean(reference, 0), 2e6, 1e-6);
  EXPECT_NEAR(sums[4].mean(relocalised, 1), 6.6e6, 1e-6);
  EXPECT_NEAR(sums[0].mean(homogeneous, 1), 4e6, 1e-6);
}

TEST(StressSums, ErrorOfASmoothFieldIsItsIntegral) {
  // σ_ref = cos kx over whole periods, off by ε cos ky: the ratio of two integrals, both exact at midpoints.
  const Grid grid(32);
  std::array<Stress, 3> stress;
  const double kx = 2 * std::numbers::pi / 20e-3, ky = 2 * std::numbers::pi / 10e-3;
  for (const auto& [x, y] : grid.cells.centroid) {
    stress[reference].push_back({0, std::cos(kx * x), 0});
    stress[relocalised].push_back({0, std::cos(kx * x) + 0.05 * std::cos(ky * y), 0});
    stress[homogeneous].push_back({0, 0, 0});
  }
  const auto sums = stress_sums(grid.parts(), grid.cells, fields_of(stress));
  EXPECT_NEAR(sums[0].relative_error(relocalised, 1), 0.05, 1e-14);
  EXPECT_NEAR(sums[0].relative_error(homogeneous, 1), 1, 1e-14);
}

TEST(StressSums, ErrorsDoNotDependOnUnitsOrOnTheSizeOfCells) {
  Grid grid(10);
  std::array<Stress, 3> stress{random_stress(100, 1), random_stress(100, 2), random_stress(100, 3)};
  const auto before = stress_sums(grid.parts(), grid.cells, fields_of(stress));
  for (auto& field : stress)
    for (auto& cell : field)
      for (double& component : cell) component *= 0x1p-20;
  for (double& area : grid.cells.area) area *= 0x1p10;
  const auto after = stress_sums(grid.parts(), grid.cells, fields_of(stress));
  for (std::size_t p = 0; p < before.size(); ++p)
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_EQ(before[p].relative_error(relocalised, i), after[p].relative_error(relocalised, i));
      EXPECT_EQ(before[p].mean(homogeneous, i) * 0x1p-20, after[p].mean(homogeneous, i));
    }
}

TEST(StressSums, MergedSharesAreTheWhole) {
  const Grid grid(12);
  const std::array<Stress, 3> stress{random_stress(144, 1), random_stress(144, 2), random_stress(144, 3)};
  const auto whole = stress_sums(grid.parts(), grid.cells, fields_of(stress));
  const Share share(grid, stress);
  auto merged = stress_sums(share.parts, share.cells, fields_of(share.stress));
  sum_over_ranks(numbers(merged));
  for (std::size_t p = 0; p < whole.size(); ++p)
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(merged[p].relative_error(relocalised, i) / whole[p].relative_error(relocalised, i), 1,
                  1e-13);
      EXPECT_NEAR(merged[p].mean(homogeneous, i) / whole[p].mean(homogeneous, i), 1, 1e-13);
    }
}

TEST(StressSums, ErrorOverFramesWeighsThemByTheirStress) {
  // Errors of 10 % at stress 3 and of 100 % at stress 1: √((0.3² + 1²) / (3² + 1²)).
  const Grid grid(4);
  std::vector<StressSums> total(5);
  for (const auto& [size, found] : {std::pair{3e6, 3.3e6}, std::pair{1e6, 2e6}}) {
    const std::array<Stress, 3> stress{Stress(16, {0, size, 0}), Stress(16, {0, found, 0}), Stress(16)};
    const auto frame = stress_sums(grid.parts(), grid.cells, fields_of(stress));
    for (std::size_t p = 0; p < total.size(); ++p) total[p] += frame[p];
  }
  EXPECT_NEAR(total[0].relative_error(relocalised, 1), std::sqrt(1.09 / 10), 1e-13);
  EXPECT_NEAR(total[0].mean(reference, 1), 2e6, 1e-6);
}

TEST(StressSums, PartWithoutCellsHasNoError) {
  const Grid grid(2);  // centroids 2.5 mm above the contact, the layer is 1 mm deep
  const std::array<Stress, 3> stress{random_stress(4, 1), random_stress(4, 2), random_stress(4, 3)};
  const auto parts = grid.parts();
  ASSERT_TRUE(parts[1].cells.empty());
  EXPECT_TRUE(
      std::isnan(stress_sums(parts, grid.cells, fields_of(stress))[1].relative_error(relocalised, 1)));
  EXPECT_TRUE(std::isnan(stress_quantiles(parts, grid.cells, fields_of(stress), {0.5})[1][0][1][0]));
}

TEST(StressQuantiles, AreThoseOfTheSortedValuesWhereCellsAreEqual) {
  const Grid grid(10);
  const std::array<Stress, 3> stress{random_stress(100, 1), random_stress(100, 2), random_stress(100, 3)};
  const auto found = stress_quantiles(grid.parts(), grid.cells, fields_of(stress), {0, 0.01, 0.5, 0.99, 1});
  for (std::size_t s = 0; s < 3; ++s)
    for (std::size_t i = 0; i < 3; ++i) {
      std::vector<double> sorted;
      for (const auto& cell : stress[s]) sorted.push_back(cell[i]);
      std::sort(sorted.begin(), sorted.end());
      EXPECT_EQ(found[0][s][i], (std::vector{sorted[0], sorted[0], sorted[49], sorted[98], sorted[99]}));
    }
}

TEST(StressQuantiles, WeighByAreaAndOrderSignsTiesAndExtremes) {
  Grid grid(2);
  grid.cells.area = {1, 2, 3, 4};
  const double huge = std::numeric_limits<double>::max();
  // In order: −huge (area 3), −1 (1), −1 (4), 5e-324 (2): shares .3, .8 and 1.
  const Stress stress{{0, -1, 0}, {0, 5e-324, 0}, {0, -huge, 0}, {0, -1, 0}};
  const auto found =
      stress_quantiles(grid.parts(), grid.cells, {stress, stress, stress}, {0.1, 0.3, 0.31, 0.8, 0.81, 1});
  EXPECT_EQ(found[0][relocalised][1], (std::vector{-huge, -huge, -1.0, -1.0, 5e-324, 5e-324}));
  EXPECT_EQ(found[0][relocalised][0], std::vector<double>(6, 0.0));
}

TEST(StressQuantiles, AreTheSameWhenTheCellsAreShared) {
  const Grid grid(12);
  const std::array<Stress, 3> stress{random_stress(144, 1), random_stress(144, 2), random_stress(144, 3)};
  const std::vector<double> levels{0.01, 0.5, 0.99};
  const auto whole = stress_quantiles(grid.parts(), grid.cells, fields_of(stress), levels);

  const Share share(grid, stress);
  EXPECT_EQ(stress_quantiles(share.parts, share.cells, fields_of(share.stress), levels, sum_over_ranks),
            whole);
}

TEST(HistoryAgreement, ShiftedSines) {
  // Over whole periods the correlation of sin t and a sin(t − φ) + c is cos φ, the slope a cos φ.
  constexpr int n = 400;
  for (const double shift : {0.0, 0.3, std::numbers::pi / 2, std::numbers::pi}) {
    std::vector<double> expected, history;
    for (int k = 0; k < n; ++k) {
      const double t = 2 * std::numbers::pi * 5 * k / n;
      expected.push_back(std::sin(t));
      history.push_back(1.7 * std::sin(t - shift) + 4);
    }
    const HistoryAgreement found = agreement(expected, history);
    EXPECT_NEAR(found.correlation, std::cos(shift), 1e-13);
    EXPECT_NEAR(found.slope, 1.7 * std::cos(shift), 1e-13);
    // ⟨(1.7 sin(t−φ) + 4 − sin t)²⟩ / ⟨sin² t⟩
    EXPECT_NEAR(found.relative_error, std::sqrt(1.7 * 1.7 + 1 - 2 * 1.7 * std::cos(shift) + 2 * 16), 1e-12);
  }
}

TEST(HistoryAgreement, OfConstantsIsNotANumber) {
  const std::vector<double> wave{1, 2, 1, 2}, constant(4, -15.1e6), zero(4, 0.0);
  EXPECT_TRUE(std::isnan(agreement(wave, constant).correlation));
  EXPECT_NEAR(agreement(wave, constant).slope, 0, 1e-6);
  EXPECT_TRUE(std::isnan(agreement(constant, wave).correlation));
  EXPECT_TRUE(std::isnan(agreement(constant, wave).slope));
  EXPECT_TRUE(std::isnan(agreement(zero, wave).relative_error));
  EXPECT_NEAR(agreement(constant, constant).relative_error, 0, 0);
  EXPECT_TRUE(std::isnan(agreement({}, {}).slope));
}

TEST(CommonFrames, AreEachOthersNearest) {
  const std::vector<double> het{0, 1.0, 2.0, 3.0, 4.0}, hom{0.9, 1.2, 2.0, 3.4, 5.0};
  using Pairs = std::vector<std::array<std::size_t, 2>>;
  EXPECT_EQ(common_frames(het, hom, 0.15), (Pairs{{1, 0}, {2, 2}}));
  EXPECT_EQ(common_frames(het, hom, 0.5), (Pairs{{1, 0}, {2, 2}, {3, 3}}));
  EXPECT_EQ(common_frames(het, het, 0), (Pairs{{0, 0}, {1, 1}, {2, 2}, {3, 3}, {4, 4}}));
  EXPECT_TRUE(common_frames(het, {}, 1).empty());
  EXPECT_TRUE(common_frames({}, hom, 1).empty());
}
