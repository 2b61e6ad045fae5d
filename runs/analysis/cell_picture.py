"""A homogenised cell at a glance: local stress under the three unit strains, the phases, C_eff and its bounds.

    PYTHONPATH=runs /usr/bin/python3 -m analysis.cell_picture out/cell cell.png

The folder is one of `homogenize`. Exits with code 2 and one sentence when there is nothing to plot.
"""

import argparse
import math
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection

from analysis.mesh import interfaces, triangles_of
from analysis.reading import UnreadableRun, open_hdf5, read_dataset, read_yaml

GIGA = 1e-9
CASES = (("xx", r"\sigma_{xx}", r"E_{xx}"), ("yy", r"\sigma_{yy}", r"E_{yy}"), ("xy", r"\sigma_{xy}", r"\gamma_{xy}"))
SIX = {"C11": (0, 0), "C22": (1, 1), "C12": (0, 1), "C66": (2, 2), "C16": (0, 2), "C26": (1, 2)}
PREFIXES = ((1.0, "m"), (1e-3, "mm"), (1e-6, "µm"), (1e-9, "nm"))


class Cell:
    """localization.h5 and effective.yaml of a folder.

    coordinates [np, 2] m; triangles [nt, 3] point numbers (a quadrilateral gives two), cell_of_triangle [nt];
    region [nc] and region_names; area [nc] m2; stress[case] [nc, 3] Pa (xx, yy, xy) per unit macroscopic strain
    xx, yy or xy; boundary, the name of the condition. `report` is what effective.yaml holds, stiffness [6] Pa.
    """

    def __init__(self, folder):
        folder = Path(folder)
        for name in ("localization.h5", "effective.yaml"):
            if not (folder / name).is_file():
                raise UnreadableRun(f"There is no {name} in {folder}: give the output folder of a `homogenize` run.")
        with open_hdf5(folder / "localization.h5") as file:
            self.coordinates = read_dataset(file, "mesh/coordinates")[:, :2]
            self.triangles, self.cell_of_triangle = triangles_of(read_dataset(file, "mesh/cells"))
            self.region = read_dataset(file, "mesh/region").ravel()
            self.area = read_dataset(file, "cell/area").ravel()
            self.stress = {case: read_dataset(file, f"cell/stress_{case}") for case, _, _ in CASES}
        self.yaml = read_yaml(folder / "effective.yaml")
        self.report = self.yaml.get("homogenize") or {}
        self.stiffness = np.array(self.yaml.get("stiffness", []), dtype=float)
        if self.stiffness.shape != (6,):
            raise UnreadableRun(f"{folder / 'effective.yaml'} has no stiffness of six numbers: run `homogenize` again.")
        self.boundary = self.report.get("boundary", "")

    def length_unit(self):
        """A factor from metres and the name of the unit that suits the cell's size."""
        size = np.ptp(self.coordinates, axis=0).max()
        for metres, name in PREFIXES:
            if size >= 0.999 * metres:
                return 1 / metres, name
        return 1 / PREFIXES[-1][0], PREFIXES[-1][1]

    def outlines(self):
        """Segments [ns, 2, 2] m between the phases."""
        return interfaces(self.coordinates, self.triangles, self.region[self.cell_of_triangle])


def stress_panel(axes, figure, cell, case, letter):
    """One component of the local stress under the unit strain of the same name."""
    component = [name for name, _, _ in CASES].index(case)
    _, stress_name, strain_name = CASES[component]
    stress = cell.stress[case][:, component] * GIGA
    scale, unit = cell.length_unit()
    x, y = cell.coordinates.T * scale
    low, high = np.percentile(stress, [0.5, 99.5])
    if not high - low > 1e-6 * abs(high):  # a homogeneous cell
        low, high = low - 0.05 * abs(low), high + 0.05 * abs(high)
    image = axes.tripcolor(x, y, cell.triangles, facecolors=stress[cell.cell_of_triangle], cmap="cividis", vmin=low,
                           vmax=high, rasterized=True)
    axes.add_collection(LineCollection(cell.outlines() * scale, colors="black", linewidths=0.8))
    figure.colorbar(image, ax=axes, label=f"${stress_name}/{strain_name}$ [GPa]", extend="both", pad=0.02)
    axes.margins(0)
    axes.set_aspect("equal")
    mean = np.average(stress, weights=cell.area)
    axes.set(title=f"({letter}) ${stress_name}$ under ${strain_name}$: {stress.min():.4g} to {stress.max():.4g}, "
                   f"mean {mean:.5g} GPa", xlabel=f"x [{unit}]", ylabel=f"y [{unit}]")


def stiffness_rows(cell):
    """Rows of C_eff in GPa as texts: the name, six digits of the largest entry, and the error bar if there is one."""
    solution = cell.report.get(cell.boundary) or {}
    decimals = max(0, 5 - math.floor(math.log10(GIGA * np.abs(cell.stiffness).max())))
    rows = []
    for (name, (i, j)), value in zip(SIX.items(), cell.stiffness):
        row = f"{name} {round(value * GIGA, decimals) + 0.0:{decimals + 6}.{decimals}f}"  # never -0.0000
        if error := solution.get(f"discretisation_error_{CASES[i][0]}"):
            row += f" ± {abs(float(error[j])) * GIGA:.{decimals}f}"
        rows.append(row)
    return rows


def bounds(cell):
    """Lines that set stiffnesses between their bounds, in GPa; none for what effective.yaml does not hold."""
    found, constants = cell.report.get("bounds") or {}, cell.report.get("engineering_constants") or {}

    def line(name, low, value, high):
        return f"{name:12}" + "".join(f"{float(modulus) * GIGA:10.5g}" for modulus in (low, value, high))

    lines = []
    if "voigt" in found and "reuss" in found:
        lines.append(f"{'':12}{'Reuss':>10}{'found':>10}{'Voigt':>10}")
        lines += [line(name, found["reuss"][k], cell.stiffness[k], found["voigt"][k])
                  for k, name in ((0, "C11"), (1, "C22"), (3, "C66"))]
    if "hashin_shtrikman_bulk" in found and constants:
        mean = 0.5 * (float(constants["shear_least"]) + float(constants["shear_most"]))
        low, high = zip(found["hashin_shtrikman_bulk"], found["hashin_shtrikman_shear"])
        lines.append(f"{'':12}{'HS lower':>10}{'found':>10}{'HS upper':>10}")
        lines += [line("k", low[0], constants["bulk"], high[0]), line("G, mean", low[1], mean, high[1])]
    return lines


def text_panel(axes, cell):
    """What the picture cannot show: phases, C_eff and bounds."""
    lines = ["phases"]
    for name, phase in (cell.report.get("phases") or {}).items():
        lines.append(f"  {name}: {100 * float(phase['fraction']):.4g} %, {phase['material']}")
    lines += ["", f"effective stiffness [GPa], {cell.boundary}", *("  " + row for row in stiffness_rows(cell))]
    estimated = "discretisation_error_xx" in (cell.report.get(cell.boundary) or {})
    lines.append("  ± Richardson's estimate; the drawn polygons are kept" if estimated else "  no error estimate")
    if between := bounds(cell):
        lines += ["", "between its bounds [GPa]", *("  " + line for line in between)]
    axes.set_axis_off()
    axes.set_title("(d) Effective solid", loc="left")
    axes.text(0, 0.98, "\n".join(lines), transform=axes.transAxes, va="top", family="monospace", fontsize=9.5)


def headline(folder, cell):
    """Two lines: the folder, and the numbers a reader compares."""
    constants = cell.report.get("engineering_constants") or {}
    numbers = []
    if constants:
        numbers = [f"nearest isotropic solid: E = {float(constants['young']) * GIGA:.5g} GPa, "
                   f"ν = {float(constants['poisson']):.4f}",
                   f"anisotropy {100 * float(constants['anisotropy']):.2g} %"]
    if "density" in cell.yaml:
        numbers.append(f"density {float(cell.yaml['density']):.5g} kg/m³")
    return f"{folder}: {len(cell.region)} cells, {cell.boundary}\n" + "   |   ".join(numbers)


def draw(folder):
    """The figure of the cell in `folder`. Raises UnreadableRun."""
    cell = Cell(folder)
    figure, axes = plt.subplots(2, 2, figsize=(14, 11.5), layout="constrained")
    figure.get_layout_engine().set(w_pad=0.12, h_pad=0.08)
    for panel, (case, _, _), letter in zip(axes.flat, CASES, "abc"):
        stress_panel(panel, figure, cell, case, letter)
    text_panel(axes[1, 1], cell)
    figure.suptitle(headline(folder, cell), fontsize="large", fontweight="bold")
    return figure


def main(arguments=None):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", help="output folder of a homogenize run")
    parser.add_argument("picture", help="image to write; the ending chooses the format")
    options = parser.parse_args(arguments)
    endings = plt.figure().canvas.get_supported_filetypes()
    if Path(options.picture).suffix.lstrip(".") not in endings:
        parser.error(f"{options.picture} should end in one of: {', '.join(endings)}")
    plt.rcParams.update({"font.size": 11, "axes.titlesize": 11.5})
    try:
        draw(options.folder).savefig(options.picture, dpi=120)
    except (UnreadableRun, OSError) as error:
        print(error, file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
