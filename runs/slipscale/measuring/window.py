"""Windows of time: pairs of times in s over which means and spectra are taken."""

import numpy as np

from slipscale.reading.files import UnreadableRun

MICRO = 1e6
FEWEST_ROWS = 32  # in a window: enough for three segments of a spectrum
FEWEST_FOR_MEANS = 2


def rows_in(time, window):
    """The rows whose time lies in the window, as a slice."""
    return slice(*np.searchsorted(time, [window[0], window[1] * (1 + 1e-9)]))


def in_words(window):
    return f"{window[0] * MICRO:.0f}–{window[1] * MICRO:.0f} µs"


def default_window(time):
    """The second half of a run whose rows have these times: the one rule for summary.yaml, pictures, tables, sweeps and
    adaptations, where nothing else is asked for."""
    return 0.5 * (time[0] + time[-1]), time[-1]


def too_few(time, window, fewest=FEWEST_ROWS):
    """What is said of a window with fewer rows than that."""
    rows = rows_in(time, window)
    what = "a spectrum needs" if fewest >= FEWEST_ROWS else "means need"
    return (f"Only {max(0, rows.stop - rows.start)} rows are recorded between {window[0]:g} and {window[1]:g} s (the "
            f"run has reached {time[-1]:g} s) and {what} {fewest}: choose another window, let the run go on, or lower "
            "history_every.")


def choose_window(time, window=None, fewest=FEWEST_ROWS):
    """The window asked for, cut to the run, or else the default. Raises UnreadableRun when it has fewer rows than
    `fewest`."""
    begin, end = window or default_window(time)
    begin, end = max(begin, time[0]), min(end, time[-1])
    rows = rows_in(time, (begin, end))
    if rows.stop - rows.start < fewest:
        raise UnreadableRun(too_few(time, (begin, end), fewest))
    return begin, end
