#include "slipscale/base/finite.hpp"

#include <algorithm>
#include <cmath>

#include "slipscale/base/error.hpp"

namespace slipscale {

void stop_unless_finite(MPI_Comm comm, std::span<const double> values, const std::string& what) {
  const bool fine = std::ranges::all_of(values, [](double value) { return std::isfinite(value); });
  stop_together(comm, fine ? "" : what + " is not finite everywhere, so it is not written");
}

}  // namespace slipscale
