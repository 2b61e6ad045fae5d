#include "slipscale/files/collect_rows.hpp"

#include <algorithm>
#include <vector>

#include "slipscale/base/parallel.hpp"

namespace slipscale {
namespace {

constexpr std::size_t piece_bytes = 8 << 20;
constexpr int tag = 7;

/// Calls `visit(first row, rows)` for each piece of a range.
template <class Visit>
void for_pieces(const RowRange& range, Visit visit) {
  const std::uint64_t most = std::max<std::uint64_t>(1, piece_bytes / std::max<std::size_t>(range.bytes, 1));
  for (std::uint64_t done = 0; done < range.count; done += most)
    visit(range.begin + done, std::min(most, range.count - done));
}

}  // namespace

void collect_rows(MPI_Comm comm, const RowRange& mine, const void* rows,
                  const std::function<void(std::uint64_t, std::uint64_t, const void*)>& take) {
  const int ranks = ranks_of(comm);
  const std::uint64_t bounds[2] = {mine.begin, mine.count};
  std::vector<std::uint64_t> all(2 * static_cast<std::size_t>(ranks));
  MPI_Gather(bounds, 2, MPI_UINT64_T, all.data(), 2, MPI_UINT64_T, 0, comm);
  const auto* const bytes = static_cast<const std::byte*>(rows);
  if (!is_root(comm)) {
    for_pieces(mine, [&](std::uint64_t begin, std::uint64_t count) {
      MPI_Send(bytes + (begin - mine.begin) * mine.bytes, static_cast<int>(count * mine.bytes), MPI_BYTE, 0,
               tag, comm);
    });
    return;
  }
  if (mine.count > 0) take(mine.begin, mine.count, rows);
  std::vector<std::byte> piece;
  for (int rank = 1; rank < ranks; ++rank)
    for_pieces(
        {all[2 * static_cast<std::size_t>(rank)], all[2 * static_cast<std::size_t>(rank) + 1], mine.bytes},
        [&](std::uint64_t begin, std::uint64_t count) {
          piece.resize(count * mine.bytes);
          MPI_Recv(piece.data(), static_cast<int>(piece.size()), MPI_BYTE, rank, tag, comm,
                   MPI_STATUS_IGNORE);
          take(begin, count, piece.data());
        });
}

}  // namespace slipscale
