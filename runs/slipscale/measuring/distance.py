"""How far two runs are apart: spectra and portraits for cycles, trajectories only before chaos sets in.

A relative distance of √2 is that of unrelated signals of equal strength.
"""

import numpy as np

DIRECTIONS = 32  # over half a circle, for `portrait_distance`
LEVELS = 400  # quantiles compared in each


def relative_l2(values, reference):
    """|values - reference| / |reference| of arrays [n]; nan when the reference is zero."""
    size = np.linalg.norm(reference)
    return float(np.linalg.norm(np.subtract(values, reference)) / size) if size > 0 else float("nan")


def spectrum_distance(spectrum, reference):
    """Relative L2 distance of √density; both are pairs of frequency [n] (Hz) and √density, as of
    `regime.friction_spectrum`; the first is interpolated to the frequencies of the reference."""
    return relative_l2(np.interp(reference[0], *spectrum), reference[1])


def mean_spectrum(spectra):
    """The mean √density of several spectra at the frequencies of the first: a pair."""
    frequency = spectra[0][0]
    return frequency, np.mean([np.interp(frequency, *each) for each in spectra], axis=0)


def portrait_distance(portrait, reference):
    """Sliced Wasserstein distance of two phase portraits, pairs of u [n] and v [n], n may differ.

    Portraits are compared as distributions of points, each coordinate in units of the reference's standard deviation:
    the mean over directions of the mean distance between equal quantiles of the projections (Rabin, Peyré, Delon,
    Bernot, SSVM 2011, LNCS 6667, 435). Two portraits that cover the same region but visit it differently are apart,
    which a distance between nearest points would not see. 1 is a shift by one standard deviation times 2/π.
    """
    middle, spread = np.mean(reference, axis=1, keepdims=True), np.std(reference, axis=1, keepdims=True)
    if not np.all(spread > 0):
        return float("nan")
    levels = (np.arange(LEVELS) + 0.5) / LEVELS
    angles = np.pi * np.arange(DIRECTIONS) / DIRECTIONS
    directions = np.column_stack([np.cos(angles), np.sin(angles)])
    own, other = (np.quantile(directions @ ((np.asarray(each) - middle) / spread), levels, axis=1)
                  for each in (portrait, reference))
    return float(np.mean(np.abs(own - other)))


if __name__ == "__main__":
    raise SystemExit("slipscale.measuring.distance is a library, no command: slipscale -h lists the commands.")
