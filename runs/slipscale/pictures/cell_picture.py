"""A homogenised cell at a glance: local stress under the three unit strains, the phases, C_eff and its bounds.

    slipscale cell-picture out/cell cell.png

The folder is one of `homogenize`. Exits with code 2 and one sentence when there is nothing to plot.
"""

import math
from pathlib import Path

import numpy as np

from slipscale.parser import Parser
from slipscale.pictures.drawing import draw_cells, limits_of, plt, shown, write_picture
from slipscale.reading import OnMesh, UnreadableRun, read_dataset, read_yaml

GIGA = 1e-9
CASES = (("xx", r"\sigma_{xx}", r"E_{xx}"), ("yy", r"\sigma_{yy}", r"E_{yy}"), ("xy", r"\sigma_{xy}", r"\gamma_{xy}"))
SIX = {"C11": (0, 0), "C22": (1, 1), "C12": (0, 1), "C66": (2, 2), "C16": (0, 2), "C26": (1, 2)}


class Cell(OnMesh):
    """localization.h5 and effective.yaml of a folder.

    area [nc] m2; stress[case] [nc, 3] Pa (xx, yy, xy) per unit macroscopic strain
    xx, yy or xy; boundary, the name of the condition. `report` is what effective.yaml holds, stiffness [6] Pa.
    """

    def __init__(self, folder):
        super().__init__(Path(folder) / "localization.h5", "homogenize")
        with self:
            self.area = read_dataset(self._file, "cell/area").ravel()
            self.stress = {case: read_dataset(self._file, f"cell/stress_{case}") for case, _, _ in CASES}
        report = Path(folder) / "effective.yaml"
        if not report.is_file():
            raise UnreadableRun(f"There is no {report.name} in {folder}: give the output folder of a `homogenize` run.")
        self.yaml = read_yaml(report)
        self.report = self.yaml.get("homogenize") or {}
        self.stiffness = np.array(self.yaml.get("stiffness", []), dtype=float)
        if self.stiffness.shape != (6,):
            raise UnreadableRun(f"{report} has no stiffness of six numbers: run `homogenize` again.")
        self.boundary = self.report.get("boundary", "")


def stress_panel(axes, figure, cell, case, letter):
    """One component of the local stress under the unit strain of the same name."""
    component = [name for name, _, _ in CASES].index(case)
    _, stress_name, strain_name = CASES[component]
    stress = cell.stress[case][:, component] * GIGA
    image = draw_cells(axes, cell, stress, ("cividis", *limits_of(stress, 0.5)))
    figure.colorbar(image, ax=axes, label=f"${stress_name}/{strain_name}$ [GPa]", extend="both", pad=0.02)
    mean = np.average(stress, weights=cell.area)
    axes.set(title=f"({letter}) ${stress_name}$ under ${strain_name}$: {stress.min():.4g} to {stress.max():.4g}, "
                   f"mean {mean:.5g} GPa")


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
    return f"{shown(folder)}: {len(cell.region)} cells, {cell.boundary}\n" + "   |   ".join(numbers)


def draw(folder):
    """The figure of the cell in `folder`. Raises UnreadableRun."""
    cell = Cell(folder)
    width, height = np.ptp(cell.coordinates, axis=0)
    tall = 2 * min(8.0, max(4.7, 5.2 * height / width + 0.6))  # two rows; the text needs 4.7
    figure, axes = plt.subplots(2, 2, figsize=(14, tall), layout="constrained")
    figure.get_layout_engine().set(w_pad=0.12, h_pad=0.08)
    for panel, (case, _, _), letter in zip(axes.flat, CASES, "abc"):
        stress_panel(panel, figure, cell, case, letter)
    text_panel(axes[1, 1], cell)
    figure.suptitle(headline(folder, cell), fontsize="large", fontweight="bold")
    return figure


def main(arguments=None):
    parser = Parser("cell-picture", __doc__)
    parser.add_argument("folder", help="output folder of a homogenize run")
    return write_picture(parser, lambda options: draw(options.folder), arguments)
