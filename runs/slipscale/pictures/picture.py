"""One run at a glance: phase portrait, friction and its spectrum, contact map, stress, energy.

    slipscale picture out/first picture.png [--window 2.5e-4 4e-4] [--point 0]

Works on a run that is still going. Exits with code 2 and one sentence when there is nothing to plot.
"""

import textwrap

import numpy as np

from slipscale.measuring.averages import mean_of, ratio_of_means, settling, with_error
from slipscale.measuring.regime import friction_signal, measures
from slipscale.measuring.window import choose_window, cut_away, how_far, rows_in
from slipscale.parser import Parser, Window
from slipscale.pictures import panels
from slipscale.pictures.drawing import plt, shown, write_picture
from slipscale.reading import ContactHistory, Fields, History, Summary, UnreadableRun

PERIODS_IN_MAP = 12
LONGEST = 140  # characters of a line above the panels


def draw(folder, window=None, point=0):
    """The figure of the run in `folder`; `window` is a pair of times in s. Raises UnreadableRun."""
    history, summary = History(folder), Summary(folder)
    beyond = cut_away(history.time, window) if window else ""
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
    figure.suptitle(headline(folder, history, summary, boundary, window, dominant, beyond), fontsize="large", fontweight="bold")
    return figure


def headline(folder, history, summary, boundary, window, dominant, beyond=""):
    """A few lines: the folder and how far the run got; the numbers a reader compares; what is `beyond` what was
    recorded."""
    rows = rows_in(history.time, window)
    normal, tangential = (history.boundary[boundary][f"{force}_force"][rows] for force in ("normal", "tangential"))
    numbers = [f"mean T / mean N = {with_error(*ratio_of_means(tangential, normal))}"
               if np.mean(normal) > 0 else "no load",
               f"mean N = {with_error(*(part / 1e3 for part in mean_of(normal)))} kN/m",
               "settled" if settling(friction_signal(history, boundary, rows)).settled else "NOT SETTLED"]
    if dominant:
        numbers.append(f"dominant frequency {dominant / 1e3:.1f} kHz")
    shares = [f"{name} {with_error(*(100 * part for part in mean_of(history.contact[name][rows])))} %"
              for name in ("stick", "slip", "open") if name in history.contact]
    if shares:
        numbers.append(f"{measures(folder, window)['regime']}: " + ", ".join(shares))
    residual = panels.relative_residual(history)
    if residual is not None:
        numbers.append(f"energy residual {residual:.0e}")
    lines = [f"{shown(folder)}: {how_far(summary, history.time[-1])}", *joined(numbers), *([beyond] if beyond else [])]
    if dominant is not None and (doubt := summary.headline.get("aliases")):
        lines += textwrap.wrap(str(doubt), LONGEST)[:2]
    return "\n".join(lines)


def joined(parts):
    """Parts in as few lines as they fit into, none of them broken."""
    lines = []
    for part in parts:
        longer = f"{lines[-1]}   |   {part}" if lines else part
        lines[-1:] = [longer] if len(longer) <= LONGEST or not lines else [lines[-1], part]
    return lines


def main(arguments=None):
    parser = Parser("picture", __doc__)
    parser.add_argument("folder", help="output folder of a slide run")
    parser.add_argument("--window", action=Window, metavar=("BEGIN", "END"),
                        help="times [s] for means and spectra (default: the second half of the run)")
    parser.add_argument("--point", type=int, default=0, help="probe point of the phase portrait (default 0)")
    return write_picture(parser, lambda options: draw(options.folder, options.window, options.point), arguments)
