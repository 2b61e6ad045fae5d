"""Made-up waves along a contact, whose power and phase are known."""

import tempfile
import unittest
from pathlib import Path

import h5py
import numpy as np

from slipscale.adapting.relaxation import time_of_one_frequency
from slipscale.measuring.surface_motion import cross_spectrum, motion_of, surface_motion, tributary_shares
from slipscale.reading import UnreadableRun

OMEGA, SPEED, RELAXATION, PHASE = 2 * np.pi * 400e3, 2.0, 0.5e-6, 0.4
COEFFICIENT = 0.5
X = np.array([0.0, 1.0, 1.5, 3.0, 5.0]) * 1e-3
STRENGTH = COEFFICIENT * 0.5 * 6e6 * 1.2  # of the wave below, wherever on the surface


def wave(time):
    """Pressure, traction and velocity [n, nc] of a wave that runs along the surface, in slip, and of a weak
    overtone."""
    at = OMEGA * time[:, None] - 2 * np.pi * X / 4e-3
    lag, gain = np.arctan(OMEGA * RELAXATION), 1 / np.hypot(1, OMEGA * RELAXATION)
    pressure = 15e6 + 6e6 * np.cos(at)
    traction = COEFFICIENT * (15e6 + gain * 6e6 * np.cos(at - lag)) + 0.2e6 * np.cos(2.5 * at)
    return pressure, traction, 1.2 * np.cos(at + PHASE) + 0.1 * np.cos(2.5 * at)


class Motion(unittest.TestCase):
    def setUp(self):
        self.time = np.arange(3000) * 0.05e-6

    def test_a_wave_in_slip_tells_its_relaxation_time(self):
        found = motion_of(self.time, *wave(self.time), tributary_shares(X))
        self.assertAlmostEqual(found.frequency, 400e3, delta=1e3)
        self.assertAlmostEqual(found.phase, PHASE, delta=2e-3)
        self.assertAlmostEqual(found.strength(COEFFICIENT) / STRENGTH, 1, delta=2e-3)
        self.assertAlmostEqual(found.power - found.power_at_line, 0.5 * 0.2e6 * 0.1, delta=2e-3 * STRENGTH)
        time = time_of_one_frequency(found.omega, found.power_at_line, found.strength(COEFFICIENT), found.phase)
        self.assertAlmostEqual(time / RELAXATION, 1, delta=1e-2)

    def test_all_frequencies_together_are_the_mean_product(self):
        rng = np.random.default_rng(3)
        noise = np.convolve(rng.standard_normal(40000), np.ones(5) / 5, "same")[:, None]
        _, total = cross_spectrum(noise, 2 * noise, 1.0, np.ones(1))
        self.assertAlmostEqual(total.real[1:].sum() / (2 * np.var(noise)), 1, delta=0.03)

    def test_shares_of_the_length(self):
        np.testing.assert_allclose(tributary_shares(X), np.array([0.5, 0.75, 1.0, 1.75, 1.0]) / 5)
        np.testing.assert_allclose(tributary_shares(np.arange(4.0), width=4.0), 0.25)

    def test_from_a_folder(self):
        for every, sparse in ((1, False), (12, True)):
            with tempfile.TemporaryDirectory() as folder:
                folder, time = Path(folder), self.time[::every]
                pressure, traction, velocity = wave(time)
                columns = {"time": time, "normal_traction": pressure, "tangential_traction": traction,
                           "slip_rate": SPEED - velocity}
                with h5py.File(folder / "contact.h5", "w") as file:
                    file["x"] = X
                    for name, values in columns.items():
                        file.create_dataset(name, data=values, maxshape=(None, *values.shape[1:]), chunks=True)
                (folder / "run.yaml").write_text(f"surface_speed: {SPEED}\nrun: {{step: 5e-8, block_width: 5.0e-3}}\n")
                if sparse:
                    with self.assertRaisesRegex(UnreadableRun, "smaller contact_every"):
                        surface_motion(folder, (0, 1))
                else:
                    self.assertAlmostEqual(surface_motion(folder, (2e-5, 1e-4)).phase, PHASE, delta=5e-3)


if __name__ == "__main__":
    unittest.main()
