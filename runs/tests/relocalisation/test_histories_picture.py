"""Local histories of several cases: what stands where, and when nothing is there."""

import contextlib
import io
import tempfile
import unittest
from pathlib import Path

import numpy as np

from relocalisation import histories_picture
from tests import fake_run

TIMES = [1e-5, 2e-5, 3e-5]


class HistoriesPicture(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.addCleanup(histories_picture.plt.close, "all")
        self.folder = Path(temporary.name)

    def write(self, case, factor, points):
        """A case whose relocalised stress is `factor` times that of the heterogeneous run."""
        reference, relocalised = self.folder / f"{case}-reference", self.folder / case
        reference.mkdir()
        fake_run.write_fields(reference, TIMES, "triangles", divisions=12)
        fake_run.write_relocalized(relocalised, reference, factor, points)
        return case, str(reference), str(relocalised)

    def test_a_column_for_each_case_and_a_row_for_each_point(self):
        far, near, stiff = (250, 0), (3, 0), (60, 1)
        figure = histories_picture.draw([self.write("stable", 1.05, [stiff, far, near]),
                                         self.write("cycle", 0.8, [near])])
        titles = [axes.get_title() for axes in figure.axes]
        self.assertEqual([title.split(" at ")[0] for title in titles],
                         ["stable: in inclusion", "cycle: in matrix", "stable: in matrix", "cycle", "stable: in matrix",
                          "cycle"])
        heights = [float(titles[k].split(", ")[1].split(")")[0]) for k in (2, 4)]
        self.assertLess(*heights)  # nearest to the contact first
        for panel, factor in ((figure.axes[0], 1.05), (figure.axes[1], 0.8)):
            reference, homogeneous, relocalised = panel.lines[:3]
            np.testing.assert_allclose(relocalised.get_ydata(), factor * reference.get_ydata(), rtol=1e-12)
            np.testing.assert_allclose(homogeneous.get_ydata(), factor / 2 * reference.get_ydata(), rtol=1e-12)

    def test_one_sentence_without_points(self):
        said = io.StringIO()
        with contextlib.redirect_stderr(said):
            code = histories_picture.main([str(self.folder / "out.png"), "--case", *self.write("stable", 1, [])])
        self.assertEqual((code, said.getvalue().count("\n")), (2, 1))
        self.assertIn("-relocalize_points", said.getvalue())


if __name__ == "__main__":
    unittest.main()
