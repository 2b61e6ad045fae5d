"""Windows of time: pairs of times in s over which means and spectra are taken."""

import numpy as np

MICRO = 1e6


def rows_in(time, window):
    """The rows whose time lies in the window, as a slice."""
    return slice(*np.searchsorted(time, [window[0], window[1] * (1 + 1e-9)]))


def in_words(window):
    return f"{window[0] * MICRO:.0f}–{window[1] * MICRO:.0f} µs"
