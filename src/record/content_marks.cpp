#include "slipscale/record/content_marks.hpp"

#include <numeric>

namespace slipscale {

StateGroup ContentMarks::state(const std::vector<std::uint64_t>& contents, bool keeps) {
  halves_.clear();
  for (const std::uint64_t sum : contents) {
    halves_.push_back(static_cast<double>(sum >> 32));
    halves_.push_back(static_cast<double>(sum & 0xffffffff));
  }
  StateGroup group{name_, std::vector<PetscInt>(contents.size()), 0, keeps, {}};
  std::iota(group.keys.begin(), group.keys.end(), 0);
  group.arrays = {
      {"checksum", "1", "of what the file holds, its high and its low 32 bits", 2, halves_.data()}};
  return group;
}

std::vector<std::uint64_t> ContentMarks::contents() const {
  std::vector<std::uint64_t> sums;
  for (std::size_t k = 0; k + 1 < halves_.size(); k += 2)
    sums.push_back(static_cast<std::uint64_t>(halves_[k]) << 32 | static_cast<std::uint64_t>(halves_[k + 1]));
  return sums;
}

}  // namespace slipscale
