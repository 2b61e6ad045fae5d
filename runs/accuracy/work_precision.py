"""Error against seconds, and time and memory against size, of a table of `homogenize` runs.

    python3 -m accuracy.work_precision out/accuracy/table.csv picture.png
        [--orientation runs/accuracy/study.yaml]

The table has the columns element, size (elements across the cell), solver, rtol, those of slipscale.reading.effective
and error_C11. Of repeated runs the quickest counts.
"""

import sys
from pathlib import Path

from slipscale.measuring.convergence import fit_power
from slipscale.parser import Parser
from slipscale.pictures.colours import BLACK, BLUE, GREEN, ORANGE, PURPLE, SKY, VERMILION
from slipscale.pictures.drawing import plt, write_picture
from slipscale.reading import UnreadableRun
from slipscale.reading.yaml_file import load
from slipscale.running.table import quickest, read_csv

OPTIONS = ("element", "size", "solver", "rtol")
COLOURS = {"triangle": BLUE, "quadrilateral": ORANGE, "grid": GREEN}  # black for others
MARKERS = {"triangle": "^", "quadrilateral": "s", "grid": "o"}  # a filled cross for others
STYLES = {"triangle": "-", "quadrilateral": "--", "grid": "-."}  # dotted for others
LABELS_AT = {"triangle": (4, 4), "quadrilateral": (-18, -10), "grid": (-16, 4)}  # of the sizes, in points
ITERATIVE = "cg + gamg"
MEGA = 1e-6


class Study:
    """The rows of the table that are ok, the quickest of each, and what belongs together; rows rise with the size."""

    def __init__(self, rows):
        self.rows = sorted(quickest(rows, OPTIONS), key=lambda row: row["size"])
        if not self.rows:
            raise UnreadableRun("The table has no run that ended well: its column `reason` says why.")
        self.tightest = min(row["rtol"] for row in self.rows)
        self.elements = list(dict.fromkeys(row["element"] for row in self.rows))

    def over_size(self, element, solver="default"):
        """At the tightest tolerance."""
        return [row for row in self.rows
                if (row["element"], row["solver"], row["rtol"]) == (element, solver, self.tightest)]

    def iterative(self, element):
        """Those of `over_size` that are large enough for multigrid."""
        return [row for row in self.over_size(element) if row["method"] == ITERATIVE]

    def over_tolerance(self):
        """At the one mesh that was solved to most tolerances, from loose to tight."""
        def same(mesh):
            return [row for row in self.rows
                    if (row["element"], row["size"]) == mesh and row["solver"] == "default"]

        meshes = dict.fromkeys((row["element"], row["size"]) for row in self.rows)
        return sorted(max(map(same, meshes), key=len), key=lambda row: -row["rtol"])

    def least_memory(self):
        """What the program holds whatever the mesh, about: the least of all runs, B."""
        return min(row["memory"] for row in self.rows)


def colour_of(element):
    return COLOURS.get(element, BLACK)


def marker_of(element):
    return MARKERS.get(element, "X")


def meshes_of(element):
    """What meshes of this element are called."""
    return "fitted grid" if element == "grid" else f"{element}s"


def column(rows, name):
    return [row[name] for row in rows]


def change(row, tight):
    """Largest relative change of C11, C12 and C66 against the run to the tightest tolerance."""
    return max(abs(row[name] / tight[name] - 1) for name in ("C11", "C12", "C66"))


def power_of(rows, quantity, base=0.0):
    """The power of the unknowns fitted to a quantity above `base`; None from fewer than two runs."""
    rows = [row for row in rows if row[quantity] > base]
    return fit_power(column(rows, "unknowns"), [row[quantity] - base for row in rows]) if len(rows) > 1 else None


def work_precision_panel(axes, study, orientation):
    for element in study.elements:
        rows = study.over_size(element)
        seconds, errors = column(rows, "seconds"), [abs(row["error_C11"]) for row in rows]
        axes.loglog(seconds, errors, marker_of(element) + "-", color=colour_of(element),
                    label=f"{meshes_of(element)}, element size")
        for row, x, y in zip(rows, seconds, errors):
            axes.annotate(str(row["size"]), (x, y), LABELS_AT.get(element, (4, 4)), textcoords="offset points",
                          fontsize="small", color=colour_of(element))
    tolerances = study.over_tolerance()
    if len(tolerances) > 1:
        axes.loglog(column(tolerances, "seconds"), [abs(row["error_C11"]) for row in tolerances], "x:", color=PURPLE,
                    label=f"{tolerances[0]['size']} across, solver tolerance {tolerances[0]['rtol']:.0e} to "
                          f"{tolerances[-1]['rtol']:.0e}")
    for element in study.elements:
        rows = study.over_size(element, "direct")
        if rows:
            axes.loglog(column(rows, "seconds"), [abs(row["error_C11"]) for row in rows], "D--", markersize=5,
                        color=VERMILION, label=f"{meshes_of(element)}, factorisation")
    for known, marker in zip(orientation, "*PX"):
        axes.loglog(known["seconds"], known["error"], marker + "-", color=BLACK, linewidth=0.8, markersize=9,
                    label=known["name"])
    guide = study.iterative(study.elements[0]) or study.over_size(study.elements[0])
    x, y = guide[-1]["seconds"], 0.5 * abs(guide[-1]["error_C11"])  # order 2 in h is order 1 in the unknowns
    axes.loglog([x / 20, x], [20 * y, y], color="0.6", label="order 2 in h at a cost linear in size")
    axes.set(title="(a) Error for time", xlabel="seconds in all, mesh reading and files included",
             ylabel="relative error of $C_{11}$")


def over_size_panel(axes, study, quantity, known_as, orientation, scale=1.0, base=0.0):
    """A quantity against the unknowns with the fitted power; it is drawn whole, the power is of what exceeds base."""
    curves = [(study.iterative(element), colour_of(element), f"{meshes_of(element)}, multigrid", marker_of(element))
              for element in study.elements]
    curves += [(study.over_size(element, "direct"), VERMILION, f"{meshes_of(element)}, factorisation", "D")
               for element in study.elements]
    for rows, colour, name, marker in curves:
        if rows:
            power = power_of(rows, quantity, base)
            fitted = f": exponent {power.exponent:.2f}" if power else ""
            axes.loglog(column(rows, "unknowns"), [scale * row[quantity] for row in rows], marker + "-", color=colour,
                        label=name + fitted)
    for known, marker in zip(orientation, "*PX"):
        if {"unknowns", known_as} <= known.keys():
            axes.loglog(known["unknowns"], known[known_as], marker + "-", color=BLACK, linewidth=0.8, markersize=9,
                        label=known["name"])
    axes.set(xlabel="unknowns")


def share_panel(axes, study):
    """Where the seconds go, at the tightest tolerance."""
    for element in study.elements:
        rows, style = study.iterative(element), STYLES.get(element, ":")
        rest = [row["seconds"] - row["set_up_seconds"] - row["solve_seconds"] for row in rows]
        for values, colour, name in ((column(rows, "set_up_seconds"), GREEN, "set-up"),
                                     (column(rows, "solve_seconds"), SKY, "three solves"),
                                     (rest, "0.5", "mesh reading and files")):
            if rows:
                axes.loglog(column(rows, "unknowns"), values, marker_of(element) + style, color=colour,
                            label=f"{meshes_of(element)}, {name}")
    axes.set(title="(d) Where multigrid's seconds go", xlabel="unknowns", ylabel="seconds")


def draw(rows, orientation=()):
    """The figure of a table's rows. `orientation` has entries {name, seconds: [], error: [], and maybe unknowns: [],
    megabytes: []} of other codes. Raises UnreadableRun when no run is ok."""
    study = Study(rows)
    figure, axes = plt.subplots(2, 2, figsize=(14, 10.5), layout="constrained")
    figure.get_layout_engine().set(w_pad=0.12, h_pad=0.08)
    work_precision_panel(axes[0, 0], study, orientation)
    over_size_panel(axes[0, 1], study, "seconds", "seconds", orientation)
    axes[0, 1].set(title="(b) Time over size", ylabel="seconds in all")
    over_size_panel(axes[1, 0], study, "memory", "megabytes", orientation, MEGA, study.least_memory())
    axes[1, 0].set(title=f"(c) Memory over size; exponents of what exceeds {MEGA * study.least_memory():.0f} MB",
                   ylabel="most memory held [MB]")
    share_panel(axes[1, 1], study)
    for panel in axes.flat:
        panel.grid(which="both", alpha=0.2)
        if panel.get_legend_handles_labels()[0]:
            panel.legend(fontsize="small", loc="upper right" if panel is axes[0, 0] else "upper left")
    axes[0, 0].set_ylim(top=200 * axes[0, 0].get_ylim()[1])  # room for the legend
    return figure


def main(arguments=None):
    parser = Parser("accuracy.work_precision", __doc__, "python3 -m")
    parser.add_argument("table", help="CSV of the runs")
    parser.add_argument("--orientation", type=Path, help="YAML file whose entry `orientation` lists other codes")

    def figure(options):
        known = load(options.orientation)["orientation"] if options.orientation else []
        return draw(read_csv(options.table), known)

    return write_picture(parser, figure, arguments)


if __name__ == "__main__":
    sys.exit(main())
