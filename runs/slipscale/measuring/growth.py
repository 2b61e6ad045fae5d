"""Growth and frequency of what vibrates about steady sliding, from the rows of a run.

As long as the same nodes touch and all of them slip, motion is linear: a sum of exponentials exp(pt), whose exponents p
are those of the modes. They are found by a matrix pencil (Y. Hua, T. K. Sarkar, IEEE Trans. Acoust. Speech Signal
Process. 38 (1990) 814) of several signals at once.
"""

from dataclasses import dataclass

import numpy as np

from slipscale.reading import OPEN, SLIP

FEWEST = 24  # rows from which exponents can be told
NODES = 12  # of the contact, whose motion is looked at


@dataclass(frozen=True)
class Exponents:
    """p [k] 1/s of one of each pair, Im p >= 0; size [k], the largest amplitude of any signal at the last row; both
    sorted by size, largest first."""

    p: np.ndarray
    size: np.ndarray

    @property
    def growth_rate(self):
        """1/s."""
        return self.p.real

    @property
    def frequency(self):
        """Hz."""
        return self.p.imag / (2 * np.pi)

    def nearest(self, p):
        """That which lies nearest to an expected one."""
        return self.p[np.abs(self.p - p).argmin()]


def exponents(signals, interval, noise=1e-6):
    """The Exponents of `signals` [n, m], rows `interval` s apart. What is below `noise` of the strongest part is left
    out: 1e-4 or so where motion is only nearly linear, 1e-9 where nothing but rounding disturbs it."""
    rows = len(signals)
    if rows < FEWEST:
        raise ValueError(f"{rows} rows tell no exponents: {FEWEST} are the least")
    # The wider, the more modes are told apart; several signals leave enough lines.
    width = 2 * rows // 3 if signals.shape[1] > 1 else rows // 2
    hankel = np.concatenate([np.lib.stride_tricks.sliding_window_view(signal, width + 1) for signal in signals.T])
    _, strength, span = np.linalg.svd(hankel, full_matrices=False)
    span = span[strength > noise * strength[0]].T
    factor = np.linalg.eigvals(np.linalg.lstsq(span[:-1], span[1:], rcond=None)[0]).astype(complex)
    factor = factor[np.abs(factor) > 1e-6]
    factor = factor[np.abs(np.log(np.abs(factor))) * rows < 200]  # no number of the end or of the start else
    # Amplitudes at the last row, so that what grows does not lose digits; the least ones, so that exponents of rounding, some
    # of them almost alike, do not cancel each other with large ones.
    powers = factor[None, :]**(np.arange(rows)[:, None] - (rows - 1))
    scale = np.linalg.norm(powers, axis=0)
    amplitude = np.linalg.lstsq(powers / scale, signals.astype(complex), rcond=1e-8)[0] / scale[:, None]
    size = np.abs(amplitude).max(axis=1)
    p = np.log(factor) / interval
    kept = p.imag >= 0
    order = np.argsort(-size[kept])
    return Exponents(p[kept][order], size[kept][order])


def linear_stretch(status, fewest=FEWEST):
    """The longest slice of rows of `status` [n, nc] (open, stick or slip) in which it stays the same and nothing sticks;
    None where there are fewer than `fewest`."""
    steady = np.all(status == SLIP, axis=1) | np.all(np.isin(status, (OPEN, SLIP)), axis=1)
    best, start = slice(0, 0), None
    for row in range(len(status) + 1):
        same = row < len(status) and steady[row]
        if start is not None and not (same and np.array_equal(status[row], status[start])):
            if row - start > best.stop - best.start:
                best = slice(start, row)
            start = None
        if same and start is None:
            start = row
    return best if best.stop - best.start >= fewest else None


def even_until(time):
    """How many of the first rows are evenly spaced: the last row of a run may follow sooner."""
    spacing = np.diff(time)
    uneven = np.flatnonzero(np.abs(spacing - spacing[0]) > 1e-6 * spacing[0]) if len(spacing) else []
    return int(uneven[0]) + 1 if len(uneven) else len(time)


def rounding(u, moved):
    """What rounding makes of displacements `u`, relative to the motion `moved` that is told from them; with a margin."""
    return 1e3 * np.finfo(float).eps * np.abs(u).max() / np.abs(moved).max()


def seen(contact, begin=0.0, most=300, noise=None, fewest=FEWEST, margin=0):
    """(Exponents, rows) of the velocities along x of the contact nodes in the longest linear stretch of `contact`
    (slipscale.Run.contact) after `begin` s, of its last `most` rows; None where there is none of `fewest` rows or more; its last `margin`
    rows are left out: before a node is seen to open it may have opened for less than the time between two rows. `noise` as in
    `exponents`; None where nothing but rounding disturbs the motion, which the stretch is chosen for."""
    first, last = int(np.searchsorted(contact.time, begin)), even_until(contact.time)
    stretch = linear_stretch(contact.status[first:last], fewest)
    if stretch is None:
        return None
    stop = stretch.stop - margin
    rows = slice(first + max(stretch.start, stop - most), first + stop)
    closed = np.flatnonzero(contact.status[rows.start] == SLIP)
    chosen = closed[np.linspace(0, len(closed) - 1, min(NODES, len(closed))).astype(int)] if len(closed) else []
    if not len(chosen):
        return None
    # Differences of successive rows: the state about which it vibrates drops out, growth and frequency stay.
    moved = np.diff(contact.u[rows, :, 0][:, chosen], axis=0)
    if len(moved) < FEWEST or not np.abs(moved).max() > 0:
        return None
    interval = (contact.time[rows][-1] - contact.time[rows][0]) / (rows.stop - rows.start - 1)
    if noise is None:
        noise = max(1e-11, rounding(contact.u[rows, :, 0][:, chosen], moved))
    return exponents(moved, interval, noise), rows


if __name__ == "__main__":
    raise SystemExit("slipscale.measuring.growth is a library, no command: slipscale -h lists the commands.")
