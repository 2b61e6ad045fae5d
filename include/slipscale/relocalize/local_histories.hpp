#pragma once

#include <mpi.h>

#include <string>
#include <vector>

#include "slipscale/relocalize/comparison_report.hpp"
#include "slipscale/relocalize/local_stress.hpp"

namespace slipscale {

/// What happens over time in the cell around one point.
struct LocalHistory {
  Vector2 x{};  ///< m, of the point
  int cell = 0, region = 0;
  std::vector<double> time;  ///< s
  std::vector<PlaneTensor> stress, strain, homogeneous_stress;
  std::vector<double> reference_time;
  std::vector<PlaneTensor> reference_stress;  ///< of the heterogeneous run, at `reference_time`
};

/// Histories at points, the same on every rank.
class LocalHistories {
 public:
  /// `points` as typed, m. Throws UserError for a point outside of the targets. Collective.
  LocalHistories(MPI_Comm comm, const Targets& targets, const RankShare& mine,
                 const std::vector<Vector2>& points);

  /// `reference`: stress at this rank's cells in the heterogeneous run, or null. Collective.
  void add(double time, const LocalStress& local, const std::vector<PlaneTensor>* reference);

  const std::vector<LocalHistory>& all() const { return histories_; }
  /// How relocalised and homogeneous stress follow that of the heterogeneous run.
  std::vector<ComparedProbe> agreements(const std::vector<std::string>& regions) const;

 private:
  /// The value at each point's cell, from the rank that has it.
  std::vector<PlaneTensor> gather(const std::vector<PlaneTensor>& share) const;

  MPI_Comm comm_;
  const RankShare mine_;
  std::vector<LocalHistory> histories_;
};

}  // namespace slipscale
