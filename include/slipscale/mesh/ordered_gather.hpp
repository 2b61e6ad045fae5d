#pragma once

#include <mpi.h>

#include <span>
#include <vector>

#include "slipscale/mesh/mesh.hpp"

namespace slipscale {

/// Brings the rows of all ranks to rank 0 in the order of a key, so that what is summed or written there has
/// the same bits on any number of ranks. Keys are distinct. For rows that are few: boundaries, probes.
class OrderedGather {
 public:
  OrderedGather() = default;
  /// Collective.
  OrderedGather(MPI_Comm comm, const std::vector<PetscInt>& keys);

  /// Rows of all ranks [count(), width] on rank 0, ascending key; empty elsewhere. `rows` is this rank's
  /// [keys, width]. Collective.
  std::vector<double> operator()(std::span<const double> rows, int width) const;

  int count() const { return static_cast<int>(place_.size()); }  ///< on rank 0
  const std::vector<PetscInt>& keys() const { return keys_; }    ///< on rank 0, ascending

 private:
  MPI_Comm comm_ = MPI_COMM_NULL;
  std::vector<int> counts_, starts_;  ///< rank 0: rows of each rank
  std::vector<int> place_;            ///< rank 0: where an arriving row belongs
  std::vector<PetscInt> keys_;
};

}  // namespace slipscale
