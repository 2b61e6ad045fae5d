#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "slipscale/base/state_group.hpp"

namespace slipscale {

/// Checksums of what a file holds so far, in the form that a checkpoint keeps: numbers of 64 bits as two of
/// 32, which doubles hold exactly.
class ContentMarks {
 public:
  explicit ContentMarks(std::string name) : name_(std::move(name)) {}

  /// To be written, of the rank that keeps them.
  StateGroup state(const std::vector<std::uint64_t>& contents, bool keeps);
  /// To be filled in.
  StateGroup state(std::size_t count, bool keeps) { return state(std::vector<std::uint64_t>(count), keeps); }
  std::vector<std::uint64_t> contents() const;

 private:
  std::string name_;
  std::vector<double> halves_;  ///< high and low, in turn
};

}  // namespace slipscale
