"""The overview picture: of a complete run, of a partial one, and the sentence when there is nothing to draw."""

import contextlib
import io
import tempfile
import unittest
from pathlib import Path

import h5py
import numpy as np

from slipscale.pictures import picture
from tests import fake_run


class Picture(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        self.addCleanup(picture.plt.close, "all")

    def run_main(self, *extra):
        """Exit code and what was said on stderr."""
        said = io.StringIO()
        with contextlib.redirect_stderr(said):
            code = picture.main([str(self.folder), str(self.folder / "picture.png"), *extra])
        return code, said.getvalue()

    def titles(self, window=None):
        figure = picture.draw(self.folder, window)
        return [axes.get_title() for axes in figure.axes], figure._suptitle.get_text()

    def test_complete_run(self):
        fake_run.write_run(self.folder, cells="mixed")
        self.assertEqual(self.run_main(), (0, ""))
        self.assertGreater((self.folder / "picture.png").stat().st_size, 50000)
        titles, headline = self.titles()
        self.assertIn("(f) Energy ledger", " ".join(titles))
        # The noise, .004, is averaged over 4000 rows: an error of .00006.
        self.assertRegex(headline, r"mean T / mean N = 0\.440\d* ± 0\.0000\d\d .* dominant frequency 35[67]\.\d kHz")
        self.assertIn("|   settled   |", headline)

    def test_run_still_going(self):
        fake_run.write_run(self.folder, end=1e-4)
        for name in ("contact.h5", "fields.h5", "summary.yaml"):
            (self.folder / name).unlink()
        (self.folder / "run.yaml").write_text("time_end: 4e-4\n")
        self.assertEqual(self.run_main(), (0, ""))
        self.assertIn("99.95 µs of 400 µs: still running", self.titles()[1])

    def test_without_friction(self):
        fake_run.write_run(self.folder)
        with h5py.File(self.folder / "history.h5", "r+") as file:
            for name in ("boundary/top/tangential_force", "friction/global", "energy/surface_drive",
                         "energy/friction_heat"):
                file[name][:] = 0
        self.assertEqual(self.run_main(), (0, ""))

    def test_body_that_lifts_off(self):
        fake_run.write_run(self.folder)
        with h5py.File(self.folder / "history.h5", "r+") as file:
            file["boundary/top/normal_force"][:] = 0
            file["friction/global"][:] = np.nan
        self.assertEqual(self.run_main(), (0, ""))

    def test_point_that_was_not_recorded(self):
        fake_run.write_run(self.folder)
        self.assertEqual(self.run_main("--point", "3"), (0, ""))

    def test_one_sentence_when_there_is_nothing_to_draw(self):
        code, said = self.run_main()
        self.assertEqual((code, said.count("\n")), (2, 1))
        self.assertIn("There is no history.h5", said)

    def test_one_sentence_when_the_window_is_outside_the_run(self):
        fake_run.write_run(self.folder, end=1e-4)
        code, said = self.run_main("--window", "2.5e-4", "4e-4")
        self.assertEqual((code, said.count("\n")), (2, 1))
        self.assertIn("Only 0 rows", said)

    def test_a_window_that_is_cut_is_said(self):
        fake_run.write_run(self.folder, end=1e-4)
        self.assertEqual(self.run_main("--window", "5e-5", "4e-4"), (0, ""))
        self.assertIn("the window 5e-05 to 0.0004 s reaches beyond", self.titles((5e-5, 4e-4))[1])

    def test_unknown_kind_of_picture(self):
        with self.assertRaises(SystemExit) as stop, contextlib.redirect_stderr(io.StringIO()) as said:
            picture.main([str(self.folder), "picture.foo"])
        self.assertEqual(stop.exception.code, 2)
        self.assertIn("should end in one of", said.getvalue())


if __name__ == "__main__":
    unittest.main()
