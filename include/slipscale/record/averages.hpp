#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace slipscale {

/// A mean over a window of time, and its standard error; NaN where the window holds too few rows for one.
struct Average {
  double value = 0, error = 0;
};

/// Blocks into which the window is cut for standard errors.
constexpr int error_blocks = 10;

/// The first row of the window over which a run is averaged by default: the first at or after the middle of
/// the run's time, so that the window is its second half. One rule for summary, pictures and tables. `times`
/// ascending, s.
std::size_t default_window(std::span<const double> times);

/// The mean of evenly spaced rows. Its standard error comes from the scatter of the means of 10 blocks and of
/// 5, whichever is larger: rows are correlated, blocks that are longer than the correlation are not (H.
/// Flyvbjerg, H. G. Petersen, J. Chem. Phys. 91 (1989) 461). A block has two rows at least.
Average mean_of(std::span<const double> rows);

/// Mean of `top` over mean of `bottom`, never the mean of the ratio, which runs away when the body lifts off;
/// the error is that of the mean of top − value · bottom, over the mean of bottom. NaN where that is zero.
Average ratio_of_means(std::span<const double> top, std::span<const double> bottom);

/// Whether a signal goes on as it began: its window's second half against the first.
struct Settling {
  double drift = 0;            ///< difference of the halves' means, of the mean; 0 for a mean of zero
  double amplitude_ratio = 1;  ///< standard deviation of the second half over that of the first
  bool settled = true;
};

/// Settled: the means of the halves differ by less than 1 % of the mean or by less than three standard errors
/// of their difference, and the standard deviations by less than a quarter, where they are above 1 % of the
/// mean. An amplitude that grows by more than a half is not settled however small it is, for an instability
/// begins so; below 1e-10 of the mean it is rounding.
Settling settling(std::span<const double> signal);

/// What the contact does over time, after Peillex, Baillet, Berthier (IJTC2007-44438): "slip" or
/// "stick-slip", with "-separated" where it opens as well; a state counts from 1 % of length and time on.
/// "steady" where nothing vibrates: friction varies by less than 1 % of its mean, and less than 1 % of the
/// drive power goes into the body. (A wave that runs around a periodic strip hardly moves the mean friction,
/// but takes power.) "open" where the body does not touch at all.
std::string regime(double stick, double open, double amplitude, double friction, double power_ratio);

/// Standard deviation over the rows.
double deviation_of(std::span<const double> rows);

}  // namespace slipscale
