#include "slipscale/base/order_free_sum.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>

#include "slipscale/base/parallel.hpp"

using namespace slipscale;

namespace {

/// Of very different sizes and both signs.
std::vector<double> terms(std::size_t count, double decades) {
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> sign(-1, 1), size(-decades, 0);
  std::vector<double> found;
  for (std::size_t k = 0; k < count; ++k) found.push_back(sign(random) * std::pow(10, size(random)));
  return found;
}

double sum_on_ranks(std::vector<double> all, std::int64_t count) {
  const RankShare share = rank_share(all.size(), rank_of(MPI_COMM_WORLD), ranks_of(MPI_COMM_WORLD));
  return order_free_sums(MPI_COMM_WORLD, {std::span(all).subspan(share.begin, share.count())}, count)[0];
}

}  // namespace

/// The same bits however the terms are ordered, cut into pieces and counted on several ranks, and those of
/// long double arithmetic to what it leaves out.
TEST(OrderFreeSum, HasTheSameBitsInEveryOrder) {
  for (const double decades : {0.0, 3.0, 20.0}) {
    std::vector<double> all = terms(5003, decades);
    const auto count = static_cast<std::int64_t>(all.size());
    const double largest = largest_size(all);
    const CutSum whole = cut_sum(all, largest, count);
    const double value = whole[0] + (whole[1] + whole[2]);
    EXPECT_EQ(sum_on_ranks(all, count), value);
    std::mt19937_64 random(11);
    for (int repeat = 0; repeat < 20; ++repeat) {
      std::shuffle(all.begin(), all.end(), random);
      EXPECT_EQ(cut_sum(all, largest, count), whole);
      EXPECT_EQ(sum_on_ranks(all, count), value);
    }
    const long double exact = std::accumulate(all.begin(), all.end(), 0.0L);
    EXPECT_NEAR(value, static_cast<double>(exact), std::ldexp(largest, -50));
  }
}

/// Of more terms than two parts are enough for; here those that are not zero lie on few places.
TEST(OrderFreeSum, HasThreePartsWhereTermsAreMany) {
  std::vector<double> all = terms(5003, 8);
  const double largest = largest_size(all);
  const long double exact = std::accumulate(all.begin(), all.end(), 0.0L);
  for (const std::int64_t count : {std::int64_t{1} << 21, std::int64_t{1} << 23, std::int64_t{1} << 34}) {
    const CutSum whole = cut_sum(all, largest, count);
    EXPECT_EQ(whole[2] != 0, count > std::int64_t{1} << 22);
    EXPECT_NEAR(whole[0] + (whole[1] + whole[2]), static_cast<double>(exact), std::ldexp(largest, -45));
    std::reverse(all.begin(), all.end());
    EXPECT_EQ(cut_sum(all, largest, count), whole);
    EXPECT_EQ(sum_on_ranks(all, count), whole[0] + (whole[1] + whole[2]));
  }
}

TEST(OrderFreeSum, KeepsWhatCancels) {
  EXPECT_EQ(sum_on_ranks({1e16, 1, -1e16, 2}, 4), 3);
  EXPECT_NEAR(sum_on_ranks({1, 1e-17, -1}, 3), 1e-17, std::ldexp(1, -99));  // two parts of 50 bits
}

TEST(OrderFreeSum, OfNothingAndOfLittle) {
  EXPECT_EQ(sum_on_ranks({}, 10), 0);
  EXPECT_EQ(sum_on_ranks({0, 0}, 2), 0);
  EXPECT_EQ(sum_on_ranks({5e-324, 5e-324}, 2), 1e-323);
}

TEST(OrderFreeSum, SaysWhereATermIsNotFinite) {
  EXPECT_TRUE(std::isnan(sum_on_ranks({1, std::nan(""), 2}, 3)));
  EXPECT_TRUE(std::isnan(sum_on_ranks({1, INFINITY, 2}, 3)));
  std::vector<double> many(100, 1.0);
  for (const std::size_t at : {0u, 41u, 99u}) {
    std::vector<double> one_bad = many;
    one_bad[at] = std::nan("");
    EXPECT_TRUE(std::isinf(largest_size(one_bad)));
  }
}
