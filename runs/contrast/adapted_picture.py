"""Draws what adapting a homogeneous model did: two spectra before and after, and the distances of all adaptations.

    python3 -m contrast.adapted_picture OUT PICTURE.png --window FROM TO

OUT is the output of the study: table.csv, run/ and adapt/. The two cases are chosen by
`examples`.
"""

import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

from contrast.adapted import before_of, best_level, cases_of, left_by
from contrast.morphologies import COMPOSITE
from slipscale.measuring.regime import friction_spectrum
from slipscale.parser import Parser, Window
from slipscale.pictures.colours import BLACK, BLUE, GREEN, ORANGE, PURPLE, SKY, VERMILION
from slipscale.pictures.drawing import write_picture
from slipscale.reading import UnreadableRun
from slipscale.running.table import read_csv, run_name

LEVELS = {"scaling": ("T: ωT kept", "<", SKY), "frequency": ("T: one frequency", ">", GREEN),
          "search": ("T: search", "D", VERMILION)}
WAYS = {"time": ("T", "o", VERMILION), "coefficient": ("µ", "s", ORANGE), "damping": ("damping", "p", PURPLE),
        "slip_rate": ("slip-rate form", "*", GREEN), "density": ("density", "v", BLUE),
        "density_time": ("density, then T", "^", BLUE), "modes": ("T by modes", "h", SKY),
        "modes_all": ("T, µ, density and damping by modes", "X", BLACK)}


def examples(cases):
    """Two composites: where a level of T left the least distance, and of the others where another density, with or
    without another T, beats T by most (without such, where T left the most)."""
    known = [name for name, case in cases.items() if best_level(case, "time")]
    if not known:
        raise UnreadableRun("no relaxation time was adapted.")
    first = min(known, key=lambda name: left_by(cases[name], "time"))

    def gain(name):
        case = cases[name]
        return left_by(case, "time") / min(left_by(case, "density"), left_by(case, "density_time"), 1e3)
    return first, max((name for name in known if name != first), key=gain, default=first)


def title_of(composite):
    young, diameter, _, seed = composite
    return f"{young:g}/30 GPa, discs of {diameter:g} mm, morphology {seed:g}"


def draw_spectra(axes, out, composite, case, window):
    row = best_level(case, "time")
    of = dict(zip(COMPOSITE, composite))
    runs = {"composite": (out / "run" / run_name({**of, "model": "heterogeneous"}), BLUE),
            f"homogenised: {before_of(case):.2f}": (out / "run" / run_name({**of, "model": "homogeneous"}), BLACK),
            f"T = {1e6 * row['value']:.3g} µs: {row['after_spectrum_distance']:.2f}": (row["folder"], VERMILION)}
    if after := best_level(case, "density_time") or best_level(case, "density"):
        runs[f"density adapted too: {after['after_spectrum_distance']:.2f}"] = after["folder"], ORANGE
    for name, (folder, colour) in runs.items():
        frequency, amplitude = friction_spectrum(folder, window)
        axes.semilogy(frequency / 1e3, np.maximum(amplitude, 1e-12), color=colour, linewidth=1.2, label=name)
    top = axes.get_ylim()[1]
    axes.set(ylim=(1e-4 * top, 4 * top), xlim=(0, 1300), xlabel="frequency [kHz]", ylabel="√density [1/√Hz]",
             title=f"{title_of(composite)}: distances")
    axes.legend(fontsize="small", loc="upper right")
    axes.grid(alpha=0.25)


def draw_distances(axes, cases):
    order = sorted(cases, key=lambda name: before_of(cases[name]))
    for at, name in enumerate(order):
        case = cases[name]
        axes.plot(at, before_of(case), "_", color=BLACK, markersize=16, markeredgewidth=2.2, zorder=2)
        for shift, (level, (_, marker, colour)) in zip((-0.3, -0.18, -0.06), LEVELS.items()):
            row = case.get(("time", level))
            if row and row["after_spectrum_distance"] is not None:
                axes.plot(at + shift, row["after_spectrum_distance"], marker, color=colour, markersize=6)
        for shift, (way, (_, marker, colour)) in zip(np.linspace(0.06, 0.4, len(WAYS)), WAYS.items()):
            if row := case.get((way, "nearest")):
                axes.plot(at + shift, row["after_spectrum_distance"], marker, color=colour, markersize=6.5,
                          markerfacecolor="none")
    axes.plot([], [], "_", color=BLACK, markersize=14, markeredgewidth=2.2, label="before")
    for label, marker, colour in LEVELS.values():
        axes.plot([], [], marker, color=colour, label=label)
    for label, marker, colour in WAYS.values():
        axes.plot([], [], marker, color=colour, markerfacecolor="none", label=label)
    axes.axhline(1, color="0.4", linestyle=":", linewidth=1.2)
    axes.annotate("a block at rest", (0.003, 1), xycoords=("axes fraction", "data"), fontsize="small", va="bottom",
                  color="0.3")
    axes.set_yscale("log")
    axes.set_yticks([0.1, 0.2, 0.5, 1, 2, 5, 10], ["0.1", "0.2", "0.5", "1", "2", "5", "10"])
    axes.set_yticks([], minor=True)
    axes.autoscale(axis="y")
    axes.set_xticks(range(len(order)), [f"{young:g}\nmorph. {seed:g}" for young, _, _, seed in order])
    axes.set(ylabel="distance of the spectrum [1]", xlim=(-0.6, len(order) - 0.4),
             xlabel="modulus of the inclusions [GPa] and morphology; open marks: the nearest of all that were tried")
    axes.grid(axis="y", which="both", alpha=0.25)
    axes.legend(ncol=4, fontsize="small", loc="upper center", bbox_to_anchor=(0.5, 1.3), frameon=False)


def draw(options):
    out = Path(options.out)
    cases = cases_of(read_csv(out / "table.csv"))
    figure = plt.figure(figsize=(12, 9), constrained_layout=True)
    grid = figure.add_gridspec(2, 2)
    for k, name in enumerate(examples(cases)):
        draw_spectra(figure.add_subplot(grid[0, k]), out, name, cases[name], options.window)
    draw_distances(figure.add_subplot(grid[1, :]), cases)
    return figure


def main(arguments=None):
    parser = Parser("contrast.adapted_picture", __doc__, "python3 -m")
    parser.add_argument("out", help="output folder of the study")
    parser.add_argument("--window", action=Window, required=True, metavar=("FROM", "TO"), help="s")
    return write_picture(parser, draw, arguments)


if __name__ == "__main__":
    sys.exit(main())
