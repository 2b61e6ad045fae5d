"""Averages and distances of made-up runs that are known."""

import tempfile
import unittest
from pathlib import Path

import h5py
import numpy as np

from refinement.refined import average_rows, distance_rows, trajectory_error
from slipscale.reading import UnreadableRun
from tests import fake_run

WINDOW = (2e-4, 3.9e-4)


class Refined(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        for name in ("own", "reference"):
            fake_run.write_run(self.folder / name)

    def change(self, dataset, values):
        """Overwrites what the run `own` recorded with values(time)."""
        with h5py.File(self.folder / "own" / "history.h5", "r+") as file:
            file[dataset][:] = values(file["time"][:], file[dataset][:])

    def rows(self, names, **more):
        return average_rows(self.folder / "own", WINDOW, names, **more)

    def distances(self, **wanted):
        found = distance_rows(self.folder / "own", self.folder / "reference", WINDOW, **wanted)
        return {(row["kind"], row["quantity"]): row["error"] for row in found}

    def test_average_and_unit(self):
        friction, frequency = self.rows(["friction", "frequency"])
        self.assertAlmostEqual(friction["value"], fake_run.FRICTION, delta=1e-3)
        self.assertAlmostEqual(frequency["value"] / fake_run.FREQUENCY, 1, delta=2e-3)
        self.assertEqual([(row["kind"], row["unit"]) for row in (friction, frequency)],
                         [("average", "1"), ("average", "Hz")])

    def test_scatter_is_the_error_of_the_mean_of_the_parts(self):
        # Four steps of the stick fraction, one for each part: deviation 0.1 √(5/3), over √4.
        def staircase(time, _):
            return 0.1 * np.floor(4 * (time - WINDOW[0]) / (WINDOW[1] - WINDOW[0]))

        self.change("contact/stick", staircase)
        row = self.rows(["stick"])[0]
        self.assertAlmostEqual(row["scatter"], 0.1 * np.sqrt(5 / 3) / 2, delta=1e-3)
        self.assertAlmostEqual(row["value"], 0.15, delta=1e-3)
        np.testing.assert_allclose([float(part) for part in row["parts"].split()], [0, 0.1, 0.2, 0.3], atol=1e-3)
        self.assertEqual(self.rows(["stick"], parts=1)[0]["scatter"], 0)

    def test_nothing_between_a_run_and_itself(self):
        found = self.distances(trajectories=["velocity", "normal_force"], distances=["spectrum", "portrait"])
        self.assertEqual(list(found), [("trajectory", "velocity"), ("trajectory", "normal_force"),
                                       ("distance", "spectrum"), ("distance", "portrait")])
        self.assertLess(max(found.values()), 1e-12)

    def test_a_trajectory_one_percent_too_large(self):
        self.change("points/0/u", lambda _, u: u * [1.01, 1.2])
        found = self.distances(trajectories=["displacement", "normal_displacement", "velocity"])
        np.testing.assert_allclose(list(found.values()), [0.01, 0.2, 0], rtol=1e-6, atol=1e-12)

    def test_rows_half_as_far_apart_are_compared_at_equal_times(self):
        fake_run.write_run(self.folder / "fine", spacing=2.5e-8)
        error = trajectory_error(self.folder / "fine", self.folder / "reference", WINDOW, "displacement")
        self.assertLess(error, 1e-12)

    def test_one_sentence(self):
        own, reference = self.folder / "own", self.folder / "reference"
        for words, call in (("no average speed", lambda: self.rows(["speed"])),
                            ("no average regime", lambda: self.rows(["regime"])),
                            ("no probe point 3", lambda: self.rows(["velocity"], point=3)),
                            ("no signal speed", lambda: self.distances(trajectories=["speed"])),
                            ("no distance shape", lambda: self.distances(distances=["shape"])),
                            ("let it end later", lambda: trajectory_error(own, reference, (3e-4, 5e-4), "velocity"))):
            with self.assertRaisesRegex(UnreadableRun, words):
                call()


if __name__ == "__main__":
    unittest.main()
