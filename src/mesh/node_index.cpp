#include "node_index.hpp"

#include <algorithm>

namespace slipscale::mesh_stages {

std::optional<long> NodeIndex::settle() {
  if (tags_.empty()) return std::nullopt;
  const std::vector<long> tags = std::move(tags_);
  tags_ = {};
  const auto [least, largest] = std::ranges::minmax_element(tags);
  least_ = *least;
  const auto range = static_cast<unsigned long>(*largest) - static_cast<unsigned long>(*least);
  if (range / 4 <= tags.size()) {
    table_.assign(range + 1, -1);
    for (std::size_t k = 0; k < tags.size(); ++k) {
      int& place = table_[tags[k] - least_];
      if (place >= 0) return tags[k];
      place = static_cast<int>(k);
    }
    return std::nullopt;
  }
  for (std::size_t k = 0; k < tags.size(); ++k) sorted_.emplace_back(tags[k], static_cast<int>(k));
  std::ranges::sort(sorted_);
  const auto twice =
      std::ranges::adjacent_find(sorted_, [](const auto& a, const auto& b) { return a.first == b.first; });
  return twice == sorted_.end() ? std::nullopt : std::optional(twice->first);
}

int NodeIndex::find(long tag) const {
  if (!table_.empty())
    return tag < least_ ||
                   static_cast<unsigned long>(tag) - static_cast<unsigned long>(least_) >= table_.size()
               ? -1
               : table_[tag - least_];
  const auto found = std::ranges::lower_bound(sorted_, tag, {}, &std::pair<long, int>::first);
  return found == sorted_.end() || found->first != tag ? -1 : found->second;
}

}  // namespace slipscale::mesh_stages
