"""Means over a window with their standard errors, and whether a run had settled in it: the rules of summary.yaml.

Signals are rows [n], evenly spaced in time. include/slipscale/record/averages.hpp is the same in C++; a picture, a
table and the summary of one run over one window say the same.
"""

from dataclasses import dataclass

import numpy as np

BLOCKS = 10  # into which the window is cut for standard errors
COUNTS = 0.01  # of the mean: drifts and amplitudes below it are none
SAME_AMPLITUDE = 1.25
GROWTH = 1.5  # of an amplitude from half to half, beyond chance and beating
ROUNDING_OF_SUMS = 1e-10  # of the mean: forces are sums over nodes, steps over steps
ERRORS_OF_DOUBT = 3


def block_error(rows, count):
    """From the means of `count` blocks at the end of the rows; nan where a block would have fewer than two rows."""
    length = len(rows) // count
    if length < 2:
        return np.nan
    means = np.reshape(rows[len(rows) - count * length:], (count, length)).mean(axis=1)
    return float(np.std(means, ddof=1) / np.sqrt(count))


def error_of_mean(rows):
    """The larger of those from 10 and from 5 blocks: rows are correlated, blocks that are longer than the correlation
    are not (H. Flyvbjerg, H. G. Petersen, J. Chem. Phys. 91 (1989) 461)."""
    found = [error for error in (block_error(rows, BLOCKS), block_error(rows, BLOCKS // 2)) if np.isfinite(error)]
    return max(found, default=np.nan)


def mean_of(rows):
    """A pair: the mean and its standard error."""
    return float(np.mean(rows)), error_of_mean(rows)


def ratio_of_means(top, bottom):
    """A pair: mean of `top` over mean of `bottom`, never the mean of the ratio, which runs away when the body lifts
    off; and the error of the mean of top - ratio bottom, over the mean of bottom. nan where that is zero."""
    below = np.mean(bottom)
    if below == 0:
        return np.nan, np.nan
    ratio = np.mean(top) / below
    return float(ratio), error_of_mean(top - ratio * bottom) / abs(below)


def with_error(value, error):
    """A mean and its error as text, both to the second digit of the error."""
    if not np.isfinite(error):
        return f"{value:.4g}, of too few rows for an error"
    if error == 0 or error < 1e-6 * abs(value):
        return f"{value:.6g}"
    digits = max(0, 1 - int(np.floor(np.log10(error))))
    return f"{value:.{digits}f} ± {error:.{digits}f}"


@dataclass
class Settling:
    """`drift`, difference of the means of the window's halves, of the mean; `amplitude_ratio`, standard deviation of
    the second half over that of the first; `settled`, whether both are as if nothing changed."""

    drift: float
    amplitude_ratio: float
    settled: bool


def settling(rows):
    """Settled: the means of the halves differ by less than 1 % of the mean or by less than three standard errors of
    their difference, and the standard deviations by less than a quarter, where they are above 1 % of the mean. An
    amplitude that grows by more than a half is not settled however small it is, for an instability begins so; below
    1e-10 of the mean it is rounding."""
    half = len(rows) // 2
    first, second = rows[:half], rows[len(rows) - half:]
    mean, step = np.mean(rows), np.mean(second) - np.mean(first)
    before, after = np.std(first), np.std(second)
    doubt = ERRORS_OF_DOUBT * np.hypot(error_of_mean(first), error_of_mean(second))
    same_mean = abs(step) <= COUNTS * abs(mean) or abs(step) <= doubt
    vibrates = max(before, after) > COUNTS * abs(mean)
    same_size = max(before, after) <= SAME_AMPLITUDE * min(before, after)
    grows = after > GROWTH * before and after > ROUNDING_OF_SUMS * abs(mean)
    return Settling(float(step / abs(mean)) if mean != 0 else 0.0, float(after / before) if before > 0 else 1.0,
                    bool(same_mean and not grows and (not vibrates or same_size)))


if __name__ == "__main__":
    raise SystemExit("slipscale.measuring.averages is a library, no command: slipscale -h lists the commands.")
