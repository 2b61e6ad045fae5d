#include "slipscale/files/file_order.hpp"

#include <gtest/gtest.h>

#include "slipscale/base/parallel.hpp"

using namespace slipscale;

namespace {

/// Row numbers dealt to the ranks like cards, from the last to the first.
std::vector<PetscInt> dealt(PetscInt total) {
  const int rank = rank_of(PETSC_COMM_WORLD), ranks = ranks_of(PETSC_COMM_WORLD);
  std::vector<PetscInt> numbers;
  for (PetscInt row = total - 1; row >= 0; --row)
    if (row % ranks == rank) numbers.push_back(row);
  return numbers;
}

}  // namespace

TEST(FileOrder, SlicesAreContiguousAndInOrder) {
  for (PetscInt total : {0, 1, 2, 1000}) {
    const auto numbers = dealt(total);
    const FileOrder order(PETSC_COMM_WORLD, total, numbers);
    std::vector<double> rows;
    std::vector<PetscInt> integers;
    for (PetscInt number : numbers) {
      rows.insert(rows.end(), {number + 0.25, number + 0.5, number + 0.75});
      integers.push_back(7 * number);
    }
    const auto slice = order.to_file(rows.data(), 3);
    ASSERT_EQ(slice.size(), 3u * order.count());
    for (PetscInt k = 0; k < order.count(); ++k)
      for (int c = 0; c < 3; ++c) EXPECT_EQ(slice[3 * k + c], order.begin() + k + 0.25 * (c + 1));
    const auto numbers_slice = order.to_file(integers.data(), 1);
    for (PetscInt k = 0; k < order.count(); ++k) EXPECT_EQ(numbers_slice[k], 7 * (order.begin() + k));
    PetscInt sum = order.count();
    MPI_Allreduce(MPI_IN_PLACE, &sum, 1, MPIU_INT, MPI_SUM, PETSC_COMM_WORLD);
    EXPECT_EQ(sum, total);
  }
}

TEST(FileOrder, RowsComeBackFromTheFileGhostsIncluded) {
  const PetscInt total = 100;
  auto numbers = dealt(total);
  const FileOrder owned(PETSC_COMM_WORLD, total, numbers);
  std::vector<double> rows;
  for (PetscInt number : numbers) rows.insert(rows.end(), {1.0 * number, -1.0 * number});
  const auto slice = owned.to_file(rows.data(), 2);

  for (PetscInt ghost : {0, 50, 99}) numbers.push_back(ghost);
  const FileOrder with_ghosts(PETSC_COMM_WORLD, total, numbers);
  const auto back = with_ghosts.from_file(slice.data(), 2);
  ASSERT_EQ(back.size(), 2 * numbers.size());
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    EXPECT_EQ(back[2 * k], 1.0 * numbers[k]);
    EXPECT_EQ(back[2 * k + 1], -1.0 * numbers[k]);
  }
}
