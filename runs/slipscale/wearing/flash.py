"""Flash temperature: how much hotter than before the surface of a half-space is under the recorded heat.

One-dimensional at each node, along the depth: T(t) = ∫ q(t') / √(π k ρ c (t − t')) dt' (Carslaw and Jaeger, Conduction of
Heat in Solids, 2nd ed., 2.9), with the part of the friction heat that goes into the body. Between two rows q is their mean
heat, which the sums over every step give exactly, and is integrated exactly, so that a constant q makes 2 q √(t/(π k ρ c))
at every row. Heat that flows along the surface and into the counter-body is left out, and so are peaks shorter than the
distance of two rows, which are smeared over it.
"""

import math

import numpy as np

AT_ONCE = 2000  # rows whose weights are held together


def effusivity(conductivity, density, capacity):
    """√(k ρ c), W √s/(m² K)."""
    return np.sqrt(conductivity * density * capacity)


def temperature(time, heat, effusive):
    """Rise of temperature at each row, [n, nc] K. time [n] s, ascending; heat [n, nc] J/m² into the body since the first
    row; effusive [nc] or a number."""
    if len(time) < 2:
        return np.zeros_like(heat)
    flux = np.diff(heat, axis=0) / np.diff(time)[:, None]
    rise = np.zeros_like(heat, dtype=float)
    if _even(time):
        rise[1:] = _convolved(time, flux)
    else:
        for first in range(1, len(time), AT_ONCE):
            rows = slice(first, min(first + AT_ONCE, len(time)))
            since = np.sqrt(np.maximum(time[rows, None] - time[None, :rows.stop], 0))
            rise[rows] = (since[:, :-1] - since[:, 1:]) @ flux[:rows.stop - 1]
    return rise * (2 / math.sqrt(math.pi)) / effusive


def _even(time):
    step = np.diff(time)
    return len(time) > AT_ONCE and np.ptp(step) <= 1e-9 * step.mean()


def _convolved(time, flux):
    """The same sums where rows are evenly spaced, by Fourier transforms."""
    rows = len(flux)
    root = np.sqrt((time[-1] - time[0]) / rows * np.arange(rows + 1))
    size = 2 ** math.ceil(math.log2(2 * rows))
    kernel = np.fft.rfft(np.diff(root), size)
    return np.fft.irfft(np.fft.rfft(flux, size, axis=0) * kernel[:, None], size, axis=0)[:rows]


if __name__ == "__main__":
    raise SystemExit("slipscale.wearing.flash is a library, no command: slipscale -h lists the commands.")
