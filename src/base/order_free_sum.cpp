#include "slipscale/base/order_free_sum.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>

namespace slipscale {
namespace {

constexpr int bits = 53;                ///< of a double
constexpr int largest_exponent = 1022;  ///< of a cut

/// Terms that are taken side by side: the vector type of GCC and Clang.
using Side = double __attribute__((vector_size(32)));
constexpr std::size_t lanes = sizeof(Side) / sizeof(double);

/// All terms, the last ones filled up with zeros.
template <class Action>
void for_sides(std::span<const double> terms, Action&& action) {
  Side side{};
  const std::size_t whole = terms.size() / lanes * lanes;
  for (std::size_t k = 0; k < whole; k += lanes) {
    std::memcpy(&side, &terms[k], sizeof side);
    action(side);
  }
  side = Side{};
  if (whole < terms.size()) {
    std::memcpy(&side, &terms[whole], (terms.size() - whole) * sizeof(double));
    action(side);
  }
}

/// By how many bits a sum of so many terms may be larger than the largest of them, and one more.
int room_for(std::int64_t count) {
  return static_cast<int>(std::bit_width(static_cast<std::uint64_t>(count))) + 1;
}

/// Whether the cuts are finite.
bool can_be_cut(double largest, std::int64_t count) {
  return std::isfinite(largest) &&
         (largest == 0 || std::ilogb(largest) + 1 + room_for(count) <= largest_exponent);
}

/// Adding and taking away these numbers rounds a term to a multiple of their last bit.
CutSum cuts(double largest, std::int64_t count) {
  const int room = room_for(count);
  int size = std::ilogb(largest) + 1;  // no term reaches 2^size
  CutSum cut{};
  for (double& each : cut) {
    each = std::ldexp(1.5, size + room);
    size += room - bits;  // of what is left
  }
  return cut;
}

}  // namespace

double largest_size(std::span<const double> terms) {
  std::array<double, lanes> largest{}, faults{};
  const auto look = [&](const double* side, std::size_t count) {
    for (std::size_t lane = 0; lane < count; ++lane) {
      const double size = std::abs(side[lane]);
      largest[lane] = size > largest[lane] ? size : largest[lane];
      faults[lane] += size - size;  // 0, or NaN where the term is not finite
    }
  };
  const std::size_t whole = terms.size() / lanes * lanes;
  for (std::size_t k = 0; k < whole; k += lanes) look(&terms[k], lanes);
  if (whole < terms.size()) look(&terms[whole], terms.size() - whole);
  for (const double fault : faults)
    if (std::isnan(fault)) return std::numeric_limits<double>::infinity();
  return *std::max_element(largest.begin(), largest.end());
}

CutSum cut_sum(std::span<const double> terms, double largest, std::int64_t count) {
  if (largest == 0) return {};
  const CutSum cut = cuts(largest, count);
  Side high{}, middle{}, low{};
  for_sides(terms, [&](Side rest) {
    const Side first = (rest + cut[0]) - cut[0];
    high += first;
    rest -= first;
    const Side second = (rest + cut[1]) - cut[1];
    middle += second;
    rest -= second;
    low += (rest + cut[2]) - cut[2];
  });
  CutSum total{};
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    total[0] += high[lane];
    total[1] += middle[lane];
    total[2] += low[lane];
  }
  return total;
}

std::vector<double> order_free_sums(MPI_Comm comm, const std::vector<std::span<const double>>& lists,
                                    std::int64_t count) {
  std::vector<double> largest;
  for (const auto& terms : lists) largest.push_back(largest_size(terms));
  MPI_Allreduce(MPI_IN_PLACE, largest.data(), static_cast<int>(largest.size()), MPI_DOUBLE, MPI_MAX, comm);
  std::vector<CutSum> parts(lists.size());
  for (std::size_t k = 0; k < lists.size(); ++k)
    if (can_be_cut(largest[k], count)) parts[k] = cut_sum(lists[k], largest[k], count);
  MPI_Allreduce(MPI_IN_PLACE, parts.data(), static_cast<int>(3 * parts.size()), MPI_DOUBLE, MPI_SUM, comm);
  std::vector<double> sums;
  for (std::size_t k = 0; k < lists.size(); ++k)
    sums.push_back(can_be_cut(largest[k], count) ? parts[k][0] + (parts[k][1] + parts[k][2])
                                                 : std::numeric_limits<double>::quiet_NaN());
  return sums;
}

}  // namespace slipscale
