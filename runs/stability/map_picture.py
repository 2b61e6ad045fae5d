"""What is predicted over coefficient and relaxation time beside what the sweep saw.

    python3 -m stability.map_picture out/stability/table.csv out/stability/map.csv picture.png

Colour is the growth rate of the fastest mode, grey where none grows; a cell says its frequency and that of the limit
cycle in kHz, - where nothing vibrates. A frame marks where one grows and nothing vibrates, or the other way.
"""

import sys

import numpy as np

from slipscale.parser import Parser
from slipscale.pictures.colours import BLACK, BLUE
from slipscale.pictures.drawing import plt, write_picture
from slipscale.reading import UnreadableRun
from slipscale.running.table import read_csv
from stability.predicted import STILL


def grid_of(rows):
    """Coefficients [n], times [m] ascending, and growth [n, m] in 1/s, nan where there is none."""
    coefficients, times = (sorted({row[name] for row in rows}) for name in ("coefficient", "time"))
    growth = np.full((len(coefficients), len(times)), np.nan)
    for row in rows:
        value = row["growth"] if row["growth"] is not None else row["least_damped"]
        growth[coefficients.index(row["coefficient"]), times.index(row["time"])] = np.nan if value is None else value
    return coefficients, times, growth


def kilohertz(frequency):
    return "-" if frequency is None else f"{frequency / 1e3:.0f}"


def panel(axes, rows, largest):
    coefficients, times, growth = grid_of(rows)
    colours = plt.get_cmap("YlOrRd").copy()
    colours.set_under("0.93")
    image = axes.imshow(growth / 1e3, origin="lower", aspect="auto", cmap=colours, vmin=0, vmax=largest / 1e3)
    for row in rows:
        at = times.index(row["time"]), coefficients.index(row["coefficient"])
        vibrates = row["amplitude"] > STILL
        axes.annotate(f"{kilohertz(row['fastest'])}\n{kilohertz(row['frequency'] if vibrates else None)}", at, ha="center",
                      va="center", fontsize="small", color="white" if (row["growth"] or 0) > 0.6 * largest else BLACK)
        if vibrates != bool(row["growing"]):
            axes.add_patch(plt.Rectangle((at[0] - 0.45, at[1] - 0.45), 0.9, 0.9, fill=False, edgecolor=BLUE, linewidth=2.5))
    axes.set_xticks(range(len(times)), [f"{time * 1e6:g}" for time in times])
    axes.set_yticks(range(len(coefficients)), [f"{value:g}" for value in coefficients])
    axes.set(xlabel="relaxation time T [µs]", ylabel="coefficient of friction", title=f"h = {rows[0]['size'] * 1e3:g} mm")
    return image


def draw(options):
    rows = [row for row in read_csv(options.swept) if row["status"] == "ok"]
    if not rows:
        raise UnreadableRun(f"{options.swept} has no point at which modes were found")
    sizes = sorted({row["size"] for row in rows}, reverse=True)
    figure, panels = plt.subplots(1, len(sizes), figsize=(6.5 * len(sizes) + 1, 6), squeeze=False, layout="constrained")
    largest = max(abs(row["growth"]) for row in rows if row["growth"] is not None) if any(
        row["growth"] is not None for row in rows) else 1.0
    for axes, size in zip(panels[0], sizes):
        image = panel(axes, [row for row in rows if row["size"] == size], largest)
    figure.colorbar(image, ax=panels[0], label="growth rate of the fastest mode [1/ms]; grey: none grows", extend="min")
    figure.suptitle("Frequency of the fastest mode that grows and, below, of the limit cycle [kHz]\n"
                    "framed: one without the other", fontsize=11)
    return figure


def main(arguments=None):
    parser = Parser("stability.map_picture", __doc__, "python3 -m")
    parser.add_argument("growth", help="table.csv of the study")
    parser.add_argument("swept", help="map.csv of the study")
    return write_picture(parser, draw, arguments)


if __name__ == "__main__":
    sys.exit(main())
