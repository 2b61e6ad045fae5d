"""Draws how amplitude, frequency and friction of morphologies scatter, beside their homogenised blocks.

    python3 -m contrast.scatter_picture TABLE.csv PICTURE.png [--block 5]

A column for each modulus of the inclusions and each ratio of block to disc; a point for each morphology.
"""

import sys

import matplotlib.pyplot as plt
import numpy as np

from contrast.morphologies import groups_of, paired
from slipscale.parser import Parser
from slipscale.pictures.colours import BLACK, BLUE, ORANGE, SKY
from slipscale.pictures.drawing import write_picture
from slipscale.running.table import read_csv

QUANTITIES = {"amplitude": ("amplitude of T / mean N [1]", 1), "frequency": ("dominant frequency [kHz]", 1e-3),
              "friction": ("mean T / mean N [1]", 1)}
COLOURS = (SKY, BLUE, ORANGE)
REGIMES = {True: "o", False: "^"}  # whether anything sticks


def spread_out(count, width=0.34):
    """Horizontal places of points around their column."""
    return np.linspace(-width, width, count) if count > 1 else np.zeros(1)


def draw_column(axes, at, pairs, name, factor, colour):
    for shift, (own, homogeneous) in zip(spread_out(len(pairs)), pairs):
        axes.plot(at + shift, factor * own[name], REGIMES["stick" in own["regime"]], color=colour, markersize=6,
                  markeredgecolor=BLACK, markeredgewidth=0.5, zorder=3)
        axes.plot(at + shift, factor * homogeneous[name], "_", color=BLACK, markersize=8, markeredgewidth=1.8)


def draw(rows, block):
    groups = groups_of(paired(rows))
    moduli = sorted({young for _, young in groups})
    figure, panels = plt.subplots(1, len(QUANTITIES), figsize=(13, 4.6), constrained_layout=True)
    for axes, (name, (label, factor)) in zip(panels, QUANTITIES.items()):
        for at, ((_, young), pairs) in enumerate(groups.items()):
            draw_column(axes, at, pairs, name, factor, COLOURS[moduli.index(young) % len(COLOURS)])
        axes.set(ylabel=label, xlabel="modulus of the inclusions [GPa] (matrix: 30)")
        axes.set_xticks(range(len(groups)), [f"{young:g}" for _, young in groups])
        axes.set_ylim(bottom=0)
        axes.grid(axis="y", alpha=0.25)
        diameters = [diameter for diameter, _ in groups]
        for diameter in dict.fromkeys(diameters):
            first, count = diameters.index(diameter), diameters.count(diameter)
            axes.text(first + (count - 1) / 2, 1.02, f"block/disc {block / diameter:g}", ha="center",
                      transform=axes.get_xaxis_transform(), fontsize="x-small")
            if first:
                axes.axvline(first - 0.5, color="0.6", linewidth=0.8)
    for marker, words in (("o", "morphology, sticks at times"), ("^", "morphology, never sticks"),
                          ("_", "its homogenised block")):
        panels[-1].plot([], [], marker, color=BLACK, markerfacecolor="0.8", label=words, markeredgewidth=1)
    panels[-1].legend(loc="lower left", framealpha=0.9)
    return figure


def main(arguments=None):
    parser = Parser("contrast.scatter_picture", __doc__, "python3 -m")
    parser.add_argument("table", help="table.csv of the study")
    parser.add_argument("--block", type=float, default=5.0, help="width of the block, mm")
    return write_picture(parser, lambda options: draw(read_csv(options.table), options.block), arguments)


if __name__ == "__main__":
    sys.exit(main())
