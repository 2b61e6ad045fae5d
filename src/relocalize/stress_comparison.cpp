#include "slipscale/relocalize/stress_comparison.hpp"

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

/// Rows of a file from the first to the last one that a share needs; `source`, their numbers, ascend.
std::size_t reach(const std::vector<int>& source) {
  return source.empty() ? 0 : static_cast<std::size_t>(source.back() - source.front() + 1);
}
std::size_t begin_of(const std::vector<int>& source) {
  return source.empty() ? 0 : static_cast<std::size_t>(source.front());
}

/// The rows of the share out of these.
template <class Row>
void pick(const std::vector<Row>& range, const std::vector<int>& source, std::vector<Row>& rows) {
  rows.resize(source.size());
  for (std::size_t k = 0; k < source.size(); ++k) rows[k] = range[source[k] - source.front()];
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

void refuse_layer(double layer, double height) {
  if (layer >= height)
    throw UserError(format(
        "-relocalize_layer of {:g} m is the whole of the block, which is {:g} m high; give the depth of "
        "about one cell of the microstructure",
        layer, height));
}

}  // namespace

StressComparison::StressComparison(MPI_Comm comm, const FieldsReader& reference, const Targets& targets,
                                   const RankShare& mine, const std::vector<double>& times,
                                   const Choice& choice)
    : comm_(comm),
      reference_(reference),
      cells_(compared_cells(targets, mine)),
      source_(targets.source_cell.begin() + static_cast<std::ptrdiff_t>(mine.begin),
              targets.source_cell.begin() + static_cast<std::ptrdiff_t>(mine.end)),
      reference_frame_(times.size()),
      range_(reach(source_)),
      stress_(mine.count()) {
  reference.require("stress");
  const Box& block = reference.block();
  refuse_layer(choice.layer, block.extent(1));
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
  reference_.read(*reference_frame_[frame], "stress", range_, begin_of(source_));
  pick(range_, source_, stress_);
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

void StressComparison::refuse_other_window(const StatisticsReader& reference, const StatisticsReader& run) {
  const double size = std::max(std::abs(run.to()), std::abs(run.from()));
  if (std::abs(reference.from() - run.from()) > 0.01 * size ||
      std::abs(reference.to() - run.to()) > 0.01 * size)
    throw UserError(
        format("the statistics of -relocalize_reference are those of {:g} to {:g} s and the statistics "
               "of -relocalize_run those of {:g} to {:g} s; record both with the same -statistics_from "
               "and -statistics_to",
               reference.from(), reference.to(), run.from(), run.to()));
}

void StressComparison::add_statistics(const StatisticsReader& reference, const StrainStatistics& strain,
                                      LocalStress& local) {
  std::vector<int> source;
  const std::vector<int> rows_of_frames = cells_among(reference.grid(), reference_.grid());
  for (const int cell : source_) source.push_back(rows_of_frames[cell]);
  std::vector<PlaneTensor> range(reach(source));
  const auto of_reference = [&](const std::string& statistic) {
    std::vector<PlaneTensor> rows;
    reference.read("stress", statistic, range, begin_of(source));
    pick(range, source, rows);
    return rows;
  };
  local.update(strain.mean);
  compare("mean", {of_reference("mean"), local.stress(), local.homogeneous_stress()});
  const LocalStress::Covariances found = local.covariances(strain.covariance);
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
