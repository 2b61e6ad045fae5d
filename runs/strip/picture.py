"""Draws what is missed over the height of the microstructure, a panel for each quantity.

    python3 -m strip.picture TABLE.csv PICTURE.png

A line for each regime joins the medians over morphologies; dots are the morphologies.
"""

import sys

import matplotlib.pyplot as plt
import numpy as np

from slipscale.parser import Parser
from slipscale.pictures.colours import BLUE, GREEN, ORANGE
from slipscale.pictures.drawing import write_picture
from slipscale.running.table import read_csv

PANELS = {"friction_off": "friction T/N off [1]", "frequency_off": "frequency off [1]",
          "spectrum_distance": "distance of the spectrum [1]", "deviation_distance": "distance of σ_yy's deviation [1]"}
COLOURS = (BLUE, GREEN, ORANGE)


def heights_of(rows):
    return sorted({row["height"] for row in rows})


def values(rows, height, name):
    return [abs(row[name]) for row in rows if row["height"] == height and row[name] is not None]


def draw(rows):
    rows = [row for row in rows if row["status"] == "ok" and row["mesh"] == "grid"]
    whole = max(heights_of(rows))
    rows = [row for row in rows if row["height"] < whole]
    figure, panels = plt.subplots(2, 2, figsize=(10, 7), constrained_layout=True, sharex=True)
    for axes, (name, label) in zip(panels.flat, PANELS.items()):
        for colour, regime in zip(COLOURS, dict.fromkeys(row["regime"] for row in rows)):
            own = [row for row in rows if row["regime"] == regime]
            heights = [height for height in heights_of(own) if values(own, height, name)]
            for height in heights:
                found = values(own, height, name)
                axes.plot([height] * len(found), found, ".", color=colour, alpha=0.4)
            axes.plot(heights, [np.median(values(own, height, name)) for height in heights], "o-", color=colour,
                      label=regime)
        axes.set(ylabel=label)
        axes.set_ylim(bottom=0)
        axes.grid(alpha=0.25)
    for axes in panels[1]:
        axes.set_xlabel(f"height of the microstructure [mm], of {whole:g}")
    panels[0, 0].legend()
    return figure


def main(arguments=None):
    parser = Parser("strip.picture", __doc__, "python3 -m")
    parser.add_argument("table", help="table.csv of the study")
    return write_picture(parser, lambda options: draw(read_csv(options.table)), arguments)


if __name__ == "__main__":
    sys.exit(main())
