#include "slipscale/base/finite.hpp"

#include <algorithm>
#include <cmath>

#include "slipscale/base/error.hpp"

namespace slipscale {

namespace {

std::string fault_of(std::span<const double> values, const std::string& what) {
  const bool fine = std::ranges::all_of(values, [](double value) { return std::isfinite(value); });
  return fine ? "" : what + " is not finite everywhere, so it is not written";
}

}  // namespace

void stop_unless_finite(MPI_Comm comm, std::span<const double> values, const std::string& what) {
  stop_together(comm, fault_of(values, what));
}

void refuse_unless_finite(MPI_Comm comm, std::span<const double> values, const std::string& what,
                          const std::string& cure) {
  const std::string fault = fault_of(values, what);
  throw_together(comm, fault.empty() ? "" : fault + "; " + cure);
}

}  // namespace slipscale
