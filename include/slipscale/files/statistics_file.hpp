#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "slipscale/base/plane_tensor.hpp"
#include "slipscale/files/mesh_image.hpp"
#include "slipscale/files/running_statistics.hpp"

namespace slipscale {

/// What statistics were taken of.
struct StatisticsSample {
  double from = 0, to = 0;  ///< s, times of the first and the last sample
  std::size_t count = 0;
  double quantile = 0;
  bool tails = true;  ///< lowest, highest and the quantiles are known
};

/// statistics.h5 and statistics.xdmf: the mesh and, for each of its cells, the statistics over time of stress
/// [Pa] and strain [1, engineering shear]; opens in ParaView as it is. In whole-mesh order: the same data on
/// any number of ranks.
///
/// /mesh as in fields.h5; /statistics with the attributes from, to, samples, quantile; /statistics/stress and
/// /statistics/strain, each with mean, deviation [cells, 3], covariance [cells, 6] (xx.xx, yy.yy, xy.xy,
/// yy.xy, xx.xy, xx.yy, of the population) and, where the tails are known, lowest, highest, quantile_low,
/// quantile_high [cells, 3]. The XDMF file shows all but the covariance as stress_mean and so on.
///
/// With `damping_power` [places], /statistics/damping_power [cells] W/m³: the mean power of bulk damping from
/// the first to the last sample; NaN of a single one.
///
/// `stress`, `strain`: places are the cells that this rank draws of the image, in local order. Both files,
/// `name`.h5 and .xdmf, appear under their names when they are whole. Throws UserError on all ranks when they
/// cannot be written. Collective.
void write_statistics(MPI_Comm comm, const MeshImage& image, const StatisticsSample& sample,
                      const FieldStatistics& stress, const FieldStatistics& strain, const std::string& folder,
                      const std::string& name = "statistics",
                      const std::optional<std::vector<double>>& damping_power = {});

/// Predicted size of statistics.h5, bytes.
double statistics_bytes(std::int64_t points, std::int64_t cells);

}  // namespace slipscale
