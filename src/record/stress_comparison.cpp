#include "slipscale/record/stress_comparison.hpp"

#include <algorithm>
#include <cmath>

#include "slipscale/base/error.hpp"
#include "slipscale/base/print.hpp"

namespace slipscale {
namespace {

constexpr double same_time = 0.02;  ///< of the time between frames; they stand at the nearest step
constexpr double tail = 0.99;       ///< quantile of the frames

ComparedCells compared_cells(const Targets& targets, const RankShare& mine) {
  ComparedCells cells;
  for (std::size_t k = mine.begin; k < mine.end; ++k) {
    const int cell = static_cast<int>(k);
    cells.area.push_back(area(targets.grid, cell));
    cells.centroid.push_back(centre(targets.grid, cell));
    cells.region.push_back(targets.grid.region[k]);
  }
  return cells;
}

double tolerance(const std::vector<double>& times) {
  double least = times.empty() ? 0 : std::abs(times.back());
  for (std::size_t k = 1; k < times.size(); ++k) least = std::min(least, times[k] - times[k - 1]);
  return same_time * least;
}

/// Rows of the cells of a share out of the rows of all that lie between them in the file.
template <class Row>
void pick(const std::vector<Row>& range, const Targets& targets, const RankShare& mine,
          std::vector<Row>& rows) {
  rows.resize(mine.count());
  for (std::size_t k = mine.begin; k < mine.end; ++k)
    rows[k - mine.begin] = range[targets.source_cell[k] - targets.source_cell[mine.begin]];
}

/// How many rows of the file the cells of a share span.
std::size_t span_of(const Targets& targets, const RankShare& mine) {
  return mine.count() == 0 ? 0 : targets.source_cell[mine.end - 1] - targets.source_cell[mine.begin] + 1;
}

std::size_t begin_of(const Targets& targets, const RankShare& mine) {
  return mine.count() == 0 ? 0 : static_cast<std::size_t>(targets.source_cell[mine.begin]);
}

std::vector<PlaneTensor> deviations(const std::vector<PlaneCovariance>& covariances) {
  std::vector<PlaneTensor> found;
  for (const PlaneCovariance& each : covariances) found.push_back(deviation(each));
  return found;
}

std::vector<PlaneTensor> tensors(const std::vector<double>& values) {
  std::vector<PlaneTensor> rows(values.size() / 3);
  for (std::size_t k = 0; k < rows.size(); ++k) std::copy_n(values.begin() + 3 * k, 3, rows[k].begin());
  return rows;
}

void refuse_other_window(const StatisticsReader& reference, const StatisticsReader& run) {
  const double size = std::max(std::abs(run.to()), std::abs(run.from()));
  if (std::abs(reference.from() - run.from()) > 0.01 * size ||
      std::abs(reference.to() - run.to()) > 0.01 * size)
    throw UserError(
        format("the statistics of -relocalize_reference are those of %g to %g s and the statistics "
               "of -relocalize_run those of %g to %g s; record both with the same -statistics_from "
               "and -statistics_to",
               reference.from(), reference.to(), run.from(), run.to()));
}

}  // namespace

StressComparison::StressComparison(MPI_Comm comm, const FieldsReader& reference, const Targets& targets,
                                   const RankShare& mine, const std::vector<double>& times,
                                   const Choice& choice)
    : comm_(comm),
      reference_(reference),
      targets_(targets),
      mine_(mine),
      cells_(compared_cells(targets, mine)),
      reference_frame_(times.size()),
      range_(span_of(targets, mine)),
      stress_(mine.count()) {
  const BoundingBox block = bounding_box(targets.grid);
  found_.reference = choice.folder;
  found_.zones = {block, block.lower[1], choice.layer, choice.bulk};
  found_.parts = block_parts(cells_, targets.grid.regions, found_.zones);
  found_.levels = {0.01, 0.5, 0.99};
  const auto common =
      common_frames(reference.times(), times, std::max(tolerance(reference.times()), tolerance(times)));
  if (common.empty())
    throw UserError(
        "-relocalize_reference has no frame at a time of the frames of -relocalize_run; record "
        "both with the same -fields_times, or a -fields_every that gives the same times");
  for (const auto& [in_reference, in_run] : common) reference_frame_[in_run] = in_reference;
  if (common.size() > 1) frames_.assign(StressSource::count, {mine.count(), common.size(), tail});
}

const std::vector<PlaneTensor>* StressComparison::reference_stress(std::size_t frame) {
  if (!reference_frame_[frame]) return nullptr;
  reference_.read(*reference_frame_[frame], "stress", range_, begin_of(targets_, mine_));
  pick(range_, targets_, mine_, stress_);
  found_.time.push_back(reference_.times()[*reference_frame_[frame]]);
  return &stress_;
}

std::vector<StressSums> StressComparison::sums(const StressFields& fields) const {
  std::vector<StressSums> found = stress_sums(found_.parts, cells_, fields);
  const auto values = numbers(found);
  MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_DOUBLE, MPI_SUM, comm_);
  return found;
}

void StressComparison::add_frame(const LocalStress& local) {
  const StressFields fields{stress_, local.stress(), local.homogeneous_stress()};
  found_.frames.push_back(sums(fields));
  for (std::size_t k = 0; k < frames_.size(); ++k)
    frames_[k].add(fields[k].empty() ? nullptr : fields[k].front().data());
  found_.quantiles =
      stress_quantiles(found_.parts, cells_, fields, found_.levels, [this](std::span<double> values) {
        MPI_Allreduce(MPI_IN_PLACE, values.data(), static_cast<int>(values.size()), MPI_DOUBLE, MPI_SUM,
                      comm_);
      });
}

void StressComparison::compare(const std::string& statistic, const Fields& fields) {
  found_.statistics.push_back({statistic, sums({fields[0], fields[1], fields[2]})});
}

void StressComparison::add_statistics(const StatisticsReader& reference, const StatisticsReader& run,
                                      LocalStress& local) {
  refuse_other_window(reference, run);
  const auto of_reference = [&](const std::string& statistic) {
    std::vector<PlaneTensor> rows;
    reference.read("stress", statistic, range_, begin_of(targets_, mine_));
    pick(range_, targets_, mine_, rows);
    return rows;
  };
  const auto macro_cells = static_cast<std::size_t>(run.grid().cells());
  std::vector<PlaneTensor> mean(macro_cells);
  run.read("strain", "mean", mean);
  local.update(mean);
  compare("mean", {of_reference("mean"), local.stress(), local.homogeneous_stress()});
  std::vector<PlaneCovariance> covariance(macro_cells);
  run.read_covariance("strain", covariance);
  const LocalStress::Covariances found = local.covariances(covariance);
  compare("deviation",
          {of_reference("deviation"), deviations(found.stress), deviations(found.homogeneous_stress)});
}

/// Of the frames that both runs have: extremes and quantiles do not follow from those of the strain.
void StressComparison::compare_tails() {
  std::array<FieldStatistics, StressSource::count> found;
  for (std::size_t k = 0; k < found.size(); ++k) found[k] = frames_[k].result();
  const std::pair<const char*, std::vector<double> FieldStatistics::*> each[] = {
      {"lowest of frames", &FieldStatistics::lowest},
      {"highest of frames", &FieldStatistics::highest},
      {"1 % quantile of frames", &FieldStatistics::quantile_low},
      {"99 % quantile of frames", &FieldStatistics::quantile_high}};
  for (const auto& [name, values] : each)
    compare(name, {tensors(found[0].*values), tensors(found[1].*values), tensors(found[2].*values)});
}

Comparison StressComparison::finish() {
  if (!frames_.empty()) compare_tails();
  return std::move(found_);
}

}  // namespace slipscale
