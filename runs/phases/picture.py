"""Draws the friction of composites and of the homogenised blocks that stand for them, over the period of the layers.

    python3 -m phases.picture TABLE.csv PICTURE.png

A panel for each regime and pair of coefficients, layers of phases that differ in friction only: dots are the composites,
lines the coefficients of the homogenised blocks, and open marks the friction that these have.
"""

import sys

import matplotlib.pyplot as plt

from slipscale.parser import Parser
from slipscale.pictures.colours import BLACK, BLUE, ORANGE
from slipscale.pictures.drawing import write_picture
from slipscale.running.table import read_csv

LOOKS = {"composite": dict(color=BLACK, marker="o", linestyle="none"),
         "effective": dict(color=BLUE, marker="s", fillstyle="none", linestyle="none"),
         "mean": dict(color=ORANGE, marker="^", fillstyle="none", linestyle="none")}


def draw(rows):
    rows = [row for row in rows if row["status"] == "ok" and row["shape"] == "layers" and row["phases"] == "same"]
    pairs, regimes = (list(dict.fromkeys(row[name] for row in rows)) for name in ("pair", "regime"))
    figure, panels = plt.subplots(len(pairs), len(regimes), figsize=(3.6 * len(regimes), 3.2 * len(pairs)), squeeze=False,
                                  constrained_layout=True, sharex=True)
    for line, pair in zip(panels, pairs):
        for axes, regime in zip(line, regimes):
            for model, look in LOOKS.items():
                own = sorted((row for row in rows if (row["pair"], row["regime"], row["model"]) == (pair, regime, model)),
                             key=lambda row: row["period"])
                axes.plot([row["period"] for row in own], [row["friction"] for row in own], label=model, **look)
                for mu in {row["coefficient"] for row in own} - {None}:
                    axes.axhline(mu, color=look["color"], linewidth=0.8)
            axes.set(xscale="log", title=f"{pair}, {regime}")
            axes.grid(alpha=0.25)
        line[0].set_ylabel("friction T/N [1]")
    for axes in panels[-1]:
        axes.set_xlabel("period [mm]")
    panels[0, 0].legend(fontsize="small")
    return figure


def main(arguments=None):
    parser = Parser("phases.picture", __doc__, "python3 -m")
    parser.add_argument("table", help="table.csv of the study")
    return write_picture(parser, lambda options: draw(read_csv(options.table)), arguments)


if __name__ == "__main__":
    sys.exit(main())
