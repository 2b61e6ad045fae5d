"""What a run gave, from made-up files whose values are known."""

import tempfile
import unittest
from pathlib import Path

import numpy as np

from slipscale.mistakes import Mistake
from slipscale.planning.values import (averages, cycle_distance, stress, trajectory_distance, weighted_quantile,
                                       without_scatter)
from tests.fake_run import FREQUENCY, FRICTION, write_history, write_run

WINDOW = (2e-4, 4e-4)


class Values(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(temporary.cleanup)
        cls.run_folder = Path(temporary.name) / "run"
        write_run(cls.run_folder)
        write_history(cls.run_folder, 5e-8 * np.arange(8000))

    def test_averages_with_their_errors(self):
        found = averages(self.run_folder, WINDOW, ["friction", "frequency", "velocity"])
        self.assertAlmostEqual(found["friction"][0], FRICTION, delta=2e-3)
        self.assertTrue(0 < found["friction"][1] < 2e-3)  # of blocks
        self.assertAlmostEqual(found["frequency"][0] / FREQUENCY, 1, delta=2e-3)
        self.assertTrue(0 < found["velocity"][1] < 0.05 * found["velocity"][0])  # of parts

    def test_a_run_against_itself(self):
        for name in ("trajectory_displacement", "trajectory_velocity", "trajectory_normal_force"):
            self.assertEqual(trajectory_distance(self.run_folder, self.run_folder, (1e-5, 4e-5), name), 0.0)
        for name in ("spectrum", "portrait"):
            apart, floor = cycle_distance(self.run_folder, self.run_folder, WINDOW, name)
            self.assertEqual(apart, 0.0)
            self.assertGreater(floor, 0.0)

    def test_stress_of_a_region(self):
        with self.assertRaisesRegex(Mistake, "no region fibre"):
            stress(self.run_folder, WINDOW, "fibre")
        with self.assertRaisesRegex(Mistake, "frames in the window"):
            stress(self.run_folder, WINDOW, "matrix")

    def test_quantiles_count_by_area(self):
        values = np.array([[1.0, 2.0, 3.0]])
        self.assertEqual(weighted_quantile(values, np.array([1.0, 1.0, 1.0]), 0.5), 2.0)
        self.assertGreater(weighted_quantile(values, np.array([1.0, 1.0, 8.0]), 0.5), 2.7)

    def test_scatter_is_taken_off_distances(self):
        self.assertAlmostEqual(without_scatter(0.5, 0.3)[0], 0.4)
        self.assertEqual(without_scatter(0.2, 0.3)[0], 0.0)


if __name__ == "__main__":
    unittest.main()
