#include "row_terms.hpp"

#include <algorithm>
#include <bit>
#include <numeric>

namespace slipscale {

RowTerms::RowTerms(const AssembledPairs& pairs)
    : pairs_(pairs), row_of_(pairs.node.size()), low_first_(pairs.node.size() + 1, 0) {
  for (const int high : pairs.high) ++low_first_[high + 1];
  std::partial_sum(low_first_.begin(), low_first_.end(), low_first_.begin());
  low_pair_.resize(pairs.high.size());
  low_node_.resize(pairs.high.size());
  std::vector<int> next(low_first_.begin(), low_first_.end() - 1);
  for (int row = 0; row < pairs.rows(); ++row) {
    row_of_[pairs.node[row]] = row;
    for (int pair = pairs.first[row]; pair < pairs.first[row + 1]; ++pair) {
      const int place = next[pairs.high[pair]]++;
      low_pair_[place] = pair;
      low_node_[place] = pairs.node[row];
    }
  }
}

void RowTerms::of(int node, std::vector<Term>& terms) const {
  terms.clear();
  const auto straight = [&](const auto& block, int other) {
    terms.push_back({Lanes{block.xx, block.yy}, Lanes{block.xy, block.xy}, other - node});
  };
  for (int k = low_first_[node]; k < low_first_[node + 1]; ++k) {
    const auto& block = pairs_.block[low_pair_[k]];
    straight(block, low_node_[k]);
    if (block.skew != 0) terms.push_back({Lanes{}, Lanes{-block.skew, block.skew}, low_node_[k] - node});
  }
  const int begin = pairs_.first[row_of_[node]], end = pairs_.first[row_of_[node] + 1];
  for (int pair = begin; pair < end; ++pair) straight(pairs_.block[pair], pairs_.high[pair]);
  for (int pair = begin; pair < end; ++pair) {
    const double skew = pairs_.block[pair].skew;
    if (skew != 0) terms.push_back({Lanes{}, Lanes{skew, -skew}, pairs_.high[pair] - node});
  }
}

namespace {

std::uint64_t digest(const std::vector<Term>& terms) {
  std::uint64_t h = terms.size();
  const auto mix = [&](std::uint64_t x) { h = (std::rotl(h, 23) ^ x) * 0x9e3779b97f4a7c15ull; };
  for (const Term& term : terms) {
    mix(static_cast<std::uint64_t>(term.offset));
    for (int k = 0; k < 2; ++k) {
      mix(std::bit_cast<std::uint64_t>(double{term.straight[k]}));
      mix(std::bit_cast<std::uint64_t>(double{term.crossed[k]}));
    }
  }
  return h ^ (h >> 32);
}

}  // namespace

std::pair<int, int> TermLists::place(const std::vector<Term>& terms) {
  const auto [found, is_new] = known_.try_emplace(digest(terms));
  const auto [first, last] = found->second;
  if (!is_new && std::equal(terms.begin(), terms.end(), all_.begin() + first, all_.begin() + last))
    return found->second;
  const auto begin = static_cast<int>(all_.size());
  all_.insert(all_.end(), terms.begin(), terms.end());
  return found->second = {begin, static_cast<int>(all_.size())};
}

}  // namespace slipscale
