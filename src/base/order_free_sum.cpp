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
constexpr int reach = 60;               ///< how many bits below the largest term count

/// Compiled for several vector instructions, of which the program takes the widest there are; sums that are
/// free of order have the same bits with all. Not beside a sanitizer, which starts after the choice is made.
#if defined(__x86_64__) && defined(__linux__) && !defined(__SANITIZE_ADDRESS__)
#define SLIPSCALE_CLONES __attribute__((target_clones("default", "avx2", "avx512f")))
#else
#define SLIPSCALE_CLONES
#endif

/// Terms that are taken side by side: the vector type of GCC and Clang.
using Side = double __attribute__((vector_size(64)));
constexpr std::size_t lanes = sizeof(Side) / sizeof(double);

/// Sums of the first two parts of terms, a multiple of `lanes`, into the lanes of `sums`.
SLIPSCALE_CLONES void add_two_parts(const double* terms, std::size_t count, const double* cut, Side* sums) {
  Side high = sums[0], middle = sums[1];
  const double first_cut = cut[0], second_cut = cut[1];
  for (std::size_t k = 0; k < count; k += lanes) {
    Side rest;
    std::memcpy(&rest, terms + k, sizeof rest);
    const Side first = (rest + first_cut) - first_cut;
    high += first;
    rest -= first;
    middle += (rest + second_cut) - second_cut;
  }
  sums[0] = high, sums[1] = middle;
}

/// The same of all three parts.
SLIPSCALE_CLONES void add_parts(const double* terms, std::size_t count, const double* cut, Side* sums) {
  Side high = sums[0], middle = sums[1], low = sums[2];
  const double first_cut = cut[0], second_cut = cut[1], third_cut = cut[2];
  for (std::size_t k = 0; k < count; k += lanes) {
    Side rest;
    std::memcpy(&rest, terms + k, sizeof rest);
    const Side first = (rest + first_cut) - first_cut;
    high += first;
    rest -= first;
    const Side second = (rest + second_cut) - second_cut;
    middle += second;
    rest -= second;
    low += (rest + third_cut) - third_cut;
  }
  sums[0] = high, sums[1] = middle, sums[2] = low;
}

/// Largest sizes of terms, a multiple of `lanes`, lane by lane; `faults` becomes NaN where one is not finite.
SLIPSCALE_CLONES void find_largest(const double* terms, std::size_t count, Side* largest, Side* faults) {
  Side sizes = *largest, not_finite = *faults;
  for (std::size_t k = 0; k < count; k += lanes) {
    Side term;
    std::memcpy(&term, terms + k, sizeof term);
    const Side size = term < 0 ? -term : term;
    sizes = size > sizes ? size : sizes;
    not_finite += size - size;  // 0, or NaN where the term is not finite
  }
  *largest = sizes, *faults = not_finite;
}

/// The terms behind the last whole side, filled up with zeros.
std::array<double, lanes> rest_of(std::span<const double> terms, std::size_t whole) {
  std::array<double, lanes> rest{};
  std::copy(terms.begin() + static_cast<std::ptrdiff_t>(whole), terms.end(), rest.begin());
  return rest;
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

/// Whether the first two parts reach far enough below the largest term: of no more than 4 million terms.
bool two_are_enough(std::int64_t count) { return 2 * (bits - room_for(count)) >= reach; }

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
  Side largest{}, faults{};
  const std::size_t whole = terms.size() / lanes * lanes;
  find_largest(terms.data(), whole, &largest, &faults);
  find_largest(rest_of(terms, whole).data(), lanes, &largest, &faults);
  double found = 0;
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    if (std::isnan(faults[lane])) return std::numeric_limits<double>::infinity();
    found = std::max(found, largest[lane]);
  }
  return found;
}

CutSum cut_sum(std::span<const double> terms, double largest, std::int64_t count) {
  if (largest == 0) return {};
  const CutSum cut = cuts(largest, count);
  Side sums[3] = {};
  const std::size_t whole = terms.size() / lanes * lanes;
  const auto add = two_are_enough(count) ? add_two_parts : add_parts;
  add(terms.data(), whole, cut.data(), sums);
  add(rest_of(terms, whole).data(), lanes, cut.data(), sums);
  CutSum total{};
  for (std::size_t part = 0; part < total.size(); ++part)
    for (std::size_t lane = 0; lane < lanes; ++lane) total[part] += sums[part][lane];
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
