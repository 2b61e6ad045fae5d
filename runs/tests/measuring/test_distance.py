"""Distances of signals whose distance is known."""

import unittest

import numpy as np

from slipscale.measuring.distance import mean_spectrum, portrait_distance, relative_l2, spectrum_distance

TIME = np.linspace(0, 1, 4001)


class Signals(unittest.TestCase):
    def test_relative_l2(self):
        self.assertAlmostEqual(relative_l2([3.0, 5.0], [3.0, 4.0]), 0.2, places=14)
        self.assertTrue(np.isnan(relative_l2([1.0], [0.0])))

    def test_unrelated_phases_are_root_two_apart(self):
        sine, cosine = np.sin(40 * np.pi * TIME), np.cos(40 * np.pi * TIME)
        self.assertAlmostEqual(relative_l2(sine, cosine), np.sqrt(2), delta=1e-3)

    def test_spectra_on_different_frequencies(self):
        fine, coarse = np.linspace(0, 10, 101), np.linspace(0, 10, 11)
        self.assertAlmostEqual(spectrum_distance((fine, 3 * fine), (coarse, 2 * coarse)), 0.5, places=12)
        frequency, amplitude = mean_spectrum([(coarse, coarse), (fine, 3 * fine)])
        np.testing.assert_allclose(amplitude, 2 * frequency, rtol=1e-12)


class Portraits(unittest.TestCase):
    def setUp(self):
        angle = np.linspace(0, 40 * np.pi, 20000)
        self.circle = np.cos(angle) * 1e-6 + 3e-6, np.sin(angle)

    def test_nothing_between_a_portrait_and_itself_at_other_times(self):
        angle = np.linspace(0.3, 0.3 + 60 * np.pi, 17000)
        other = np.cos(angle) * 1e-6 + 3e-6, np.sin(angle)
        self.assertLess(portrait_distance(other, self.circle), 2e-3)

    def test_a_shift_by_a_deviation(self):
        shifted = self.circle[0] + np.std(self.circle[0]), self.circle[1]
        self.assertAlmostEqual(portrait_distance(shifted, self.circle), 2 / np.pi, delta=2e-3)

    def test_same_region_visited_otherwise(self):
        """Every point of each cloud has a neighbour in the other, which a nearest-point distance would take for
        equal."""
        u, v = self.circle
        left = np.concatenate([np.tile(u[u < 3e-6], 9), u]), np.concatenate([np.tile(v[u < 3e-6], 9), v])
        self.assertGreater(portrait_distance(left, self.circle), 0.2)

    def test_a_resting_reference_has_no_scale(self):
        self.assertTrue(np.isnan(portrait_distance(self.circle, (np.zeros(5), np.zeros(5)))))


if __name__ == "__main__":
    unittest.main()
