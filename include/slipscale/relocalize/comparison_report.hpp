#pragma once

#include <string>
#include <vector>

#include "slipscale/relocalize/comparison.hpp"

namespace slipscale {

/// A statistic over time (mean, deviation, lowest, …) of both runs.
struct ComparedStatistic {
  std::string name;
  std::vector<StressSums> sums;  ///< [parts]
};

/// A point at which the histories are compared, by component xx, yy, xy.
struct ComparedProbe {
  Vector2 position{};  ///< m
  std::string region;
  std::array<HistoryAgreement, 3> relocalised{}, homogeneous{};
};

/// All that was compared, summed over the ranks. What was not compared stays empty.
struct Comparison {
  std::string reference;  ///< folder of the heterogeneous run
  BlockZones zones;
  std::vector<BlockPart> parts;                 ///< their cells are not used
  std::vector<double> time;                     ///< [frames] of the reference, s
  std::vector<std::vector<StressSums>> frames;  ///< [frames][parts]
  std::vector<double> levels;                   ///< of the quantiles, 0 to 1
  std::vector<StressQuantiles> quantiles;       ///< [parts], of the last frame
  std::vector<ComparedStatistic> statistics;
  std::vector<ComparedProbe> probes;
  std::vector<std::string> notes;  ///< what is doubtful, or does not fit together
};

/// The sums over all frames, [parts].
std::vector<StressSums> over_frames(const Comparison& comparison);

/// The report for the screen: relative L2 errors of σ_yy, σ_xx and σ_xy with and without relocalisation in
/// each part of the block, averages and quantiles in MPa, statistics, probes.
std::string describe(const Comparison& comparison);

/// comparison.yaml: the same numbers and those of every frame, SI, by keys: `error`, `mean`, `quantiles`,
/// `statistics` and `frames` hold all, layer, bulk and phases: <region>; each of these xx, yy and xy; each of
/// these reference, relocalised and homogeneous. `probes` are numbered from 0. `.nan` is what cannot be told:
/// the error of a component that is zero, the correlation of a constant.
std::string comparison_yaml(const Comparison& comparison);

}  // namespace slipscale
