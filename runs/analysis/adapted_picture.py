"""Draws what adapting a homogeneous model did: two spectra before and after, and the distances of all adaptations.

    PYTHONPATH=runs python3 -m analysis.adapted_picture OUT PICTURE.png --window FROM TO

OUT is the output of the study: table.csv, run/ and adapt/. The two cases are those whose relaxation time brought the
largest and the smallest part of the distance.
"""

import argparse
import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

from analysis.drawing import write_picture
from analysis.panels import BLACK, BLUE, GREEN, ORANGE, PURPLE, SKY, VERMILION
from analysis.reading import UnreadableRun
from analysis.regime import friction_spectrum
from analysis.table import read_csv, run_name

COMPOSITE = ("young", "diameter", "size", "seed")
LEVELS = {"scaling": ("T: ωT kept", "<", SKY), "frequency": ("T: one frequency", ">", GREEN),
          "search": ("T: search", "D", VERMILION)}
WAYS = {"time": ("T", "o", VERMILION), "coefficient": ("µ", "s", ORANGE), "damping": ("damping", "p", PURPLE),
        "slip_rate": ("slip-rate form", "*", GREEN)}


def cases_of(rows):
    """{composite: {(way, level): row}} of adaptations that had a distance before."""
    cases = {}
    for row in rows:
        if row["model"] == "adapted" and row.get("before_spectrum_distance") is not None:
            case = tuple(row[name] for name in COMPOSITE)
            cases.setdefault(case, {})[row["way"], row["level"]] = row
    return cases


def before_of(case):
    return next(iter(case.values()))["before_spectrum_distance"]


def nearest_in_time(case):
    """The level of T whose spectrum came nearest, as a row; or None."""
    rows = [row for (way, level), row in case.items() if way == "time" and level in LEVELS
            and row["after_spectrum_distance"] is not None]
    return min(rows, key=lambda row: row["after_spectrum_distance"], default=None)


def extremes(cases):
    """The composites whose T brought the largest and the smallest part of the distance."""
    part = {name: found["after_spectrum_distance"] / before_of(case) for name, case in cases.items()
            if (found := nearest_in_time(case))}
    if not part:
        raise UnreadableRun("no relaxation time was adapted.")
    return min(part, key=part.get), max(part, key=part.get)


def title_of(composite):
    young, diameter, _, seed = composite
    return f"{young:g}/30 GPa, discs of {diameter:g} mm, morphology {seed:g}"


def draw_spectra(axes, out, composite, case, window):
    row = nearest_in_time(case)
    of = dict(zip(COMPOSITE, composite))
    runs = {"composite": (out / "run" / run_name({**of, "model": "heterogeneous"}), BLUE),
            "homogenised": (out / "run" / run_name({**of, "model": "homogeneous"}), BLACK),
            f"homogenised, T = {1e6 * row['value']:.3g} µs": (
                out / "adapt" / run_name({**of, "way": "time"}) / "trials" / f"friction_time_{row['value']:.6g}",
                VERMILION)}
    for name, (folder, colour) in runs.items():
        frequency, amplitude = friction_spectrum(folder, window)
        axes.semilogy(frequency / 1e3, np.maximum(amplitude, 1e-12), color=colour, linewidth=1.2, label=name)
    top = axes.get_ylim()[1]
    axes.set(ylim=(1e-4 * top, top), xlim=(0, 2000), xlabel="frequency [kHz]", ylabel="√density [1/√Hz]",
             title=f"{title_of(composite)}\ndistance {before_of(case):.2f} → {row['after_spectrum_distance']:.2f}")
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
        for shift, (way, (_, marker, colour)) in zip((0.06, 0.16, 0.26, 0.36), WAYS.items()):
            if row := case.get((way, "nearest")):
                axes.plot(at + shift, row["after_spectrum_distance"], marker, color=colour, markersize=7,
                          markerfacecolor="none")
    axes.plot([], [], "_", color=BLACK, markersize=14, markeredgewidth=2.2, label="before")
    for label, marker, colour in LEVELS.values():
        axes.plot([], [], marker, color=colour, label=label)
    for label, marker, colour in WAYS.values():
        axes.plot([], [], marker, color=colour, markerfacecolor="none", label=f"{label}: nearest tried")
    axes.axhline(np.sqrt(2), color="0.5", linestyle=":", linewidth=1)
    axes.annotate("unrelated", (0.002, np.sqrt(2)), xycoords=("axes fraction", "data"), fontsize="small", va="bottom",
                  color="0.4")
    axes.set_yscale("log")
    axes.set_xticks(range(len(order)), [f"{young:g}\nmorph. {seed:g}" for young, _, _, seed in order])
    axes.set(ylabel="distance of the spectrum [1]", xlim=(-0.6, len(order) - 0.4),
             xlabel="modulus of the inclusions [GPa] and morphology")
    axes.grid(axis="y", which="both", alpha=0.25)
    axes.legend(ncol=4, fontsize="small", loc="upper center", bbox_to_anchor=(0.5, 1.22), frameon=False)


def draw(options):
    out = Path(options.out)
    cases = cases_of(read_csv(out / "table.csv"))
    figure = plt.figure(figsize=(12, 9), constrained_layout=True)
    grid = figure.add_gridspec(2, 2)
    for k, name in enumerate(extremes(cases)):
        draw_spectra(figure.add_subplot(grid[0, k]), out, name, cases[name], options.window)
    draw_distances(figure.add_subplot(grid[1, :]), cases)
    return figure


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out", help="output folder of the study")
    parser.add_argument("--window", nargs=2, type=float, required=True, metavar=("FROM", "TO"), help="s")
    return write_picture(parser, draw, arguments)


if __name__ == "__main__":
    sys.exit(main())
