"""The pictures of equivalence: what their panels show of made-up runs and verdicts, and when nothing is there."""

import contextlib
import io
import tempfile
import unittest
from argparse import Namespace
from pathlib import Path

import numpy as np

import h5py

from equivalence import map_picture as equivalence_map, picture as equivalence_picture
from equivalence.verdict import COMPETE, EQUIVALENT
from slipscale.pictures.colours import GREEN, PURPLE
from slipscale.reading import UnreadableRun
from slipscale.running.table import write_csv
from tests import fake_run

WINDOW = (2.5e-4, 3.9e-4)


class Pictures(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.addCleanup(equivalence_picture.plt.close, "all")
        self.folder = Path(temporary.name)

    def said_by(self, main, *words):
        """Exit code and what was said on stderr."""
        said = io.StringIO()
        with contextlib.redirect_stderr(said):
            code = main([*map(str, words), str(self.folder / "picture.png")])
        return code, said.getvalue()

    def size(self):
        return (self.folder / "picture.png").stat().st_size


class OfAPoint(Pictures):
    def setUp(self):
        super().setUp()
        self.folders = [self.folder / name for name in "abc"]
        for folder, factor in zip(self.folders, (1.0, 1.1, 1.3)):
            folder.mkdir()
            fake_run.write_history(folder, 5e-8 * np.arange(8000))
            with h5py.File(folder / "history.h5", "a") as file:
                force = file["boundary/top/tangential_force"]
                force[:] = force[:].mean() + factor * (force[:] - force[:].mean())

    def draw(self, **options):
        return equivalence_picture.draw(Namespace(composites=self.folders[:2], homogenised=self.folders[2:],
                                                  window=WINDOW, point=0, **options))

    def test_distances_over_the_scatter(self):
        figure = self.draw()
        panel = figure.axes[-1]
        self.assertIn("amplitude differs", figure.subfigs[0]._suptitle.get_text())
        spectrum = [float(np.ravel(line.get_xdata())[0]) for line in panel.lines[:3]]
        # 1/1.1 and 1.1 against each other, 1.3 against 1.05, over the largest of a morphology
        np.testing.assert_allclose(spectrum, [1 / 1.1, 1, (1.3 / 1.05 - 1) / 0.1], rtol=2e-2)

    def test_from_the_command_line(self):
        self.assertEqual(self.said_by(equivalence_picture.main, "--window", *WINDOW, "--homogenised", self.folders[2],
                                      "--composites", *self.folders[:2], "--"), (0, ""))
        self.assertGreater(self.size(), 50000)

    def test_too_few_rows(self):
        code, said = self.said_by(equivalence_picture.main, "--window", 0, 1e-9, "--homogenised", self.folders[2],
                                  "--composites", *self.folders[:2], "--")
        self.assertEqual(code, 2)
        self.assertIn("a spectrum needs 32", said)


class OfAMap(Pictures):
    def setUp(self):
        super().setUp()
        self.table = self.folder / "verdicts.csv"
        write_csv(self.table, [
            {"coefficient": mu, "load": load, "block": block, "status": status, "reason": None, "verdict": verdict,
             "settled": settled, "frequency_composites": 4e5, "frequency_homogenised": 5.25e5, "spectrum_apart": 0.6,
             "spectrum_limit": 0.25}
            for mu, load, block, status, verdict, settled in (
                (0.3, 5, "5x5", "ok", EQUIVALENT, True), (0.5, 5, "5x5", "ok", COMPETE, False),
                (0.3, 15, "5x5", "failed", None, None), (0.5, 15, "5x5", "ok", EQUIVALENT, True))])

    def draw(self, over=("coefficient", "load"), **options):
        return equivalence_map.draw(Namespace(table=self.table, over=over, unit=[],
                                              **{"where": [], "panel": None, **options}))

    def test_colours_and_what_stands_in_the_cells(self):
        figure = self.draw(panel="block")
        texts = [text.get_text() for text in figure.axes[0].texts]
        self.assertEqual(texts, ["400/525\n0.60/0.25", "400/525*\n0.60/0.25", "400/525\n0.60/0.25"])
        shown = {text.get_text(): patch.get_facecolor()
                 for text, patch in zip(figure.legends[0].get_texts(), figure.legends[0].get_patches())}
        self.assertEqual(list(shown), [EQUIVALENT, COMPETE, "failed"])
        for name, colour in ((EQUIVALENT, GREEN), (COMPETE, PURPLE)):
            np.testing.assert_allclose(shown[name], equivalence_map.plt.matplotlib.colors.to_rgba(colour))

    def test_several_rows_at_one_place(self):
        with self.assertRaisesRegex(UnreadableRun, "--panel"):
            self.draw(over=("load", "block"))

    def test_from_the_command_line(self):
        self.assertEqual(self.said_by(equivalence_map.main, self.table, "--over", "coefficient", "load"), (0, ""))
        self.assertGreater(self.size(), 10000)


if __name__ == "__main__":
    unittest.main()
