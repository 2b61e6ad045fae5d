#include "slipscale/base/order_free_sum.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace slipscale {
namespace {

constexpr std::size_t lanes = 8;       ///< terms that are taken side by side, for the compiler to vectorise
constexpr int bits = 53;               ///< of a double
constexpr int largest_exponent = 900;  ///< terms beyond it have no room for the cuts

/// Adding and taking away these numbers rounds a term to a multiple of their last bit.
CutSum cuts(double largest, std::int64_t count) {
  const int room = static_cast<int>(std::bit_width(static_cast<std::uint64_t>(count))) + 1;
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
  std::array<double, lanes> largest{};
  bool finite = true;
  const std::size_t whole = terms.size() / lanes * lanes;
  for (std::size_t k = 0; k < whole; k += lanes)
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const double size = std::abs(terms[k + lane]);
      finite &= size <= std::numeric_limits<double>::max();
      largest[lane] = size > largest[lane] ? size : largest[lane];
    }
  for (std::size_t k = whole; k < terms.size(); ++k) {
    finite &= std::isfinite(terms[k]);
    largest[0] = std::max(largest[0], std::abs(terms[k]));
  }
  if (!finite) return std::numeric_limits<double>::infinity();
  double all = 0;
  for (const double each : largest) all = std::max(all, each);
  return all;
}

CutSum cut_sum(std::span<const double> terms, double largest, std::int64_t count) {
  if (largest == 0) return {};
  const CutSum cut = cuts(largest, count);
  std::array<std::array<double, lanes>, 3> sums{};
  const auto add = [&](double rest, std::size_t lane) {
    for (std::size_t part = 0; part < cut.size(); ++part) {
      const double rounded = (rest + cut[part]) - cut[part];
      sums[part][lane] += rounded;
      rest -= rounded;
    }
  };
  const std::size_t whole = terms.size() / lanes * lanes;
  for (std::size_t k = 0; k < whole; k += lanes)
    for (std::size_t lane = 0; lane < lanes; ++lane) add(terms[k + lane], lane);
  for (std::size_t k = whole; k < terms.size(); ++k) add(terms[k], k - whole);
  CutSum total{};
  for (std::size_t part = 0; part < cut.size(); ++part)
    for (const double sum : sums[part]) total[part] += sum;
  return total;
}

std::vector<double> order_free_sums(MPI_Comm comm, const std::vector<std::span<const double>>& lists,
                                    std::int64_t count) {
  std::vector<double> largest;
  for (const auto& terms : lists) largest.push_back(largest_size(terms));
  MPI_Allreduce(MPI_IN_PLACE, largest.data(), static_cast<int>(largest.size()), MPI_DOUBLE, MPI_MAX, comm);
  std::vector<CutSum> parts(lists.size());
  for (std::size_t k = 0; k < lists.size(); ++k)
    if (largest[k] < std::ldexp(1.0, largest_exponent)) parts[k] = cut_sum(lists[k], largest[k], count);
  MPI_Allreduce(MPI_IN_PLACE, parts.data(), static_cast<int>(3 * parts.size()), MPI_DOUBLE, MPI_SUM, comm);
  std::vector<double> sums;
  for (std::size_t k = 0; k < lists.size(); ++k)
    sums.push_back(largest[k] < std::ldexp(1.0, largest_exponent) ? parts[k][0] + (parts[k][1] + parts[k][2])
                                                                  : std::numeric_limits<double>::quiet_NaN());
  return sums;
}

}  // namespace slipscale
