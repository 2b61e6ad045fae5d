"""Exponents of signals that are sums of exponentials, and the rows in which motion is linear."""

import unittest
from types import SimpleNamespace

import numpy as np

from slipscale.measuring.growth import exponents, linear_stretch, seen
from slipscale.reading import OPEN, SLIP, STICK

MODES = np.array([2e4 + 2e6j, -3e4 + 3.4e6j, 1e4 + 3.5e6j])
SHAPES = np.array([[1, 0.5j, -0.3], [0.1, 0.2, 0.3j], [0.02, 0.05, 0.01j]])
INTERVAL = 2e-7


def signals(rows):
    return (np.exp(MODES[None, :] * INTERVAL * np.arange(rows)[:, None]) @ SHAPES).real


class Growth(unittest.TestCase):
    def test_exponents_of_three_modes(self):
        found = exponents(signals(150), INTERVAL, 1e-10)
        self.assertEqual(len(found.p), 3)
        for mode in MODES:
            self.assertLess(abs(found.nearest(mode) - mode) / abs(mode), 1e-9)
        self.assertEqual(found.p[0], found.nearest(MODES[0]))  # the largest at the end
        np.testing.assert_allclose(found.size[0], 0.5 * np.exp(MODES[0].real * INTERVAL * 149), rtol=1e-6)
        np.testing.assert_allclose(found.frequency[0], 2e6 / (2 * np.pi), rtol=1e-9)

    def test_noise_is_left_out(self):
        noisy = signals(150) + 1e-7 * np.random.default_rng(1).standard_normal((150, 3))
        found = exponents(noisy, INTERVAL, 1e-4)
        self.assertLess(abs(found.p[0] - MODES[0]) / abs(MODES[0]), 1e-5)

    def test_few_rows_are_refused(self):
        with self.assertRaises(ValueError):
            exponents(signals(20), INTERVAL)

    def test_longest_stretch_without_stick_or_change(self):
        status = np.full((100, 3), SLIP)
        status[:30, 0] = STICK
        status[60:, 2] = OPEN
        self.assertEqual(linear_stretch(status), slice(60, 100))
        status[80:, 1] = STICK
        self.assertEqual(linear_stretch(status), slice(30, 60))
        self.assertIsNone(linear_stretch(status, fewest=31))
        self.assertIsNone(linear_stretch(np.full((100, 3), STICK)))

    def test_seen_in_a_contact(self):
        """About a state that is not zero, with an open node, whose motion is left aside."""
        rows = 200
        u = np.zeros((rows, 4, 2))
        u[:, :3, 0], u[:, 3, 0] = 7.0 + signals(rows), np.random.default_rng(2).standard_normal(rows)
        status = np.full((rows, 4), SLIP)
        status[:, 3] = OPEN
        contact = SimpleNamespace(time=INTERVAL * np.arange(rows), status=status, u=u)
        for noise in (1e-9, None):  # None: what rounding about the state that is not zero leaves
            found, used = seen(contact, begin=50 * INTERVAL, noise=noise)
            self.assertEqual(used, slice(50, 200))
            self.assertLess(abs(found.p[0] - MODES[0]) / abs(MODES[0]), 1e-8)
        contact.time = np.append(contact.time[:-1], contact.time[-2] + 0.3 * INTERVAL)  # as at the end of a run
        found, used = seen(contact, begin=50 * INTERVAL, noise=1e-9)
        self.assertEqual(used, slice(50, 199))
        self.assertLess(abs(found.p[0] - MODES[0]) / abs(MODES[0]), 1e-8)
        status[:, 0] = STICK
        self.assertIsNone(seen(contact))

    def test_what_hardly_moves_about_a_large_displacement(self):
        """Rounding of the displacement, 1e7 times the motion, is not taken for modes."""
        rows = 400
        u = np.zeros((rows, 3, 2))
        u[:, :, 0] = 1e7 + signals(rows)
        contact = SimpleNamespace(time=INTERVAL * np.arange(rows), status=np.full((rows, 3), SLIP), u=u)
        found, _ = seen(contact, most=400)
        self.assertLess(abs(found.p[0] - MODES[0]) / abs(MODES[0]), 1e-5)
        self.assertLess(len(found.p), 8)


if __name__ == "__main__":
    unittest.main()
