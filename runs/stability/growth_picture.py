"""Growth and frequency that slide shows over those that modes predict.

    python3 -m stability.growth_picture out/stability/table.csv out/stability/map.csv picture.png
"""

import sys

import numpy as np

from slipscale.parser import Parser
from slipscale.pictures.colours import BLACK, BLUE, ORANGE, VERMILION
from slipscale.pictures.drawing import plt, write_picture
from slipscale.reading import UnreadableRun
from slipscale.running.table import read_csv

COLOURS = {"plain": BLUE, "composite": VERMILION, "homogenised": ORANGE}
TIMES = (("modes", "o"), ("scheme", "x"))  # against what: continuous time, or the time scheme of the run


def draw(options):
    rows = [row for row in read_csv(options.growth) if row["status"] == "ok" and row.get("growth_seen") is not None]
    if not rows:
        raise UnreadableRun(f"{options.growth} has no run whose growth was seen")
    figure, panels = plt.subplots(1, 3, figsize=(15, 5), layout="constrained")
    for model, colour in COLOURS.items():
        own = [row for row in rows if row["model"] == model]
        column = {name: np.array([row[name] for row in own], dtype=float) for name in
                  ("growth_seen", "growth_modes", "growth_scheme", "frequency_seen", "frequency_modes", "frequency_scheme")}
        panels[0].plot(column["growth_modes"] / 1e3, column["growth_seen"] / 1e3, "o", color=colour, label=model)
        panels[1].plot(column["frequency_modes"] / 1e3, column["frequency_seen"] / 1e3, "o", color=colour)
        for names, marker in TIMES:
            panels[2].loglog(np.maximum(np.abs(column["frequency_seen"] / column[f"frequency_{names}"] - 1), 1e-13),
                             np.maximum(np.abs(column["growth_seen"] / column[f"growth_{names}"] - 1), 1e-13),
                             marker, color=colour)
    for axes, name, unit in ((panels[0], "growth rate", "1/ms"), (panels[1], "frequency", "kHz")):
        ends = np.array(axes.get_xlim())
        axes.plot(ends, ends, color=BLACK, linewidth=0.8)
        axes.grid(alpha=0.25)
        axes.set(xlabel=f"{name} by modes [{unit}]", ylabel=f"{name} shown by slide [{unit}]")
    for (_, marker), words in zip(TIMES, ("in continuous time", "of the time scheme")):
        panels[2].plot([], [], marker, color=BLACK, label=f"from the modes {words}")
    for axes in (panels[0], panels[2]):
        axes.legend(loc="upper left")
    panels[0].set_title("(a) Growth")
    panels[1].set_title("(b) Frequency")
    panels[2].grid(alpha=0.25)
    low, high = panels[2].get_ylim()
    panels[2].set(title="(c) Difference", xlabel="of the frequency, relative", ylabel="of the growth rate, relative",
                  ylim=(low, high * 1e3))  # room for the legend
    return figure


def main(arguments=None):
    parser = Parser("stability.growth_picture", __doc__, "python3 -m")
    parser.add_argument("growth", help="table.csv of the study")
    parser.add_argument("swept", help="map.csv of the study")
    return write_picture(parser, draw, arguments)


if __name__ == "__main__":
    sys.exit(main())
