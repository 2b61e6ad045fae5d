#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "assembled_pairs.hpp"
#include "slipscale/solid/repeated_rows.hpp"

namespace slipscale {

/// The whole row of a node, as terms in the order in which the visit of all pairs adds to the force on it:
/// those of lower neighbours, the skew part of each behind its symmetric part, then the symmetric parts of
/// all higher neighbours, then their skew parts.
class RowTerms {
 public:
  explicit RowTerms(const AssembledPairs& pairs);

  /// Of a local node, into `terms`.
  void of(int node, std::vector<Term>& terms) const;

 private:
  const AssembledPairs& pairs_;
  std::vector<int> row_of_;     ///< by local node
  std::vector<int> low_first_;  ///< by local node: where its pairs with lower nodes start in the next two
  std::vector<int> low_pair_, low_node_;
};

/// Keeps every list of terms once.
class TermLists {
 public:
  /// Where these terms stand in `all`, {first, last}.
  std::pair<int, int> place(const std::vector<Term>& terms);
  std::vector<Term> take() { return std::move(all_); }

 private:
  std::vector<Term> all_;
  std::unordered_map<std::uint64_t, std::pair<int, int>> known_;
};

}  // namespace slipscale
