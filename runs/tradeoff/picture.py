"""Work-precision diagrams of a table of the study: error over cost, a panel for each case and error, the Pareto front drawn
through the runs that none beats.

    python3 -m tradeoff.picture out/tradeoff/table.csv front.png [--x seconds] [--y friction_off,frequency_off,spectrum_off]

Any column can be an axis: seconds, node_steps, memory, disk; NAME_off of friction, frequency, amplitude, stick, open,
velocity, displacement, normal_force, stress_matrix, stress_inclusion, spectrum.
"""

import sys

from slipscale.mistakes import Mistake
from slipscale.parser import Parser
from slipscale.pictures.colours import BLACK, BLUE, GREEN, ORANGE, PURPLE, SKY, VERMILION
from slipscale.pictures.drawing import few_ticks, plt, write_picture
from slipscale.running.table import read_csv
from tradeoff.front import front

KNOBS = {"cells": (BLUE, "o"), "sizes": (ORANGE, "s"), "steps": (GREEN, "^"), "beta2": (VERMILION, "v"),
         "damping": (PURPLE, "D"), "storage": (SKY, "P"), "cadence": (BLACK, "x"), "models": (VERMILION, "*"),
         "heights": (PURPLE, "<"), "together": (BLACK, ".")}
SMALLEST = 1e-5  # of errors that are drawn


def panel(axes, rows, cost, error, case):
    for knob in dict.fromkeys(row["knob"] for row in rows):
        of = [row for row in rows if row["knob"] == knob and row[error] is not None]
        colour, marker = KNOBS.get(knob, (BLACK, "+"))
        axes.plot([row[cost] for row in of], [max(SMALLEST, abs(row[error])) for row in of], marker, color=colour,
                  label=knob, alpha=0.8)
    best = front(rows, cost, error)
    axes.plot([row[cost] for row in best], [max(SMALLEST, abs(row[error])) for row in best], "-", color=BLACK,
              linewidth=1, label="none better")
    bars = sorted(row[error.replace("_off", "_bar")] for row in rows if row[error] is not None)
    if bars:
        axes.axhline(bars[len(bars) // 2], color=BLACK, linestyle=":", linewidth=1, label="scatter over time")
    axes.set(xscale="log", yscale="log", title=case, xlabel=cost, ylabel=error)
    axes.grid(True, which="major", alpha=0.3)
    few_ticks(axes.xaxis)


def draw(rows, cost, errors):
    rows = [row for row in rows if row["status"] == "ok" and row["knob"] in KNOBS]
    for name in (cost, *errors):
        if not any(row.get(name) is not None for row in rows):
            raise Mistake(f"The table has no column {name} with a number in it.")
    cases = list(dict.fromkeys(row["case"] for row in rows))
    figure, axes = plt.subplots(len(errors), len(cases), figsize=(4.3 * len(cases), 3.6 * len(errors)), squeeze=False,
                                layout="constrained")
    for line, error in zip(axes, errors):
        for one, case in zip(line, cases):
            panel(one, [row for row in rows if row["case"] == case], cost, error, case)
    axes[0, 0].legend(fontsize=7, ncols=2)
    return figure


def main(arguments=None):
    parser = Parser("tradeoff.picture", __doc__, "python3 -m")
    parser.add_argument("table", help="table.csv of the study")
    parser.add_argument("--x", default="seconds", help="column of costs")
    parser.add_argument("--y", default="friction_off,frequency_off,spectrum_off", help="columns of errors")
    return write_picture(parser, lambda asked: draw(read_csv(asked.table), asked.x, asked.y.split(",")), arguments)


if __name__ == "__main__":
    sys.exit(main())
