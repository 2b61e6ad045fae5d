"""What a made-up run did, whose numbers are known."""

import tempfile
import unittest
from pathlib import Path

import h5py
import numpy as np

from slipscale.measuring.regime import MEASURES, costs, friction_spectrum, measures, regime
from slipscale.measuring.window import FEWEST_FOR_MEANS
from slipscale.reading import UnreadableRun
from tests import fake_run

WINDOW = (2.5e-4, 3.9e-4)


class Regime(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = Path(cls.temporary.name)
        fake_run.write_run(cls.folder)

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def test_averages_over_the_window(self):
        found = measures(self.folder, WINDOW)
        self.assertEqual(set(found), set(MEASURES))
        self.assertAlmostEqual(found["friction"], fake_run.FRICTION, delta=1e-3)
        self.assertAlmostEqual(found["frequency"], fake_run.FREQUENCY, delta=500)
        self.assertAlmostEqual(found["normal_force"], fake_run.NORMAL, delta=0.01 * fake_run.NORMAL)
        # .03 cos and noise of .004, of a wave that has grown to 1 - exp(-5 … -7.8)
        self.assertAlmostEqual(found["amplitude"], np.hypot(0.03 / np.sqrt(2), 0.004), delta=2e-4)
        for name, share in (("stick", 0.1), ("slip", 0.65), ("open", 0.25)):
            self.assertAlmostEqual(found[name], share, delta=2e-3)
        self.assertAlmostEqual(found["displacement"], 2.4e-6, delta=2e-8)
        self.assertAlmostEqual(found["displacement_deviation"], 0.8e-6 / np.sqrt(2), delta=1e-8)
        self.assertAlmostEqual(found["power_ratio"], 0.1, places=12)
        self.assertAlmostEqual(found["drive_power"], fake_run.FRICTION * fake_run.NORMAL * fake_run.SPEED, delta=500)
        self.assertIs(found["settled"], True)
        self.assertAlmostEqual(found["amplitude_ratio"], 1, delta=0.02)
        self.assertEqual(found["regime"], "stick-slip-separated")

    def test_rounding_has_no_frequency(self):
        with tempfile.TemporaryDirectory() as folder:
            fake_run.write_run(Path(folder))
            with h5py.File(Path(folder) / "history.h5", "r+") as file:
                force = file["boundary/top/tangential_force"]
                force[...] = 1e-12 * force[...]
            self.assertEqual(measures(folder, WINDOW)["frequency"], 0)

    def test_every_mean_has_its_error(self):
        """Ten blocks of a cosine and of noise: of the noise of friction, .004/√2800; of a share's .05 cos, which ten
        whole blocks leave little of, less than its deviation over √(periods)."""
        found = measures(self.folder, WINDOW)
        self.assertLess(found["friction_error"], 4 * 0.004 / np.sqrt(2800))
        self.assertGreater(found["friction_error"], 0.25 * 0.004 / np.sqrt(2800))
        for name, most in (("stick", 0.05 / np.sqrt(50)), ("slip", 0.1 / np.sqrt(50)), ("open", 0.05 / np.sqrt(50)),
                           ("normal_force", 0.1 * fake_run.NORMAL / np.sqrt(50))):
            self.assertTrue(0 < found[f"{name}_error"] < most, name)
        for name in ("power_into_body", "drive_power"):
            self.assertAlmostEqual(found[f"{name}_error"] / found[name], found["friction_error"] / found["friction"],
                                   delta=1e-3)
        self.assertLess(found["power_ratio_error"], 1e-12)  # one is a tenth of the other in every row

    def test_settled_is_the_rule_of_the_summary(self):
        with tempfile.TemporaryDirectory() as folder:
            fake_run.write_run(Path(folder))
            with h5py.File(Path(folder) / "history.h5", "r+") as file:
                time, force = file["time"][()], file["boundary/top/tangential_force"]
                force[...] = fake_run.NORMAL * (0.4 + 0.01 * np.exp(time / 1e-4) * np.cos(2e6 * time))
            found = measures(folder, WINDOW)
            self.assertIs(found["settled"], False)
            self.assertAlmostEqual(found["amplitude_ratio"], np.exp(0.7), delta=0.03)  # over half of 140 µs

    def test_few_rows_tell_what_they_can(self):
        found = measures(self.folder, (3.99e-4, 4.5e-4), fewest=FEWEST_FOR_MEANS)  # 20 rows
        self.assertAlmostEqual(found["friction"], fake_run.FRICTION, delta=0.05)
        self.assertIsNone(found["frequency"])
        self.assertIsNotNone(found["friction_error"])
        self.assertIsNone(measures(self.folder, (3.9965e-4, 4.5e-4), fewest=FEWEST_FOR_MEANS)["friction_error"])

    def test_names_of_regimes(self):
        self.assertEqual([regime(*shares) for shares in ((0, 0), (0.2, 0), (0, 0.2), (0.2, 0.2), (0.001, 0.001))],
                         ["slip", "stick-slip", "slip-separated", "stick-slip-separated", "slip"])

    def test_an_edge_that_is_open_for_good_vibrates_not(self):
        self.assertEqual(regime(0, 0.1, amplitude=2e-3, friction=0.3, power_ratio=1e-3), "steady")
        self.assertEqual(regime(0, 0.1, amplitude=4e-3, friction=0.3, power_ratio=1e-3), "slip-separated")
        self.assertEqual(regime(0, 0.5, amplitude=2e-3, friction=0.3, power_ratio=0.2), "slip-separated")

    def test_spectrum_ends_where_it_is_told_to(self):
        frequency, amplitude = friction_spectrum(self.folder, WINDOW, highest=1e6)
        self.assertTrue(frequency[-1] <= 1e6 < frequency[-1] + 2 * frequency[1])
        self.assertAlmostEqual(frequency[np.argmax(amplitude)], fake_run.FREQUENCY, delta=frequency[1])

    def test_too_few_rows(self):
        with self.assertRaisesRegex(UnreadableRun, "let the run go on"):
            measures(self.folder, (3.99e-4, 4.5e-4))

    def test_costs_of_a_run_that_has_no_summary_yet(self):
        with self.assertRaisesRegex(UnreadableRun, "run it again"):
            costs(self.folder)


if __name__ == "__main__":
    unittest.main()
