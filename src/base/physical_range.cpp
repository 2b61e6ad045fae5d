#include "slipscale/base/physical_range.hpp"

namespace slipscale::range {
namespace {

bool accept_size(double x) { return x > -1e100 && x < 1e100; }
bool accept_positive(double x) { return x > 0 && x < 1e100; }
bool accept_non_negative(double x) { return x >= 0 && x < 1e100; }

}  // namespace

// Initialised by the compiler, so that a schema may be a global of any file; that takes texts of at most 15
// letters.
constinit const Range physical{"|x| < 1e100", accept_size};
constinit const Range physical_positive{"> 0, < 1e100", accept_positive};
constinit const Range physical_non_negative{">= 0, < 1e100", accept_non_negative};

}  // namespace slipscale::range
