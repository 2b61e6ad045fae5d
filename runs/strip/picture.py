"""Draws what is missed over the height of the microstructure, a panel for each quantity.

    python3 -m strip.picture TABLE.csv PICTURE.png

A line for each regime joins the medians over morphologies, broken and hollow on graded meshes; dots are the
morphologies of the grids. Dotted: what whole composites of other seeds differ by, the median of all pairs.
"""

import sys
from itertools import combinations

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from slipscale.parser import Parser
from slipscale.pictures.colours import BLUE, GREEN, ORANGE
from slipscale.pictures.drawing import write_picture
from slipscale.running.table import read_csv

PANELS = {"friction_off": "friction T / N, difference", "frequency_off": "dominant frequency, difference [%]",
          "spectrum_distance": "spectrum of friction, distance",
          "mean_stress_distance": "σ_yy near the contact, mean: distance",
          "deviation_distance": "its deviation over time: distance",
          "amplitude_off": "amplitude of friction, difference [%]"}
PERCENT = {"frequency_off": 100, "amplitude_off": 100}
SERIES = ((BLUE, "o"), (GREEN, "s"), (ORANGE, "^"))
SEEDS = {"friction_off": ("friction", False), "frequency_off": ("frequency", True), "amplitude_off": ("amplitude", True)}
MAIN = "grid"  # the mesh whose morphologies are drawn one by one
SMALLEST = 1e-4


def heights_of(rows):
    return sorted({row["height"] for row in rows})


def values(rows, height, name):
    return [max(SMALLEST, PERCENT.get(name, 1) * abs(row[name])) for row in rows
            if row["height"] == height and row[name] is not None]


def seeds_apart(whole, name):
    """The median of what two whole composites differ by, in the unit of a panel; None where it has no such value."""
    if name not in SEEDS or len(whole) < 2:
        return None
    column, relative = SEEDS[name]
    pairs = combinations([row[column] for row in whole], 2)
    return PERCENT.get(name, 1) * float(np.median([abs(one - other) / (other if relative else 1) for one, other in pairs]))


def draw(rows):
    rows = [row for row in rows if row["status"] == "ok"]
    heights = heights_of(rows)
    figure, panels = plt.subplots(2, 3, figsize=(13, 7.5), layout="constrained", sharex=True)
    for axes, (name, label) in zip(panels.flat, PANELS.items()):
        for shift, (colour, marker), regime in zip((-0.07, 0, 0.07), SERIES, dict.fromkeys(row["regime"] for row in rows)):
            for mesh in dict.fromkeys(row["mesh"] for row in rows if row["regime"] == regime):
                own = [row for row in rows if (row["regime"], row["mesh"]) == (regime, mesh)]
                at = [height for height in heights[:-1] if values(own, height, name)]
                found = [values(own, height, name) for height in at]
                for height, of in zip(at, found) if mesh == MAIN else ():
                    axes.plot([height + shift] * len(of), of, marker, color=colour, alpha=0.35, markersize=4,
                              markeredgewidth=0)
                if at:
                    axes.plot([height + shift for height in at], [np.median(of) for of in found], marker, color=colour,
                              linestyle="-" if mesh == MAIN else "--", markerfacecolor=colour if mesh == MAIN else "white",
                              label=f"{regime}, {mesh}")
                apart = seeds_apart([row for row in own if row["height"] == heights[-1]], name) if mesh == MAIN else None
                if apart:
                    axes.axhline(apart, color=colour, linestyle=":", linewidth=1, label=f"{regime}: other seeds")
        axes.set(ylabel=label, yscale="log", xticks=heights[:-1])
        axes.yaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
        axes.yaxis.set_minor_formatter(NullFormatter())
        axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
        axes.grid(alpha=0.25)
    for axes in panels[-1]:
        axes.set_xlabel(f"height of the microstructure [mm], of {heights[-1]:g}")
    figure.get_layout_engine().set(rect=(0, 0, 1, 0.92))
    named = {label: handle for axes in panels.flat for handle, label in zip(*axes.get_legend_handles_labels())}
    figure.legend(named.values(), named.keys(), loc="upper center", ncols=4, frameon=False)
    return figure


def main(arguments=None):
    parser = Parser("strip.picture", __doc__, "python3 -m")
    parser.add_argument("table", help="table.csv of the study")
    return write_picture(parser, lambda options: draw(read_csv(options.table)), arguments)


if __name__ == "__main__":
    sys.exit(main())
