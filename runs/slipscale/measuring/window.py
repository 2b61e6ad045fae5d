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


def backwards(window):
    """What is said of a window whose end lies before its beginning (or is no number), or nothing."""
    begin, end = window
    return "" if begin <= end else f"goes from {begin:g} to {end:g} s: give the earlier time first"


def cut_away(time, window):
    """What is said of a window, asked for, that reaches beyond rows of these times by more than one of their distances, or
    nothing."""
    begin, end = window
    row = 1.5 * (time[-1] - time[0]) / max(1, len(time) - 1)
    if begin >= time[0] - row and end <= time[-1] + row:
        return ""
    return (f"the window {begin:g} to {end:g} s reaches beyond what is recorded, {time[0]:g} to {time[-1]:g} s, and is cut "
            "there")


def how_far(summary, reached):
    """How far a run got that has come to `reached` s, by its Summary: "99.95 µs of 400 µs: still running …"."""
    planned, state = summary.number("time_end"), f"{reached * MICRO:.4g} µs"
    if planned is None or reached >= 0.999 * planned:
        return state
    state += f" of {planned * MICRO:.4g} µs: "
    if summary.headline.get("state") == "interrupted":
        return f"{state}interrupted by {summary.headline.get('interrupted_by', 'a signal')}"
    return f"{state}still running, or stopped early"


def unfinished(summary, reached):
    """The same as a clause, of a run that has not come to its end; nothing of others."""
    state = how_far(summary, reached)
    return f"the run has reached {state}" if " of " in state else ""


def too_few(time, window, fewest=FEWEST_ROWS):
    """What is said of a window with fewer rows than that."""
    rows = rows_in(time, window)
    what = "a spectrum needs" if fewest >= FEWEST_ROWS else "means need"
    return (f"Only {max(0, rows.stop - rows.start)} rows are recorded between {window[0]:g} and {window[1]:g} s (the "
            f"run has reached {time[-1]:g} s) and {what} {fewest}: choose another window, let the run go on, or lower "
            "history_every.")


def choose_window(time, window=None, fewest=FEWEST_ROWS):
    """The window asked for, cut to the run (`cut_away` says it), or else the default. Raises UnreadableRun for one that
    runs backwards or has fewer rows than `fewest`."""
    begin, end = window or default_window(time)
    if wrong := backwards((begin, end)):
        raise UnreadableRun(f"The window {wrong}.")
    begin, end = max(begin, time[0]), min(end, time[-1])
    rows = rows_in(time, (begin, end))
    if rows.stop - rows.start < fewest:
        raise UnreadableRun(too_few(time, (begin, end), fewest))
    return begin, end
