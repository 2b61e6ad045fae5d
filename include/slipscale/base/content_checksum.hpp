#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

namespace slipscale {

/// Tells whether bytes are what they were, however they are handed over: one call or many give the same
/// value. Eight bytes at a time, at some GB/s, so that what is written can carry it along. Not a defence
/// against anyone.
class ContentChecksum {
 public:
  void add(const void* bytes, std::size_t count) {
    const auto* byte = static_cast<const unsigned char*>(bytes);
    length_ += count;
    for (; waiting_ > 0 && count > 0; --count) keep(*byte++);
    for (; count >= sizeof word_; count -= sizeof word_, byte += sizeof word_) {
      std::uint64_t word = 0;
      std::memcpy(&word, byte, sizeof word);
      mix(hash_, word);
    }
    for (; count > 0; --count) keep(*byte++);
  }

  std::uint64_t value() const {
    std::uint64_t sum = hash_;
    mix(sum, word_);
    mix(sum, length_);
    return sum ^ (sum >> 32);
  }

 private:
  void keep(unsigned char byte) {
    word_ |= static_cast<std::uint64_t>(byte) << (8 * waiting_);
    if (++waiting_ < sizeof word_) return;
    mix(hash_, word_);
    word_ = waiting_ = 0;
  }
  /// For one `sum` every word has a result of its own: both steps have an inverse.
  static void mix(std::uint64_t& sum, std::uint64_t word) {
    sum = (sum ^ word) * 0x9e3779b97f4a7c15ull;
    sum ^= sum >> 29;
  }

  std::uint64_t hash_ = 0x51ed270b4d1f5e2bull, word_ = 0, waiting_ = 0, length_ = 0;
};

}  // namespace slipscale
