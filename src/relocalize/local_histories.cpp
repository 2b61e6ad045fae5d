#include "slipscale/relocalize/local_histories.hpp"

#include <algorithm>

#include "slipscale/base/error.hpp"
#include "slipscale/base/print.hpp"

namespace slipscale {
namespace {

std::vector<double> component(const std::vector<PlaneTensor>& rows, std::size_t i) {
  std::vector<double> values;
  for (const PlaneTensor& row : rows) values.push_back(row[i]);
  return values;
}

/// The rows whose times are among those of the reference; both ascend.
std::vector<PlaneTensor> at_times(const LocalHistory& history, const std::vector<PlaneTensor>& rows) {
  std::vector<PlaneTensor> found;
  for (std::size_t k = 0; k < rows.size(); ++k)
    if (std::ranges::binary_search(history.reference_time, history.time[k])) found.push_back(rows[k]);
  return found;
}

}  // namespace

LocalHistories::LocalHistories(MPI_Comm comm, const Targets& targets, const RankShare& mine,
                               const std::vector<Vector2>& points)
    : comm_(comm), mine_(mine) {
  if (points.empty()) return;
  const PointLocation location(targets.grid);
  for (const Vector2& x : points) {
    const CellPlace place = location.find(x);
    if (place.cell == CellPlace::none)
      throw UserError(
          format("-relocalize_points: ({:g}, {:g}) m lies outside the cells on which the stress is "
                 "relocalised; move the point into the body",
                 x[0], x[1]));
    LocalHistory history;
    history.x = x;
    history.cell = place.cell;
    history.region = targets.grid.region[place.cell];
    histories_.push_back(std::move(history));
  }
}

std::vector<PlaneTensor> LocalHistories::gather(const std::vector<PlaneTensor>& share) const {
  std::vector<PlaneTensor> rows(histories_.size(), PlaneTensor{});
  for (std::size_t k = 0; k < rows.size(); ++k) {
    const auto cell = static_cast<std::size_t>(histories_[k].cell);
    if (cell >= mine_.begin && cell < mine_.end) rows[k] = share[cell - mine_.begin];
  }
  MPI_Allreduce(MPI_IN_PLACE, rows.data(), static_cast<int>(3 * rows.size()), MPI_DOUBLE, MPI_SUM, comm_);
  return rows;
}

void LocalHistories::add(double time, const LocalStress& local, const std::vector<PlaneTensor>* reference) {
  if (histories_.empty()) return;
  const auto stress = gather(local.stress()), strain = gather(local.strain()),
             homogeneous = gather(local.homogeneous_stress());
  const auto expected = reference ? gather(*reference) : std::vector<PlaneTensor>{};
  for (std::size_t k = 0; k < histories_.size(); ++k) {
    LocalHistory& history = histories_[k];
    history.time.push_back(time);
    history.stress.push_back(stress[k]);
    history.strain.push_back(strain[k]);
    history.homogeneous_stress.push_back(homogeneous[k]);
    if (!reference) continue;
    history.reference_time.push_back(time);
    history.reference_stress.push_back(expected[k]);
  }
}

std::vector<ComparedProbe> LocalHistories::agreements(const std::vector<std::string>& regions) const {
  std::vector<ComparedProbe> found;
  for (const LocalHistory& history : histories_) {
    ComparedProbe probe{.position = history.x, .region = regions[history.region]};
    const auto relocalised = at_times(history, history.stress),
               homogeneous = at_times(history, history.homogeneous_stress);
    for (std::size_t i = 0; i < 3; ++i) {
      const std::vector<double> expected = component(history.reference_stress, i);
      probe.relocalised[i] = agreement(expected, component(relocalised, i));
      probe.homogeneous[i] = agreement(expected, component(homogeneous, i));
    }
    found.push_back(probe);
  }
  return found;
}

}  // namespace slipscale
