"""Windows of time: pairs of times in s over which means and spectra are taken."""

import numpy as np

from slipscale.reading.files import UnreadableRun

MICRO = 1e6
FEWEST_ROWS = 32  # in a window: enough for three segments of a spectrum


def rows_in(time, window):
    """The rows whose time lies in the window, as a slice."""
    return slice(*np.searchsorted(time, [window[0], window[1] * (1 + 1e-9)]))


def in_words(window):
    return f"{window[0] * MICRO:.0f}–{window[1] * MICRO:.0f} µs"


def default_window(time):
    """The second half of a run whose rows have these times: the one rule for summary.yaml, pictures, tables, sweeps and
    adaptations, where nothing else is asked for."""
    return 0.5 * (time[0] + time[-1]), time[-1]


def choose_window(time, window=None):
    """The window asked for, cut to the run, or else the default. Raises UnreadableRun when it has too few rows."""
    begin, end = window or default_window(time)
    begin, end = max(begin, time[0]), min(end, time[-1])
    rows = rows_in(time, (begin, end))
    if rows.stop - rows.start < FEWEST_ROWS:
        raise UnreadableRun(
            f"Only {max(0, rows.stop - rows.start)} rows are recorded between {begin:g} and {end:g} s (the run has "
            f"reached {time[-1]:g} s) and a spectrum needs {FEWEST_ROWS}: choose another window, wait, or lower "
            "history_every.")
    return begin, end
