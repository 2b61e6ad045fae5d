#pragma once

#include <mpi.h>

#include <cstddef>
#include <cstdint>
#include <functional>

namespace slipscale {

/// Rows [begin, begin + count) of something larger, of `bytes` each.
struct RowRange {
  std::uint64_t begin = 0, count = 0;
  std::size_t bytes = 0;
};

/// Brings the rows of all ranks to rank 0 in pieces of a few MiB, which `take` sees there one after the
/// other, rank by rank: rank 0 never holds more than its own rows and a piece. `take` must not throw.
/// Collective.
void collect_rows(
    MPI_Comm comm, const RowRange& mine, const void* rows,
    const std::function<void(std::uint64_t begin, std::uint64_t count, const void* rows)>& take);

}  // namespace slipscale
