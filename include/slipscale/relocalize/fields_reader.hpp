#pragma once

#include <mpi.h>

#include <array>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "slipscale/mesh/plane_grid.hpp"

namespace slipscale {

class GridFile;

/// fields.h5 of a run of `slide`, whole or still growing.
///
/// Every rank reads by itself, and all ranks must call together: what fails on one, a damaged file say,
/// throws UserError on all.
class FieldsReader {
 public:
  /// `path`: the file, or the folder it lies in. `option` is the one that names it, for the messages.
  /// Collective.
  FieldsReader(MPI_Comm comm, const std::string& path, const std::string& option = "relocalize_run");
  ~FieldsReader();
  FieldsReader(FieldsReader&&) noexcept;

  const std::string& path() const;  ///< of the file
  std::string folder() const;       ///< it lies in
  const PlaneGrid& grid() const { return grid_; }
  const Box& block() const { return block_; }  ///< of the whole body, m, where frames show a part
  const std::vector<double>& times() const { return times_; }  ///< of the frames, s

  /// Whether all frames hold `stress` or `strain`.
  bool has(const std::string& quantity) const;
  /// Throws UserError with the cure where the frames lack it. Collective.
  void require(const std::string& quantity) const;

  /// `stress` [Pa] or `strain` [1] (xx, yy, xy) of the cells from `begin` on, as many as `rows` has; ranks
  /// may read different ones. Collective.
  void read(std::size_t frame, const std::string& quantity, std::span<std::array<double, 3>> rows,
            std::size_t begin = 0) const;

 private:
  std::unique_ptr<GridFile> file_;
  PlaneGrid grid_;
  Box block_;
  std::vector<double> times_;
};

}  // namespace slipscale
