#include <gtest/gtest.h>
#include <petscsys.h>

#include "block_mesh.hpp"
#include "slipscale/base/parallel.hpp"

/// Runs the tests of one executable on every rank; only rank 0 prints, unless another rank fails.
int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  MPI_Init(&argc, &argv);
  if (PetscInitialize(&argc, &argv, nullptr, nullptr)) return 1;
  const int rank = slipscale::rank_of(MPI_COMM_WORLD);
  auto& listeners = testing::UnitTest::GetInstance()->listeners();
  class Quiet : public testing::EmptyTestEventListener {
    void OnTestPartResult(const testing::TestPartResult& result) override {
      if (result.failed())
        std::fprintf(stderr, "%s:%d: %s\n", result.file_name() ? result.file_name() : "?",
                     result.line_number(), result.message());
    }
  };
  if (rank != 0) {
    delete listeners.Release(listeners.default_result_printer());
    listeners.Append(new Quiet);
  }
  int failed = RUN_ALL_TESTS();
  if (testing::UnitTest::GetInstance()->test_to_run_count() == 0) failed = 1;  // nothing run is no success
  MPI_Allreduce(MPI_IN_PLACE, &failed, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  if (failed == 0) slipscale::testing_support::remove_scratch();
  if (PetscFinalize()) failed = 1;
  MPI_Finalize();
  return failed;
}
