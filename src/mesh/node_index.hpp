#pragma once

#include <optional>
#include <utility>
#include <vector>

namespace slipscale::mesh_stages {

/// Where a node of a tag stands in the file. Tags that lie close together, wherever they begin, are looked up
/// in a table, others in a sorted list.
class NodeIndex {
 public:
  void reserve(long count) { tags_.reserve(static_cast<std::size_t>(count)); }
  void add(long tag) { tags_.push_back(tag); }
  /// To be called once, when all are added. Returns a tag that was added twice.
  std::optional<long> settle();
  int find(long tag) const;  ///< -1 when there is none

 private:
  std::vector<long> tags_;
  long least_ = 0;
  std::vector<int> table_;                    ///< by tag from the least on
  std::vector<std::pair<long, int>> sorted_;  ///< where there is no table
};

}  // namespace slipscale::mesh_stages
