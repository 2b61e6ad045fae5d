"""One run at a glance: phase portrait, friction and its spectrum, contact map, stress, energy.

    PYTHONPATH=runs python3 -m slipscale.pictures.picture out/first picture.png [--window 2.5e-4 4e-4] [--point 0]

Works on a run that is still going. Exits with code 2 and one sentence when there is nothing to plot.
"""

import argparse
import sys

import numpy as np

from slipscale.measuring.window import MICRO, rows_in
from slipscale.pictures import panels
from slipscale.pictures.drawing import plt, write_picture
from slipscale.reading import ContactHistory, Fields, History, Summary, UnreadableRun

FEWEST_ROWS = 32  # in the window: enough for three segments of a spectrum
PERIODS_IN_MAP = 12


def choose_window(time, window):
    """The window asked for, cut to the run; by default the last three eighths of the run."""
    begin, end = window or (time[0] + 0.625 * (time[-1] - time[0]), time[-1])
    begin, end = max(begin, time[0]), min(end, time[-1])
    rows = rows_in(time, (begin, end))
    if rows.stop - rows.start < FEWEST_ROWS:
        raise UnreadableRun(
            f"Only {max(0, rows.stop - rows.start)} rows are recorded between {begin:g} and {end:g} s (the run has "
            f"reached {time[-1]:g} s) and a spectrum needs {FEWEST_ROWS}: choose another window, wait, or lower "
            "history_every.")
    return begin, end


def draw(folder, window=None, point=0):
    """The figure of the run in `folder`; `window` is a pair of times in s. Raises UnreadableRun."""
    history, summary = History(folder), Summary(folder)
    window = choose_window(history.time, window)
    boundary = summary.measured_boundary(history)
    figure, axes = plt.subplots(2, 3, figsize=(16, 10), layout="constrained")
    figure.get_layout_engine().set(w_pad=0.12, h_pad=0.08)

    if 0 <= point < len(history.points):
        panels.phase_portrait(axes[0, 0], figure, history, history.points[point], window,
                              summary.number("surface_speed"))
    else:
        panels.say(axes[0, 0], "(a) Phase portrait",
                   f"There is no probe point {point}: history.h5 has {len(history.points)} (option history_points).")
    panels.friction(axes[0, 1], history, boundary, window, summary.number("friction_coefficient"))
    dominant = panels.friction_spectrum(axes[0, 2], history, boundary, window)
    map_window = (max(window[0], window[1] - PERIODS_IN_MAP / dominant), window[1]) if dominant else window
    try:
        with ContactHistory(folder) as contact:
            panels.status_map(axes[1, 0], contact, map_window)
    except (UnreadableRun, OSError) as error:
        panels.say(axes[1, 0], "(d) State of the contact", str(error))
    try:
        with Fields(folder) as fields:
            panels.stress_field(axes[1, 1], figure, fields)
    except (UnreadableRun, OSError) as error:
        panels.say(axes[1, 1], "(e) Stress", str(error))
    panels.energy_ledger(axes[1, 2], history)
    figure.suptitle(headline(folder, history, summary, boundary, window, dominant), fontsize="large", fontweight="bold")
    return figure


def headline(folder, history, summary, boundary, window, dominant):
    """Two lines: the folder and how far the run got; the numbers a reader compares."""
    rows = rows_in(history.time, window)
    planned, reached = summary.number("time_end"), history.time[-1]
    state = f"{reached * MICRO:.4g} µs"
    if planned is not None and reached < 0.999 * planned:
        state += f" of {planned * MICRO:.4g} µs: still running, or stopped early"
    numbers = [f"mean T / mean N = {history.mean_friction(boundary, rows):.4f}",
               f"mean N = {np.mean(history.boundary[boundary]['normal_force'][rows]) / 1e3:.1f} kN/m"]
    if dominant:
        numbers.append(f"dominant frequency {dominant / 1e3:.1f} kHz")
    shares = [f"{name} {100 * np.mean(history.contact[name][rows]):.0f} %"
              for name in ("stick", "slip", "open") if name in history.contact]
    if shares:
        numbers.append(", ".join(shares))
    residual = panels.relative_residual(history)
    if residual is not None:
        numbers.append(f"energy residual {residual:.0e}")
    return f"{folder}: {state}\n" + "   |   ".join(numbers)


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", help="output folder of a slide run")
    parser.add_argument("--window", nargs=2, type=float, metavar=("BEGIN", "END"),
                        help="times [s] for means and spectra (default: the last three eighths of the run)")
    parser.add_argument("--point", type=int, default=0, help="probe point of the phase portrait (default 0)")
    return write_picture(parser, lambda options: draw(options.folder, options.window, options.point), arguments)


if __name__ == "__main__":
    sys.exit(main())
