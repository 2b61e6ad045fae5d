"""Two made-up runs side by side: what is the same within scatter, what differs, and by what option."""

import contextlib
import io
import tempfile
import unittest
from pathlib import Path

import h5py

from slipscale import command
from slipscale.measuring.comparing import changed_options, difference, differences, distances, read_all
from slipscale.reading import UnreadableRun
from slipscale.reports import compare
from tests import fake_run


class Compared(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folders = [Path(temporary.name) / name for name in ("one", "two", "rougher")]
        for folder in self.folders:
            fake_run.write_run(folder)
        with h5py.File(self.folders[2] / "history.h5", "r+") as file:
            file["boundary/top/tangential_force"][:] *= 1.1
        text = (self.folders[2] / "run.yaml").read_text()
        (self.folders[2] / "run.yaml").write_text(text.replace("coefficient: 0.5", "coefficient: 0.55"))

    def test_differences_against_scatter(self):
        one, two, rougher = read_all(self.folders)
        self.assertAlmostEqual(one.window[0], 2e-4, delta=1e-7)
        same, other = (difference(run.means["friction"], one.means["friction"]) for run in (two, rougher))
        self.assertEqual((same.value, same.differs), (0, False))
        self.assertAlmostEqual(other.value, 0.1 * one.means["friction"][0], delta=1e-12)
        self.assertTrue(other.differs)
        self.assertFalse(difference(rougher.means["normal_force"], one.means["normal_force"]).differs)
        self.assertEqual(distances(two, one)["spectrum"][0], 0)
        self.assertAlmostEqual(distances(rougher, one)["spectrum"][0], 0.1, delta=1e-9)
        self.assertGreater(distances(rougher, one)["portrait"][1], 0)
        self.assertEqual(changed_options([one, two, rougher]), {"friction_coefficient": [0.5, 0.5, 0.55]})

    def test_rounding_is_no_difference(self):
        """Blocks that are equal to the last bit have no error, yet sums are known to 1e-10 of what is summed only."""
        self.assertFalse(difference((2.0, 0.0), (2.0 + 1e-12, 0.0)).differs)
        self.assertTrue(difference((2.0, 0.0), (2.0 + 1e-8, 0.0)).differs)
        self.assertLess(difference((2.0, 0.0), (2.1, 1e-14)).value / difference((2.0, 0.0), (2.1, 1e-14)).error, 1e10)
        self.assertIsNone(difference((2.0, float("nan")), (2.0, 0.0)).differs)
        one, two = read_all(self.folders[:2])
        for run, force in ((one, 1e-9), (two, -3e-9)):  # of a normal force of 7.5e4 N/m: no friction at all
            run.means["tangential_force"] = force, 1e-20
        self.assertFalse(differences(two, one)["tangential_force"].differs)
        two.means["slip"], one.means["slip"] = (0.9, 0.0), (1.0, 0.0)
        self.assertEqual([compare.judged(differences(two, one)[name]) for name in ("tangential_force", "slip")],
                         ["-4e-09, neither scatters: the same to rounding", "-0.1, neither scatters: differs"])

    def test_the_command(self):
        said, picture = io.StringIO(), self.folders[0].parent / "a b.png"
        with contextlib.redirect_stdout(said):
            code = command.main(["compare", *map(str, self.folders), "--picture", str(picture)])
        self.assertEqual(code, 0)
        for words in ("rougher less one", "differs", "the same", "friction_coefficient", "settled"):
            self.assertIn(words, said.getvalue())
        self.assertGreater(picture.stat().st_size, 50000)

    def test_what_a_window_and_a_run_lack_is_said(self):
        (self.folders[1] / "run.yaml").write_text("time_end: 8e-4\n")
        said = io.StringIO()
        with contextlib.redirect_stdout(said):
            self.assertEqual(command.main(["compare", *map(str, self.folders[:2]), "--window", "1e-4", "1e-3"]), 0)
        for name in ("one", "two"):
            self.assertIn(f"note on {name}: the window 0.0001 to 0.001 s reaches beyond", said.getvalue())
        self.assertIn("note on two: the run has reached 399.9 µs of 800 µs: still running", said.getvalue())
        self.assertEqual(read_all(self.folders[::2])[0].notes, ())

    def test_a_window_that_runs_backwards_is_refused_by_every_command(self):
        one = str(self.folders[0])
        for words in (["compare", one, one], ["picture", one, "p.png"], ["wear", one, "w", "--energy", "1"],
                      ["adapt", one, one, "--output", "a"], ["sweep", "scene.yaml"],
                      ["plan", "scene.yaml", "--recipe", "r.yaml", "--want", "friction:1%"]):
            said = io.StringIO()
            with self.subTest(words), contextlib.redirect_stderr(said), self.assertRaises(SystemExit) as stop:
                command.main([*words, "--window", "2e-4", "1e-4"])
            self.assertEqual(stop.exception.code, 2)
            self.assertRegex(said.getvalue(), r"--window: goes from 0.0002 to 0.0001 s: give the earlier time first [^\n]*\n$")

    def test_one_run_is_no_comparison(self):
        with self.assertRaisesRegex(UnreadableRun, "two folders"):
            read_all(self.folders[:1])


if __name__ == "__main__":
    unittest.main()
