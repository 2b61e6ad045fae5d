"""Draws the friction of composites and of the homogenised blocks that stand for them, over the period of the layers.

    python3 -m phases.picture TABLE.csv PICTURE.png

A panel for each regime, shape and pair of coefficients, layers of phases that differ in friction only: dots are the
composites, lines the coefficients of the homogenised blocks, and open marks the friction that these have.
"""

import sys

import matplotlib.pyplot as plt

from slipscale.parser import Parser
from slipscale.pictures.colours import BLACK, BLUE, ORANGE
from slipscale.pictures.drawing import write_picture
from slipscale.running.table import read_csv

LABELS = {"composite": "composite", "effective": "block, effective coefficient", "mean": "block, mean coefficient"}
LOOKS = {"composite": dict(color=BLACK, marker="o", linestyle="none"),
         "effective": dict(color=BLUE, marker="s", fillstyle="none", linestyle="none"),
         "mean": dict(color=ORANGE, marker="^", fillstyle="none", linestyle="none")}


def draw(rows):
    rows = [row for row in rows if row["status"] == "ok" and row["period"] and row["phases"] == "same"]
    kinds = list(dict.fromkeys((row["shape"], row["pair"]) for row in rows))
    regimes = list(dict.fromkeys(row["regime"] for row in rows))
    periods = sorted({row["period"] for row in rows})
    figure, panels = plt.subplots(len(kinds), len(regimes), figsize=(3.6 * len(regimes), 3.0 * len(kinds)), squeeze=False,
                                  constrained_layout=True, sharex=True)
    for line, (shape, pair) in zip(panels, kinds):
        for axes, regime in zip(line, regimes):
            here = [row for row in rows if (row["shape"], row["pair"], row["regime"]) == (shape, pair, regime)]
            for model, look in LOOKS.items():
                own = sorted((row for row in here if row["model"] == model), key=lambda row: row["period"])
                axes.plot([row["period"] for row in own], [row["friction"] for row in own], label=LABELS[model], **look)
                for mu in {row["coefficient"] for row in own} - {None}:
                    axes.axhline(mu, color=look["color"], linewidth=0.8)
            axes.set(xscale="log", title=f"{shape}, {pair}, {regime}")
            axes.set_xticks(periods, [f"{period:.3g}" for period in periods])
            axes.tick_params(labelbottom=True)
            axes.minorticks_off()
            axes.grid(alpha=0.25)
            axes.set_visible(bool(here))  # not every regime was run of every shape
        line[0].set_ylabel("friction T/N [1]")
    for axes in panels[-1]:
        axes.set_xlabel("period [mm]")
    figure.get_layout_engine().set(rect=(0, 0, 1, 0.96))  # room above for the legend
    figure.legend(*panels[0, 0].get_legend_handles_labels(), loc="upper center", ncols=len(LOOKS))
    return figure


def main(arguments=None):
    parser = Parser("phases.picture", __doc__, "python3 -m")
    parser.add_argument("table", help="table.csv of the study")
    return write_picture(parser, lambda options: draw(read_csv(options.table)), arguments)


if __name__ == "__main__":
    sys.exit(main())
