#pragma once

#include "slipscale/base/options.hpp"

/// Ranges of quantities whose squares and products are formed: beyond 1e100, which no quantity in SI units
/// reaches, they would leave double precision and stop a run far from the option that is at fault.
namespace slipscale::range {

extern const Range physical, physical_positive, physical_non_negative;

}  // namespace slipscale::range
