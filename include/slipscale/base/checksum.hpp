#pragma once

#include <cstddef>
#include <cstdint>

namespace slipscale {

/// FNV-1a, 64 bit (Fowler, Noll, Vo): enough to tell two files apart, not a defence against anyone.
class Checksum {
 public:
  void add(const void* bytes, std::size_t count) {
    const auto* byte = static_cast<const unsigned char*>(bytes);
    for (std::size_t k = 0; k < count; ++k) hash_ = (hash_ ^ byte[k]) * 1099511628211ull;
  }
  std::uint64_t value() const { return hash_; }

 private:
  std::uint64_t hash_ = 14695981039346656037ull;
};

}  // namespace slipscale
