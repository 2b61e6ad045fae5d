#pragma once

#include <charconv>
#include <cmath>
#include <stdexcept>
#include <string>
#include <string_view>

namespace slipscale::mesh_stages {

/// What is wrong with a gmsh file, to be put behind its name.
struct GmshFault : std::runtime_error {
  using std::runtime_error::runtime_error;
};

inline const std::string write_again = "write it again with gmsh -2 -format msh41";

/// The numbers of one section of a gmsh file, one after the other.
class GmshNumbers {
 public:
  GmshNumbers(std::string name, std::string_view text)
      : name_(std::move(name)), next_(text.data()), end_(next_ + text.size()) {}

  template <class Number = long>
  Number next() {
    while (next_ != end_ && (*next_ == ' ' || *next_ == '\n' || *next_ == '\r' || *next_ == '\t')) ++next_;
    Number value{};
    const auto [stop, code] = std::from_chars(next_, end_, value);
    if (next_ == end_) fail("holds fewer entries than it announces");
    if (code != std::errc{}) fail("holds something that is not a number");
    next_ = stop;
    return value;
  }

  /// A count of things that take at least two characters each.
  long count() {
    const long value = next();
    if (value < 0 || value > end_ - next_) fail("announces more than it can hold");
    return value;
  }

  double real() {
    const double value = next<double>();
    if (!std::isfinite(value)) fail("holds something that is not a number");
    return value;
  }

  void skip_reals(long count) {
    for (long k = 0; k < count; ++k) real();
  }

  [[noreturn]] void fail(const std::string& what) const {
    throw GmshFault("is damaged: $" + name_ + " " + what + "; " + write_again);
  }

 private:
  std::string name_;
  const char *next_, *end_;
};

}  // namespace slipscale::mesh_stages
