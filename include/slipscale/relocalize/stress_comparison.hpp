#pragma once

#include <mpi.h>

#include <optional>
#include <string>
#include <vector>

#include "slipscale/files/running_statistics.hpp"
#include "slipscale/relocalize/comparison_report.hpp"
#include "slipscale/relocalize/fields_reader.hpp"
#include "slipscale/relocalize/local_stress.hpp"
#include "slipscale/relocalize/relocalised_statistics.hpp"
#include "slipscale/relocalize/statistics_reader.hpp"

namespace slipscale {

/// Compares relocalised stress, and that of the homogeneous run itself, with that of a heterogeneous run at
/// the cells of its mesh, frame by frame and in their statistics over time. All members are collective.
class StressComparison {
 public:
  struct Choice {
    std::string folder;  ///< of the heterogeneous run
    double layer = 0;    ///< m, depth of the boundary layer
    double bulk = 0;     ///< m, from the edges
  };

  /// `targets` are cells of the reference's mesh, and outlive this object like `reference`. `times` are those
  /// of the homogeneous run's frames. Throws UserError when the reference's frames hold no stress, and when
  /// the runs have no time in common.
  StressComparison(MPI_Comm comm, const FieldsReader& reference, const Targets& targets,
                   const RankShare& mine, const std::vector<double>& times, const Choice& choice);

  /// The reference's stress at this rank's cells at the time of a frame of the homogeneous run; null where it
  /// has none.
  const std::vector<PlaneTensor>* reference_stress(std::size_t frame);

  /// After `reference_stress`, for a frame that both runs have.
  void add_frame(const LocalStress& local);

  /// Throws UserError unless both are statistics of the same window of time, to a hundredth.
  static void refuse_other_window(const StatisticsReader& reference, const StatisticsReader& run);

  /// Mean and deviation over the window of the two runs' statistics. `local` is left with the mean.
  void add_statistics(const StatisticsReader& reference, const StrainStatistics& strain, LocalStress& local);

  /// What was compared; the statistics of the common frames included. Once, at the end.
  Comparison finish();

 private:
  using Fields = std::array<std::vector<PlaneTensor>, StressSource::count>;
  std::vector<StressSums> sums(const StressFields& fields) const;
  void compare(const std::string& statistic, const Fields& fields);
  void compare_tails();

  MPI_Comm comm_;
  const FieldsReader& reference_;
  ComparedCells cells_;
  Comparison found_;
  std::vector<int> source_;  ///< this rank's cells in the mesh of the reference, ascending
  std::vector<std::optional<std::size_t>> reference_frame_;  ///< by frame of the homogeneous run
  std::vector<PlaneTensor> range_, stress_;
  std::vector<RunningStatistics> frames_;  ///< one for each source, or none where there is but one frame
};

}  // namespace slipscale
