"""Where a measured quantity reaches a target: a scan, the bracket it leaves, and a refinement of the bracket.

Limit cycles scatter and jump: what is found is judged by how near it came, and how the quantity changed over the scan
is said beside it.
"""

from dataclasses import dataclass

import numpy as np

FLAT = 0.1  # of the target: a quantity that changes less over the scan cannot tell values apart
NOISE = 0.03  # of the range over the scan: changes that do not count against monotony


@dataclass
class Scan:
    """What a scan says about a target: `flat`, `monotone`, `brackets` (pairs of neighbouring values between which it is
    crossed), `lowest` and `highest`, the range of the quantity."""

    flat: bool
    monotone: bool
    brackets: list
    lowest: float
    highest: float


def scan_values(start, factor, points):
    """`points` values around `start` (> 0), each `factor` times the one before: ascending."""
    return [start * factor**k for k in range(-(points // 2), points - points // 2)]


def judge(values, found, target):
    """A Scan of ascending values [n] at which the quantity was `found` [n]; nan where it is not known."""
    known = np.isfinite(found)
    values, found = np.asarray(values)[known], np.asarray(found)[known]
    if len(found) < 2:
        return Scan(True, False, [], *(2 * [float("nan")] if len(found) == 0 else 2 * [float(found[0])]))
    size = np.ptp(found)
    changes = np.diff(found)
    counted = changes[np.abs(changes) > NOISE * size]
    above = found > target
    brackets = [(values[k], values[k + 1]) for k in np.flatnonzero(above[1:] != above[:-1])]
    return Scan(bool(size < FLAT * abs(target)), bool(np.all(counted > 0) or np.all(counted < 0)),
                [tuple(map(float, pair)) for pair in brackets], float(found.min()), float(found.max()))


def refine(evaluate, target, bracket, ends, tolerance, most):
    """Illinois' false position (Dowell and Jarratt, BIT 11 (1971) 168) on the logarithm of the value: the value that
    came nearest to the target. `ends`, the quantity at the bracket's ends; stops within `tolerance` of the target or
    after `most` evaluations; an evaluation that gives None ends it."""
    (low, high), (below, above) = np.log(bracket), np.subtract(ends, target)
    best = min(zip(np.abs([below, above]), bracket))
    last = 0
    for _ in range(most):
        if best[0] <= tolerance * abs(target):
            break
        middle = high - above * (high - low) / (above - below)
        found = evaluate(float(np.exp(middle)))
        if found is None:
            break
        error = found - target
        best = min(best, (abs(error), float(np.exp(middle))))
        if error * above > 0:
            high, above = middle, error
            below *= 0.5 if last > 0 else 1
            last = 1
        else:
            low, below = middle, error
            above *= 0.5 if last < 0 else 1
            last = -1
    return float(best[1])


if __name__ == "__main__":
    raise SystemExit("slipscale.adapting.search is a library, no command: slipscale -h lists the commands.")
