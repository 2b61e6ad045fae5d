#pragma once

#include <mpi.h>

#include <span>
#include <string>

namespace slipscale {

/// Before numbers are written: throws RunError on all ranks when one of them, on any rank, is not finite.
/// `what` they are, "the relocalised stress". Collective.
void stop_unless_finite(MPI_Comm comm, std::span<const double> values, const std::string& what);
/// Likewise where the numbers come from input that is sound one by one but too large together: throws
/// UserError, with what mends it.
void refuse_unless_finite(MPI_Comm comm, std::span<const double> values, const std::string& what,
                          const std::string& cure);

}  // namespace slipscale
