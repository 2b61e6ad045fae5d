"""Work-precision diagrams of a table of the study: error over cost, a panel for each case and error, the Pareto front drawn
through the runs that none beats. Errors below their own scatter over time count as that there; dissipation and height
of the block make another scene and are no part of it.

    python3 -m tradeoff.picture out/tradeoff/table.csv front.png [--x seconds] [--y friction_off,frequency_off,spectrum_off]

Any column can be an axis: seconds, node_steps, memory, disk; NAME_off of friction, frequency, amplitude, stick, open,
velocity, displacement, normal_force, stress_matrix, stress_inclusion, spectrum.
"""

import sys

from matplotlib.ticker import FuncFormatter

from slipscale.mistakes import Mistake
from slipscale.parser import Parser
from slipscale.pictures.colours import BLACK, BLUE, GREEN, ORANGE, PURPLE, SKY, VERMILION
from slipscale.pictures.drawing import few_ticks, plt, write_picture
from slipscale.running.table import read_csv
from tradeoff.front import front, size_of

# Told apart by form as well as by colour; no two have both in common.
KNOBS = {"cells": ("kind of cells", BLUE, "o"), "sizes": ("size of cells", ORANGE, "s"),
         "steps": ("part of the stable step", GREEN, "^"), "together": ("cells, size and step together", SKY, "d"),
         "beta2": ("beta2 of the scheme", VERMILION, "v"), "damping": ("damping", PURPLE, "D"),
         "storage": ("single or double storage", SKY, "P"), "cadence": ("rows of the history", BLACK, "x"),
         "homogeneous": ("homogenised block", VERMILION, "*"), "relocalised": ("… and relocalised", VERMILION, "X"),
         "strip": ("strip of microstructure", GREEN, "h"), "heights": ("height of the block", PURPLE, "<")}
OTHER_SCENES = ("beta2", "damping", "heights")  # they change what is simulated, not how well
COSTS = {"seconds": "seconds of one core", "node_steps": "node-steps", "memory": "peak memory [MB]", "disk": "disk [MB]"}
FACTORS = {"memory": 1e-6, "disk": 1e-6}
ERRORS = {"friction": "friction T / N", "frequency": "dominant frequency", "amplitude": "amplitude of friction",
          "stick": "sticking part", "open": "open part", "velocity": "rms velocity of the contact",
          "displacement": "rms displacement of the contact", "normal_force": "normal force",
          "stress_matrix": "99 % of the matrix's stress", "stress_inclusion": "99 % of the inclusions' stress"}
PERCENT = 100
SMALLEST = 1e-3  # of errors that are drawn, %
LEGEND = 0.9  # inches above the panels


def kind_of(row):
    """The knob that a run stands for in the picture: that of the models is three."""
    if row["knob"] != "models":
        return row["knob"]
    return next((kind for kind in ("homogeneous", "relocalised", "strip") if row["model"].startswith(kind)), None)


def words_of(error):
    """Of an axis."""
    name = error.removesuffix("_off")
    return "spectrum: distance [%]" if name == "spectrum" else f"{ERRORS.get(name, name)}: error [%]"


def sizes(rows, error):
    return [max(SMALLEST, PERCENT * abs(row[error])) for row in rows]


def panel(axes, rows, cost, error):
    rows = [{**row, cost: FACTORS.get(cost, 1) * row[cost]} for row in rows if row.get(error) is not None]
    for kind, (label, colour, marker) in KNOBS.items():
        if of := [row for row in rows if kind_of(row) == kind]:
            axes.plot([row[cost] for row in of], sizes(of, error), marker, color=colour, markersize=6, label=label,
                      markeredgecolor="white" if marker not in "x" else colour, markeredgewidth=0.4)
    bar = error.replace("_off", "_bar")
    best = front([row for row in rows if row["knob"] not in OTHER_SCENES], cost, error, bar)
    axes.step([row[cost] for row in best], [max(SMALLEST, PERCENT * size_of(row, error, bar)) for row in best], "-",
              where="post", color=BLACK, linewidth=1, zorder=1, label="none is better and cheaper")
    axes.set(xscale="log", yscale="log")
    bars = sorted(row[bar] for row in rows)
    if bars:
        axes.axhspan(SMALLEST / 10, max(SMALLEST, PERCENT * bars[len(bars) // 2]), color=BLACK, alpha=0.08, linewidth=0,
                     zorder=0, label="less than the scatter over time (median)")
        axes.set_ylim(bottom=0.5 * min(sizes(rows, error)))
    axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
    axes.grid(True, which="major", alpha=0.3)
    few_ticks(axes.xaxis)
    axes.xaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))


def draw(rows, cost, errors):
    rows = [row for row in rows if row["status"] == "ok" and (row["knob"] in KNOBS or row["knob"] == "models")]
    for name in (cost, *errors):
        if not any(row.get(name) is not None for row in rows):
            raise Mistake(f"The table has no column {name} with a number in it.")
    cases = list(dict.fromkeys(row["case"] for row in rows))
    height = 3.1 * len(errors) + LEGEND
    figure, axes = plt.subplots(len(errors), len(cases), figsize=(3.7 * len(cases), height), squeeze=False,
                                layout="constrained")
    figure.get_layout_engine().set(rect=(0, 0, 1, 1 - LEGEND / height))
    for line, error in zip(axes, errors):
        for one, case in zip(line, cases):
            panel(one, [row for row in rows if row["case"] == case], cost, error)
        line[0].set_ylabel(words_of(error))
    for one, case in zip(axes[0], cases):
        one.set_title(case)
    for one in axes[-1]:
        one.set_xlabel(COSTS.get(cost, cost))
    named = {label: handle for one in axes.flat for handle, label in zip(*one.get_legend_handles_labels())}
    order = [*(label for label, *_ in KNOBS.values() if label in named),
             *(label for label in named if label not in [words for words, *_ in KNOBS.values()])]
    figure.legend([named[label] for label in order], order, loc="upper center", ncols=min(5, 1 + len(cases)), fontsize=9,
                  frameon=False)
    return figure


def main(arguments=None):
    parser = Parser("tradeoff.picture", __doc__, "python3 -m")
    parser.add_argument("table", help="table.csv of the study")
    parser.add_argument("--x", default="seconds", help="column of costs")
    parser.add_argument("--y", default="friction_off,frequency_off,spectrum_off", help="columns of errors")
    return write_picture(parser, lambda asked: draw(read_csv(asked.table), asked.x, asked.y.split(",")), arguments)


if __name__ == "__main__":
    sys.exit(main())
