#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

#include "slipscale/base/large_array.hpp"
#include "slipscale/solid/repeated_rows.hpp"

namespace slipscale {

/// Makes quartets, and keeps what they share once.
class Quartets {
 public:
  /// `count` nodes are in the arrays.
  explicit Quartets(int count) : count_(count) {}

  /// Of the nodes from `begin` on, whose terms these are. None where the terms of two of them cannot be added
  /// in one order: where a neighbour is a ghost, which lies behind whatever its number; nor where one would
  /// look beyond the arrays for a neighbour that only another has.
  std::optional<Quartet> make(int begin, const std::array<std::vector<Term>, 4>& terms);

  LargeArray<Link> links;
  LargeArray<double> values;

 private:
  int place(const std::vector<double>& blocks);

  int count_;
  struct Kept {
    int first, last;
  };
  std::unordered_map<std::uint64_t, Kept> known_;        ///< lists of links, by their digest
  std::unordered_map<std::uint64_t, int> known_blocks_;  ///< places, by the digest of what stands there
};

}  // namespace slipscale
