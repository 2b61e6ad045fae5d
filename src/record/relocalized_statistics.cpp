#include "slipscale/record/relocalized_statistics.hpp"

#include "slipscale/record/statistics_file.hpp"

namespace slipscale {
namespace {

template <std::size_t N>
std::vector<double> flat(const std::vector<std::array<double, N>>& rows) {
  std::vector<double> values;
  values.reserve(N * rows.size());
  for (const auto& row : rows) values.insert(values.end(), row.begin(), row.end());
  return values;
}

}  // namespace

void write_relocalized_statistics(MPI_Comm comm, const StatisticsReader& run, const PlaneGrid& grid,
                                  const RankShare& mine, LocalStress& local, const std::string& folder) {
  const auto cells = static_cast<std::size_t>(run.grid().cells());
  std::vector<PlaneTensor> mean(cells);
  std::vector<PlaneCovariance> covariance(cells);
  run.read("strain", "mean", mean);
  run.read_covariance("strain", covariance);
  local.update(mean);
  const LocalStress::Covariances found = local.covariances(covariance);
  FieldStatistics stress, strain;
  stress.mean = flat(local.stress());
  strain.mean = flat(local.strain());
  stress.covariance = flat(found.stress);
  strain.covariance = flat(found.strain);
  const StatisticsSample sample{.from = run.from(),
                                .to = run.to(),
                                .count = static_cast<std::size_t>(run.samples()),
                                .quantile = run.quantile(),
                                .tails = false};
  write_statistics(comm, MeshImage(comm, grid, mine.begin, mine.end), sample, stress, strain, folder,
                   "relocalized_statistics");
}

}  // namespace slipscale
