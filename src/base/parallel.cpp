#include "slipscale/base/parallel.hpp"

#include <algorithm>

namespace slipscale {

int rank_of(MPI_Comm comm) {
  int rank = 0;
  MPI_Comm_rank(comm, &rank);
  return rank;
}

int ranks_of(MPI_Comm comm) {
  int ranks = 1;
  MPI_Comm_size(comm, &ranks);
  return ranks;
}

bool is_root(MPI_Comm comm) { return rank_of(comm) == 0; }

RankShare rank_share(std::size_t total, int rank, int ranks) {
  const auto p = static_cast<std::size_t>(rank), n = static_cast<std::size_t>(ranks);
  const std::size_t each = total / n, more = total % n;
  return {p * each + std::min(p, more), (p + 1) * each + std::min(p + 1, more)};
}

}  // namespace slipscale
