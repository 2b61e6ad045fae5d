#pragma once

#include <cstdint>
#include <random>

namespace slipscale {

/// `x` rounded to a multiple of 2^-40: what follows no longer depends on the last bits, which differ between
/// mathematical libraries.
double quantised(double x);

/// Random numbers that are the same on every machine: the standard fixes the engine's bits, and the
/// distributions here, which the standard leaves open, are quantised.
class Random {
 public:
  explicit Random(std::uint64_t seed) : engine_(seed) {}
  double uniform();  ///< 0 <= x < 1
  double normal();   ///< mean 0, deviation 1

 private:
  std::mt19937_64 engine_;
};

}  // namespace slipscale
