#include "slipscale/base/content_checksum.hpp"

#include <gtest/gtest.h>

#include <set>
#include <vector>

using namespace slipscale;

namespace {

std::uint64_t of(const std::vector<unsigned char>& bytes, std::size_t piece) {
  ContentChecksum sum;
  for (std::size_t at = 0; at < bytes.size(); at += piece)
    sum.add(bytes.data() + at, std::min(piece, bytes.size() - at));
  return sum.value();
}

}  // namespace

TEST(ContentChecksum, DoesNotDependOnThePieces) {
  std::vector<unsigned char> bytes;
  for (int k = 0; k < 1000; ++k) bytes.push_back(static_cast<unsigned char>(k * k % 251));
  for (const std::size_t size : {0u, 1u, 7u, 8u, 9u, 64u, 1000u}) {
    const std::vector<unsigned char> part(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(size));
    const std::uint64_t whole = of(part, std::max<std::size_t>(size, 1));
    for (const std::size_t piece : {1u, 3u, 8u, 11u, 16u})
      EXPECT_EQ(of(part, piece), whole) << size << ' ' << piece;
  }
}

/// Each byte changed in each of its bits, bytes left out and zeros added at the end: all have a value of
/// their own.
TEST(ContentChecksum, TellsAllSmallChangesApart) {
  const std::vector<unsigned char> bytes(48, 0);
  std::set<std::uint64_t> seen{of(bytes, 48)};
  std::size_t count = 1;
  for (std::size_t at = 0; at < bytes.size(); ++at)
    for (int bit = 0; bit < 8; ++bit, ++count) {
      std::vector<unsigned char> changed = bytes;
      changed[at] = static_cast<unsigned char>(1 << bit);
      seen.insert(of(changed, 48));
    }
  for (std::size_t size = 0; size < 100; ++size)
    if (size != 48) seen.insert(of(std::vector<unsigned char>(size, 0), 100)), ++count;
  EXPECT_EQ(seen.size(), count);
}
