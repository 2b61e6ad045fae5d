#include "slipscale/base/error.hpp"

#include <gtest/gtest.h>

#include "slipscale/base/parallel.hpp"
#include "slipscale/base/petsc.hpp"

using namespace slipscale;

namespace {

std::string failure_of(const auto& action) {
  try {
    action();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST(Petsc, SuccessIsSilent) { EXPECT_NO_THROW(petsc(0)); }

TEST(Petsc, FailureCarriesItsMessageAndThePlaceOfTheCall) {
  keep_petsc_messages();
  const std::string what = failure_of([] { petsc(PetscOptionsPrefixPop(nullptr)); });
  ASSERT_EQ(PetscPopErrorHandler(), 0);
  EXPECT_NE(what.find("More prefixes popped than pushed"), std::string::npos) << what;
  EXPECT_NE(what.find("PetscOptionsPrefixPop() at "), std::string::npos) << what;
  EXPECT_NE(what.find("base/error.cpp:"), std::string::npos) << what;
  EXPECT_EQ(take_petsc_message(), "");
}

TEST(Petsc, FailureWithoutMessageIsNamedByItsCode) {
  EXPECT_THROW(petsc(PETSC_ERR_FILE_OPEN), LibraryError);
  const std::string what = failure_of([] { petsc(PETSC_ERR_FILE_OPEN); });
  EXPECT_NE(what.find("Unable to open file"), std::string::npos) << what;
}

TEST(Petsc, MessageIsTakenOnce) {
  keep_petsc_messages();
  EXPECT_NE(PetscOptionsPrefixPop(nullptr), 0);
  ASSERT_EQ(PetscPopErrorHandler(), 0);
  EXPECT_NE(take_petsc_message(), "");
  EXPECT_EQ(take_petsc_message(), "");
}

TEST(ThrowTogether, NoFaultIsNoError) { EXPECT_NO_THROW(throw_together(MPI_COMM_WORLD, "")); }

TEST(ThrowTogether, EveryRankThrowsTheTextOfTheLowest) {
  const int size = ranks_of(MPI_COMM_WORLD);
  for (int first = 0; first < size; ++first) {
    const std::string fault =
        rank_of(MPI_COMM_WORLD) >= first ? "found by " + std::to_string(rank_of(MPI_COMM_WORLD)) : "";
    EXPECT_THROW(throw_together(MPI_COMM_WORLD, fault), UserError);
    EXPECT_EQ(failure_of([&] { throw_together(MPI_COMM_WORLD, fault); }),
              "found by " + std::to_string(first));
  }
}

TEST(ThrowTogether, TextsMayBeLong) {
  const std::string fault(100000, is_root(MPI_COMM_WORLD) ? 'a' : 'b');
  EXPECT_EQ(failure_of([&] { throw_together(MPI_COMM_WORLD, fault); }), std::string(100000, 'a'));
}

TEST(Owned, FreesMovesAndReplaces) {
  OwnedVec x;
  EXPECT_EQ(x.get(), nullptr);
  petsc(VecCreateSeq(PETSC_COMM_SELF, 3, x.put()));
  PetscObject watched = reinterpret_cast<PetscObject>(x.get());
  petsc(PetscObjectReference(watched));
  OwnedVec y = std::move(x);
  EXPECT_EQ(x.get(), nullptr);
  PetscInt references = 0;
  petsc(PetscObjectGetReference(watched, &references));
  EXPECT_EQ(references, 2);
  petsc(VecCreateSeq(PETSC_COMM_SELF, 4, y.put()));
  petsc(PetscObjectGetReference(watched, &references));
  EXPECT_EQ(references, 1);
  petsc(PetscObjectDereference(watched));
}
