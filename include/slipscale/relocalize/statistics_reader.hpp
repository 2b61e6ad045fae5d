#pragma once

#include <mpi.h>

#include <array>
#include <memory>
#include <span>
#include <string>

#include "slipscale/mesh/plane_grid.hpp"

namespace slipscale {

class GridFile;

/// statistics.h5 of a run of `slide`. Reads like `FieldsReader`.
class StatisticsReader {
 public:
  /// `path`: the file, or the folder it lies in. Collective.
  StatisticsReader(MPI_Comm comm, const std::string& path, const std::string& option = "relocalize_run");
  ~StatisticsReader();
  StatisticsReader(StatisticsReader&&) noexcept;

  const std::string& path() const;
  const PlaneGrid& grid() const { return grid_; }
  double from() const { return from_; }          ///< s
  double to() const { return to_; }              ///< s
  double samples() const { return samples_; }    ///< a whole number
  double quantile() const { return quantile_; }  ///< of the upper tail

  /// A statistic of `stress` [Pa] or `strain` [1]: mean, deviation, lowest, highest, quantile_low or
  /// quantile_high (xx, yy, xy) of the cells from `begin` on, as many as `rows` has. Throws UserError where
  /// the file has none. Collective.
  void read(const std::string& quantity, const std::string& statistic, std::span<std::array<double, 3>> rows,
            std::size_t begin = 0) const;

  /// Covariance of `stress` [Pa²] or `strain` [1] as (xx.xx, yy.yy, xy.xy, yy.xy, xx.xy, xx.yy). Likewise.
  void read_covariance(const std::string& quantity, std::span<std::array<double, 6>> rows,
                       std::size_t begin = 0) const;

 private:
  template <std::size_t N>
  void read_rows(const std::string& quantity, const std::string& statistic,
                 std::span<std::array<double, N>> rows, std::size_t begin) const;

  std::unique_ptr<GridFile> file_;
  PlaneGrid grid_;
  double from_ = 0, to_ = 0, samples_ = 0, quantile_ = 0;
};

/// Whether a run's folder has statistics: rank 0 looks. Collective.
bool has_statistics(MPI_Comm comm, const std::string& folder);

}  // namespace slipscale
