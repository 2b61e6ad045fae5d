#include "slipscale/mesh/ordered_gather.hpp"

#include <algorithm>
#include <numeric>

#include "slipscale/base/parallel.hpp"

namespace slipscale {

OrderedGather::OrderedGather(MPI_Comm comm, const std::vector<PetscInt>& keys) : comm_(comm) {
  const int mine = static_cast<int>(keys.size());
  const int rank = rank_of(comm), ranks = ranks_of(comm);
  counts_.resize(static_cast<std::size_t>(ranks));
  starts_.assign(static_cast<std::size_t>(ranks), 0);
  MPI_Gather(&mine, 1, MPI_INT, counts_.data(), 1, MPI_INT, 0, comm);
  if (rank == 0) std::partial_sum(counts_.begin(), counts_.end() - 1, starts_.begin() + 1);
  std::vector<PetscInt> arriving(rank == 0 ? static_cast<std::size_t>(starts_.back() + counts_.back()) : 0);
  MPI_Gatherv(keys.data(), mine, MPIU_INT, arriving.data(), counts_.data(), starts_.data(), MPIU_INT, 0,
              comm);

  std::vector<int> order(arriving.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int a, int b) { return arriving[a] < arriving[b]; });
  place_.resize(order.size());
  for (std::size_t k = 0; k < order.size(); ++k) {
    place_[order[k]] = static_cast<int>(k);
    keys_.push_back(arriving[order[k]]);
  }
}

std::vector<double> OrderedGather::operator()(std::span<const double> rows, int width) const {
  MPI_Datatype row = MPI_DATATYPE_NULL;
  MPI_Type_contiguous(width, MPI_DOUBLE, &row);
  MPI_Type_commit(&row);
  std::vector<double> arriving(place_.size() * static_cast<std::size_t>(width)), sorted(arriving.size());
  MPI_Gatherv(rows.data(), static_cast<int>(rows.size()) / width, row, arriving.data(), counts_.data(),
              starts_.data(), row, 0, comm_);
  MPI_Type_free(&row);
  for (std::size_t k = 0; k < place_.size(); ++k)
    std::copy_n(&arriving[k * width], width, &sorted[static_cast<std::size_t>(place_[k]) * width]);
  return sorted;
}

}  // namespace slipscale
