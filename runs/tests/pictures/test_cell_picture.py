"""The picture of a homogenised cell: of all kinds of mesh, without error bars and bounds, and when nothing is there."""

import contextlib
import io
import tempfile
import unittest
from pathlib import Path

import h5py
import numpy as np

from slipscale.pictures import cell_picture
from slipscale.reading import UnreadableRun
from tests import fake_run

SIX = [56.965e9, 56.965e9, 23.203e9, 15.731e9, -3.6e4, 0.0]
REPORT = """
stiffness: [5.6965e+10, 5.6965e+10, 2.3203e+10, 1.5731e+10, -3.6e+04, 0.0e+00]
density: 1760
homogenize:
  boundary: periodic
  phases:
    matrix: {fraction: 0.6, material: "E 30 GPa, nu 0.3"}
    inclusion: {fraction: 0.4, material: "E 80 GPa, nu 0.3"}
"""
REST = """
  periodic:
    discretisation_error_xx: [1.04e+07, 1.7e+06, 3.9e+04]
    discretisation_error_yy: [1.7e+06, 1.1e+07, 8.5e+04]
    discretisation_error_xy: [3.9e+04, 8.5e+04, 4.9e+06]
  engineering_constants: {bulk: 4.0084e+10, shear_least: 1.5731e+10, shear_most: 1.6881e+10, young: 4.2285e+10,
                          poisson: 0.2966, anisotropy: 0.018}
  bounds:
    voigt: [6.7308e+10, 6.7308e+10, 2.8846e+10, 1.9231e+10, 0, 0]
    reuss: [5.3846e+10, 5.3846e+10, 2.3077e+10, 1.5385e+10, 0, 0]
    hashin_shtrikman_bulk: [4.0064e+10, 4.1806e+10]
    hashin_shtrikman_shear: [1.6221e+10, 1.7021e+10]
"""


def write_cell(folder, kind="triangles", report=REPORT + REST):
    """The mesh of a fake run, with stresses that tell which phase and which load case they belong to."""
    fake_run.write_fields(folder, [0.0], kind, divisions=24)
    (folder / "effective.yaml").write_text(report)
    with h5py.File(folder / "fields.h5") as fields, h5py.File(folder / "localization.h5", "w") as file:
        fields.copy("mesh", file)
        region = fields["mesh/region"][:]
        file["cell/area"] = np.full(len(region), 1.0) + region
        for case in range(3):
            stress = np.zeros((len(region), 3))
            stress[:, case] = (case + 1) * (30e9 + 50e9 * region)
            file["cell/stress_" + ("xx", "yy", "xy")[case]] = stress


class CellPicture(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        self.addCleanup(cell_picture.plt.close, "all")

    def run_main(self, picture="cell.png"):
        """Exit code and what was said on stderr."""
        said = io.StringIO()
        with contextlib.redirect_stderr(said):
            code = cell_picture.main([str(self.folder), str(self.folder / picture)])
        return code, said.getvalue()

    def texts(self):
        """Titles of the panels, the text of the last, and the headline."""
        figure = cell_picture.draw(self.folder)
        panels = figure.axes[:4]
        return [axes.get_title() for axes in panels[:3]], panels[3].texts[0].get_text(), figure._suptitle.get_text()

    def test_every_kind_of_mesh(self):
        for kind in ("triangles", "quadrilaterals", "mixed"):
            write_cell(self.folder, kind)
            self.assertEqual(self.run_main(), (0, ""), kind)
            self.assertGreater((self.folder / "cell.png").stat().st_size, 50000)

    def test_panels_show_their_own_load_case(self):
        write_cell(self.folder)
        with h5py.File(self.folder / "localization.h5") as file:
            fraction = np.average(file["mesh/region"][:], weights=file["cell/area"][:])
        for k, title in enumerate(self.texts()[0]):
            low, high, mean = ((k + 1) * value for value in (30, 80, 30 + 50 * fraction))
            self.assertIn(f"{low:.4g} to {high:.4g}, mean {mean:.5g} GPa", title)

    def test_text(self):
        write_cell(self.folder)
        _, text, headline = self.texts()
        lines = [" ".join(line.split()) for line in text.splitlines()]
        for line in ("matrix: 60 %, E 30 GPa, nu 0.3", "effective stiffness [GPa], periodic", "C11 56.9650 ± 0.0104",
                     "C12 23.2030 ± 0.0017", "C66 15.7310 ± 0.0049", "C22 53.846 56.965 67.308",
                     "C66 15.385 15.731 19.231", "C16 0.0000 ± 0.0000",
                     "k 40.064 40.084 41.806", "G, mean 16.221 16.306 17.021"):
            self.assertIn(line, lines)
        self.assertIn("E = 42.285 GPa, ν = 0.2966   |   anisotropy 1.8 %   |   density 1760 kg/m³", headline)

    def test_without_error_bars_and_bounds(self):
        write_cell(self.folder, report=REPORT)
        self.assertEqual(self.run_main(), (0, ""))
        _, text, _ = self.texts()
        self.assertIn("no error estimate", text)
        self.assertNotIn("±", text)
        self.assertNotIn("bounds", text)

    def test_homogeneous_cell(self):
        write_cell(self.folder)
        with h5py.File(self.folder / "localization.h5", "r+") as file:
            file["mesh/region"][:] = 0
            for case in ("xx", "yy", "xy"):
                file[f"cell/stress_{case}"][:] = 0
        self.assertEqual(self.run_main(), (0, ""))

    def test_stiffness_is_that_of_the_file(self):
        write_cell(self.folder)
        self.assertEqual(cell_picture.Cell(self.folder).stiffness.tolist(), SIX)

    def test_one_sentence_when_a_file_is_missing_or_wrong(self):
        for name in ("localization.h5", "effective.yaml"):
            write_cell(self.folder)
            (self.folder / name).unlink()
            code, said = self.run_main()
            self.assertEqual((code, said.count("\n")), (2, 1))
            self.assertIn(f"There is no {name} in", said)
            self.assertIn("`homogenize`", said)
        write_cell(self.folder, report="density: 1\n")
        with self.assertRaisesRegex(UnreadableRun, "no stiffness of six numbers"):
            cell_picture.draw(self.folder)

    def test_unknown_kind_of_picture(self):
        with self.assertRaises(SystemExit) as stop, contextlib.redirect_stderr(io.StringIO()) as said:
            cell_picture.main([str(self.folder), "cell.foo"])
        self.assertEqual(stop.exception.code, 2)
        self.assertIn("should end in one of", said.getvalue())


if __name__ == "__main__":
    unittest.main()
