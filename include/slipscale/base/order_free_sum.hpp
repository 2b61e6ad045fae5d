#pragma once

#include <mpi.h>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace slipscale {

/// Sums that do not depend on the order of their terms, and so not on how these are spread over ranks: every
/// term is cut, at places that the largest of all terms fixes, into three parts of so few bits that the sum
/// of each part is exact (J. Demmel, H. D. Nguyen, "Parallel reproducible summation", IEEE Trans. Comput. 64
/// (2015) 2060, with one more part where terms are so many that two do not reach far). What lies below the
/// last, 60 bits under the largest term at least, is left out.
using CutSum = std::array<double, 3>;

/// The largest size among the terms; infinite when one of them is not finite.
double largest_size(std::span<const double> terms);

/// Sums of the three parts of each term. `largest`: of all terms of all ranks; `count`: not less than their
/// number.
CutSum cut_sum(std::span<const double> terms, double largest, std::int64_t count);

/// The sum of each list over all ranks, the same on all of them; NaN where a term is not finite, or so large
/// that a sum of as many could not be. `count`: not
/// less than the number of terms of any list on all ranks together, the same on any number of ranks.
/// Collective.
std::vector<double> order_free_sums(MPI_Comm comm, const std::vector<std::span<const double>>& lists,
                                    std::int64_t count);

}  // namespace slipscale
