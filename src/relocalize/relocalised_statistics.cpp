#include "slipscale/relocalize/relocalised_statistics.hpp"

#include <algorithm>

#include "slipscale/base/error.hpp"
#include "slipscale/base/finite.hpp"
#include "slipscale/files/statistics_file.hpp"
#include "slipscale/mesh/point_location.hpp"

namespace slipscale {
namespace {

template <std::size_t N>
std::vector<double> flat(const std::vector<std::array<double, N>>& rows) {
  std::vector<double> values;
  values.reserve(N * rows.size());
  for (const auto& row : rows) values.insert(values.end(), row.begin(), row.end());
  return values;
}

template <std::size_t N>
std::vector<std::array<double, N>> picked(const std::vector<std::array<double, N>>& rows,
                                          const std::vector<int>& numbers) {
  std::vector<std::array<double, N>> found;
  found.reserve(numbers.size());
  for (const int k : numbers) found.push_back(rows[k]);
  return found;
}

}  // namespace

std::vector<int> cells_among(const PlaneGrid& whole, const PlaneGrid& part) {
  const PointLocation location(whole);
  std::vector<int> found;
  found.reserve(part.region.size());
  for (int cell = 0; cell < part.cells(); ++cell) {
    found.push_back(location.find(centre(part, cell)).cell);
    if (found.back() == CellPlace::none || (cell > 0 && found[cell] <= found[cell - 1]))
      throw UserError(
          "a run's statistics.h5 and fields.h5 have different meshes; run slide again for both of them");
  }
  return found;
}

StrainStatistics strain_statistics(const StatisticsReader& run, const PlaneGrid& frames) {
  const std::vector<int> cells = cells_among(run.grid(), frames);
  const auto all = static_cast<std::size_t>(run.grid().cells());
  std::vector<PlaneTensor> mean(all);
  std::vector<PlaneCovariance> covariance(all);
  run.read("strain", "mean", mean);
  run.read_covariance("strain", covariance);
  if (!std::ranges::all_of(covariance, is_covariance))
    throw UserError("'" + run.path() +
                    "' (-relocalize_run) is damaged: its covariances of the strain are none (a variance "
                    "below zero); run slide "
                    "with -statistics_from again");
  return {picked(mean, cells), picked(covariance, cells)};
}

void write_relocalised_statistics(MPI_Comm comm, const StatisticsReader& run, const StrainStatistics& of_run,
                                  const PlaneGrid& grid, const RankShare& mine, LocalStress& local,
                                  const std::string& folder) {
  local.update(of_run.mean);
  const LocalStress::Covariances found = local.covariances(of_run.covariance);
  FieldStatistics stress, strain;
  stress.mean = flat(local.stress());
  strain.mean = flat(local.strain());
  stress.covariance = flat(found.stress);
  strain.covariance = flat(found.strain);
  refuse_unless_finite(comm, stress.mean, "the mean of the relocalised stress", cure_of_overflow);
  refuse_unless_finite(comm, strain.mean, "the mean of the relocalised strain", cure_of_overflow);
  refuse_unless_finite(comm, stress.covariance, "the covariance of the relocalised stress", cure_of_overflow);
  refuse_unless_finite(comm, strain.covariance, "the covariance of the relocalised strain", cure_of_overflow);
  const StatisticsSample sample{.from = run.from(),
                                .to = run.to(),
                                .count = static_cast<std::size_t>(run.samples()),
                                .quantile = run.quantile(),
                                .tails = false};
  write_statistics(comm, MeshImage(comm, grid, mine.begin, mine.end), sample, stress, strain, folder,
                   "relocalized_statistics");
}

}  // namespace slipscale
