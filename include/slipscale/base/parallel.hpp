#pragma once

#include <mpi.h>

#include <cstddef>

namespace slipscale {

/// MPI calls are not checked one by one: its own answer to an error, ending all ranks with a message, is
/// kept.

int rank_of(MPI_Comm comm);
int ranks_of(MPI_Comm comm);
bool is_root(MPI_Comm comm);  ///< rank 0

/// What belongs to one of the ranks: [begin, end) of 0 to `total`, one more for the first of them where the
/// total does not divide.
struct RankShare {
  std::size_t begin = 0, end = 0;
  std::size_t count() const { return end - begin; }
};
RankShare rank_share(std::size_t total, int rank, int ranks);

}  // namespace slipscale
