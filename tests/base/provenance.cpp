#include "slipscale/base/provenance.hpp"

#include <gtest/gtest.h>
#include <mpi.h>

#include <regex>

#include "slipscale/base/parallel.hpp"
#include "slipscale/version.hpp"

using namespace slipscale;

TEST(Provenance, SaysWhoWroteAndWhen) {
  EXPECT_EQ(provenance().program, "slipscale");
  EXPECT_EQ(provenance().commit, "");
  set_program("slide", "0123456789ab-dirty");
  const Provenance told = provenance();
  EXPECT_EQ(told.program, "slide");
  EXPECT_EQ(told.version, version);
  EXPECT_EQ(told.commit, "0123456789ab-dirty");
  EXPECT_EQ(told.ranks, ranks_of(MPI_COMM_WORLD));
  EXPECT_TRUE(
      std::regex_match(told.date, std::regex("20\\d\\d-[01]\\d-[0-3]\\dT[0-2]\\d:[0-5]\\d:[0-6]\\dZ")))
      << told.date;
  EXPECT_EQ(told.date, provenance().date);
}
