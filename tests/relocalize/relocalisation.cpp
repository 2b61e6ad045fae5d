#include "slipscale/relocalize/relocalisation.hpp"

#include <gtest/gtest.h>

#include <random>

#include "grids.hpp"
#include "slipscale/solid/material.hpp"

using namespace slipscale;
using namespace slipscale::testing_support;

namespace {

using Tensors = std::vector<PlaneTensor>;
using Covariances = std::vector<PlaneCovariance>;

PlaneGrid macro_block() {
  Block block = distorted_blocks(6, 5, 0.2)[2];
  block.height = 0.8;
  return block_grid(block);
}

/// A cell of .23 by .17 with made-up tensors: of each cell its own, or the identity.
LocalisationTensors made_up(bool uniform) {
  Block block = distorted_blocks(5, 4, 0.1)[0];
  block.width = 0.23;
  block.height = 0.17;
  block.region = [](double x, double y) { return x > y ? 2 : 1; };
  LocalisationTensors tensors;
  tensors.grid = block_grid(block);
  tensors.stiffness = {isotropic_stiffness(30e9, 0.25), isotropic_stiffness(80e9, 0.3)};
  if (uniform) tensors.stiffness[1] = tensors.stiffness[0];
  std::mt19937 numbers(3);
  std::uniform_real_distribution<double> any(-0.5, 0.5);
  for (int cell = 0; cell < tensors.grid.cells(); ++cell) {
    Eigen::Matrix3d a = Eigen::Matrix3d::Identity();
    if (!uniform)
      for (double& entry : a.reshaped()) entry += any(numbers);
    tensors.localisation.push_back(a);
  }
  tensors.boundary = "periodic";
  return tensors;
}

Targets tiles(const LocalisationTensors& tensors, const PlaneGrid& macro) {
  return TwoScales(macro, tensors.grid, tiling(tensors.grid, true, bounding_box(macro), Vector2{0.05, -0.31}))
      .tiles();
}

Tensors random_strain(int cells, unsigned seed) {
  std::mt19937 numbers(seed);
  std::normal_distribution<double> any(0, 1e-4);
  Tensors strain(static_cast<std::size_t>(cells));
  for (PlaneTensor& e : strain)
    for (double& c : e) c = any(numbers);
  return strain;
}

Eigen::Vector3d vector(const PlaneTensor& t) { return {t[0], t[1], t[2]}; }

/// Mean and population covariance of a few frames, by definition.
struct Moments {
  Tensors mean;
  Covariances covariance;
};
Moments moments(const std::vector<Tensors>& frames) {
  const double share = 1 / static_cast<double>(frames.size());
  Moments all{Tensors(frames[0].size()), Covariances(frames[0].size())};
  static constexpr int row[] = {0, 1, 2, 1, 0, 0}, column[] = {0, 1, 2, 2, 2, 1};
  for (std::size_t k = 0; k < frames[0].size(); ++k) {
    for (const Tensors& frame : frames)
      for (std::size_t i = 0; i < 3; ++i) all.mean[k][i] += share * frame[k][i];
    for (const Tensors& frame : frames)
      for (std::size_t i = 0; i < 6; ++i)
        all.covariance[k][i] +=
            share * (frame[k][row[i]] - all.mean[k][row[i]]) * (frame[k][column[i]] - all.mean[k][column[i]]);
  }
  return all;
}

}  // namespace

/// One material and A = I: the local stress is the macroscopic one.
TEST(Relocalisation, OfAUniformMaterialIsTheMacroscopicStress) {
  const PlaneGrid macro = macro_block();
  const LocalisationTensors tensors = made_up(true);
  const Targets targets = tiles(tensors, macro);
  Relocalisation relocalize(tensors, macro, Recovery::element, targets.sites);
  const Tensors strain = random_strain(macro.cells(), 1);
  Tensors at(relocalize.places()), local(relocalize.places()), stress(relocalize.places());
  relocalize.macroscopic(strain, at);
  relocalize.strain(at, local);
  relocalize.stress(at, stress);
  ASSERT_EQ(at.size(), static_cast<std::size_t>(targets.grid.cells()));
  for (std::size_t k = 0; k < at.size(); ++k) {
    const PlaneTensor& e = strain[targets.sites[k].macro.cell];
    const Eigen::Vector3d expected = tensors.stiffness[0] * vector(e);
    for (int i = 0; i < 3; ++i) {
      EXPECT_EQ(local[k][i], e[i]);
      EXPECT_DOUBLE_EQ(stress[k][i], expected[i]);
    }
  }
}

/// A strain that is linear in space: `nodal` gives it at the centre of each target.
TEST(Relocalisation, SeesALinearMacroscopicStrainExactly) {
  const PlaneGrid macro = macro_block();
  const LocalisationTensors tensors = made_up(false);
  const Targets targets = tiles(tensors, macro);
  Relocalisation relocalize(tensors, macro, Recovery::nodal, targets.sites);
  const auto field = [](const Vector2& x) {
    return PlaneTensor{1 + 2 * x[0] - x[1], -0.4 * x[0], 3 * x[1] - 0.7};
  };
  Tensors strain, at(relocalize.places()), local(at), stress(at);
  for (const Vector2& x : centres(macro)) strain.push_back(field(x));
  relocalize.macroscopic(strain, at);
  relocalize.strain(at, local);
  relocalize.stress(at, stress);
  const std::vector<Vector2> middles = centres(targets.grid);
  for (std::size_t k = 0; k < at.size(); ++k) {
    const PlaneTensor e = field(middles[k]);
    const Eigen::Vector3d local_strain = tensors.localisation[targets.source_cell[k]] * vector(e);
    const Eigen::Vector3d local_stress = tensors.stiffness[targets.grid.region[k]] * local_strain;
    for (int i = 0; i < 3; ++i) {
      EXPECT_NEAR(at[k][i], e[i], 1e-13 * 4);
      EXPECT_NEAR(local[k][i], local_strain[i], 1e-12);
      EXPECT_NEAR(stress[k][i], local_stress[i], 1e-12 * 100e9);
    }
  }
}

/// Relocalisation is linear: mean and covariance of the local stress over some frames are those made from the
/// mean and covariance of the macroscopic strain.
TEST(Relocalisation, OfStatisticsIsTheStatisticsOfFrames) {
  const PlaneGrid macro = macro_block();
  const LocalisationTensors tensors = made_up(false);
  const Targets targets = tiles(tensors, macro);
  Relocalisation relocalize(tensors, macro, Recovery::element, targets.sites);
  std::vector<Tensors> frames, strains, stresses;
  for (unsigned n = 0; n < 20; ++n) {
    frames.push_back(random_strain(macro.cells(), n));
    strains.emplace_back(relocalize.places());
    stresses.emplace_back(relocalize.places());
    relocalize.macroscopic(frames[n], strains[n]);
    relocalize.stress(strains[n], stresses[n]);
    relocalize.strain(strains[n], strains[n]);
  }
  const Moments homogeneous = moments(frames), strain = moments(strains), stress = moments(stresses);
  Tensors mean(relocalize.places()), mean_strain(mean), mean_stress(mean);
  Covariances strain_covariance(relocalize.places()), stress_covariance(strain_covariance);
  std::vector<CovarianceRoot> roots(relocalize.places());
  relocalize.macroscopic(homogeneous.mean, mean);
  relocalize.macroscopic_roots(homogeneous.covariance, roots);
  relocalize.strain(mean, mean_strain);
  relocalize.stress(mean, mean_stress);
  relocalize.strain_covariance(roots, strain_covariance);
  relocalize.stress_covariance(roots, stress_covariance);
  const double e = 1e-4, s = 1e-4 * 100e9;  // sizes
  for (std::size_t k = 0; k < mean.size(); ++k) {
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_NEAR(mean_strain[k][i], strain.mean[k][i], 1e-13 * e);
      EXPECT_NEAR(mean_stress[k][i], stress.mean[k][i], 1e-13 * s);
      EXPECT_DOUBLE_EQ(deviation(stress_covariance[k])[i], std::sqrt(stress_covariance[k][i]));
    }
    for (std::size_t i = 0; i < 6; ++i) {
      EXPECT_NEAR(strain_covariance[k][i], strain.covariance[k][i], 1e-13 * e * e);
      EXPECT_NEAR(stress_covariance[k][i], stress.covariance[k][i], 1e-13 * s * s);
    }
  }
}

/// Places shared out among ranks have the bits they have on one.
TEST(Relocalisation, HasTheSameBitsInAnyShares) {
  const PlaneGrid macro = macro_block();
  const LocalisationTensors tensors = made_up(false);
  const Targets targets = tiles(tensors, macro);
  const Tensors strain = random_strain(macro.cells(), 5);
  const auto stress_of = [&](std::span<const Site> sites) {
    Relocalisation relocalize(tensors, macro, Recovery::nodal, sites);
    Tensors stress(relocalize.places());
    relocalize.macroscopic(strain, stress);
    relocalize.stress(stress, stress);
    return stress;
  };
  const Tensors whole = stress_of(targets.sites);
  for (const int ranks : {1, 2, 3, 7}) {
    Tensors joined;
    for (int rank = 0; rank < ranks; ++rank) {
      const RankShare mine = rank_share(targets.sites.size(), rank, ranks);
      EXPECT_EQ(mine.begin, joined.size());
      const Tensors part = stress_of(std::span(targets.sites).subspan(mine.begin, mine.count()));
      joined.insert(joined.end(), part.begin(), part.end());
    }
    EXPECT_EQ(joined, whole) << ranks;
  }
}

TEST(RankShare, IsEvenToOne) {
  for (const std::size_t total : {0u, 1u, 2u, 10u, 11u})
    for (const int ranks : {1, 2, 3, 4}) {
      std::size_t next = 0;
      for (int rank = 0; rank < ranks; ++rank) {
        const RankShare share = rank_share(total, rank, ranks);
        EXPECT_EQ(share.begin, next);
        EXPECT_LE(share.count(), total / static_cast<std::size_t>(ranks) + 1);
        EXPECT_GE(share.count(), total / static_cast<std::size_t>(ranks));
        next = share.end;
      }
      EXPECT_EQ(next, total);
    }
}

/// A covariance that falls to zero at a side, where patches weigh cells negatively: recovered as it stands,
/// its variances come out negative there; by roots they cannot, nor its determinant.
TEST(Relocalisation, LeavesNoVarianceNegative) {
  const PlaneGrid macro = macro_block();
  const LocalisationTensors tensors = made_up(false);
  const Targets targets = tiles(tensors, macro);
  Relocalisation relocalize(tensors, macro, Recovery::nodal, targets.sites);
  Covariances cells;
  std::mt19937 numbers(5);
  std::normal_distribution<double> any;
  for (int cell = 0; cell < macro.cells(); ++cell) {
    const double size = std::pow(10.0, -8 * centre(macro, cell)[1]);
    Eigen::Matrix3d factor;
    for (int i = 0; i < 9; ++i) factor.data()[i] = size * any(numbers);
    const Eigen::Matrix3d c = factor * factor.transpose();
    cells.push_back({c(0, 0), c(1, 1), c(2, 2), c(1, 2), c(0, 2), c(0, 1)});
  }
  std::vector<CovarianceRoot> roots(relocalize.places());
  Covariances strain(relocalize.places()), stress(relocalize.places());
  relocalize.macroscopic_roots(cells, roots);
  relocalize.strain_covariance(roots, strain);
  relocalize.stress_covariance(roots, stress);
  for (const Covariances* each : {&strain, &stress})
    for (const PlaneCovariance& c : *each) {
      for (int i = 0; i < 3; ++i) EXPECT_GE(c[i], 0);
      EXPECT_TRUE(is_covariance(c));
    }
  EXPECT_FALSE(is_covariance({1, 1, 1, 0, 0, 1.1}));
}

/// A covariance that is the same everywhere, or of deviations that are linear and move together, is recovered
/// as it is.
TEST(Relocalisation, RecoversDeviationsThatAreLinear) {
  const PlaneGrid macro = macro_block();
  LocalisationTensors tensors = made_up(true);
  const Targets targets = tiles(tensors, macro);
  Relocalisation relocalize(tensors, macro, Recovery::nodal, targets.sites);
  const auto deviation_at = [](const Vector2& x) { return 1 + 0.7 * x[0] + 0.4 * x[1]; };
  Covariances cells;
  for (int cell = 0; cell < macro.cells(); ++cell) {
    const double d = deviation_at(centre(macro, cell));
    cells.push_back({4 * d * d, 2 * d * d, d * d, 0.5 * d * d, 0.3 * d * d, d * d});
  }
  std::vector<CovarianceRoot> roots(relocalize.places());
  Covariances strain(relocalize.places());
  relocalize.macroscopic_roots(cells, roots);
  relocalize.strain_covariance(roots, strain);
  for (int target = 0; target < targets.grid.cells(); ++target)
    EXPECT_NEAR(deviation(strain[target])[0], 2 * deviation_at(centre(targets.grid, target)), 1e-12);
}

TEST(Deviation, TakesRoundingForZero) {
  EXPECT_EQ(deviation({4, -1e-30, 0, 1, 1, 1}), (PlaneTensor{2, 0, 0}));
}
