"""Draws what is missed over the height of the microstructure, a panel for each quantity.

    python3 -m strip.picture TABLE.csv PICTURE.png

A line for each regime joins the medians over morphologies; dots are the morphologies.
"""

import sys

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from slipscale.parser import Parser
from slipscale.pictures.colours import BLUE, GREEN, ORANGE
from slipscale.pictures.drawing import write_picture
from slipscale.running.table import read_csv

PANELS = {"friction_off": "friction T / N, difference [1]", "frequency_off": "dominant frequency, difference [%]",
          "spectrum_distance": "spectrum of friction, distance [1]",
          "mean_stress_distance": "σ_yy near the contact, time mean, distance [1]",
          "deviation_distance": "its deviation over time, distance [1]", "amplitude_off": "amplitude of friction, difference [%]"}
PERCENT = {"frequency_off": 100, "amplitude_off": 100}
SERIES = ((BLUE, "o"), (GREEN, "s"), (ORANGE, "^"))
SMALLEST = 1e-4


def heights_of(rows):
    return sorted({row["height"] for row in rows})


def values(rows, height, name):
    return [max(SMALLEST, PERCENT.get(name, 1) * abs(row[name])) for row in rows
            if row["height"] == height and row[name] is not None]


def draw(rows):
    rows = [row for row in rows if row["status"] == "ok" and row["mesh"] == "grid"]
    whole = max(heights_of(rows))
    rows = [row for row in rows if row["height"] < whole]
    figure, panels = plt.subplots(2, 3, figsize=(13, 7.5), layout="constrained", sharex=True)
    for axes, (name, label) in zip(panels.flat, PANELS.items()):
        for shift, (colour, marker), regime in zip((-0.07, 0, 0.07), SERIES, dict.fromkeys(row["regime"] for row in rows)):
            own = [row for row in rows if row["regime"] == regime]
            heights = [height for height in heights_of(own) if values(own, height, name)]
            for height in heights:
                found = values(own, height, name)
                axes.plot([height + shift] * len(found), found, marker, color=colour, alpha=0.35, markersize=4,
                          markeredgewidth=0)
            axes.plot([height + shift for height in heights], [np.median(values(own, height, name)) for height in heights],
                      f"{marker}-", color=colour, label=regime)
        axes.set(ylabel=label, yscale="log")
        axes.yaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
        axes.yaxis.set_minor_formatter(NullFormatter())
        axes.yaxis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
        axes.grid(alpha=0.25)
    for axes in panels[-1]:
        axes.set_xlabel(f"height of the microstructure [mm], of {whole:g}")
    figure.get_layout_engine().set(rect=(0, 0, 1, 0.95))
    figure.legend(*panels[0, 0].get_legend_handles_labels(), loc="upper center", ncols=len(SERIES), frameon=False)
    return figure


def main(arguments=None):
    parser = Parser("strip.picture", __doc__, "python3 -m")
    parser.add_argument("table", help="table.csv of the study")
    return write_picture(parser, lambda options: draw(read_csv(options.table)), arguments)


if __name__ == "__main__":
    sys.exit(main())
