"""Standard errors from blocks, whether a run had settled, and the window that is taken where none is asked for."""

import unittest

import numpy as np

from slipscale.measuring.averages import block_error, error_of_mean, mean_of, ratio_of_means, settling, with_error
from slipscale.measuring.window import choose_window, cut_away, default_window
from slipscale.reading import UnreadableRun


class Errors(unittest.TestCase):
    def test_of_independent_rows(self):
        """σ/√n, within what ten blocks can tell: the deviation of ten numbers is uncertain by 1/√18."""
        rng = np.random.default_rng(3)
        found = [block_error(rng.standard_normal(1000), 10) for _ in range(200)]
        self.assertAlmostEqual(np.sqrt(np.mean(np.square(found))) * np.sqrt(1000), 1, delta=0.06)

    def test_of_known_blocks(self):
        # Means 0 to 9: deviation √(55/6), over √10; of five blocks √10/√5 of 1/2 …
        rows = np.repeat(np.arange(10.0), 4)
        self.assertAlmostEqual(block_error(rows, 10), np.sqrt(55 / 6) / np.sqrt(10))
        self.assertAlmostEqual(error_of_mean(rows), max(np.sqrt(55 / 6) / np.sqrt(10), 2 * np.sqrt(2.5) / np.sqrt(5)))

    def test_correlated_rows_have_the_larger_of_two(self):
        rng = np.random.default_rng(5)
        slow = np.repeat(rng.standard_normal(5), 200)
        self.assertAlmostEqual(error_of_mean(slow), np.std(slow.reshape(5, 200).mean(axis=1), ddof=1) / np.sqrt(5))

    def test_too_few_rows(self):
        self.assertTrue(np.isnan(mean_of(np.arange(9.0))[1]))

    def test_a_ratio_of_what_varies_together_has_no_error(self):
        normal = 2 + np.cos(np.arange(400.0))
        self.assertEqual(np.round(ratio_of_means(0.4 * normal, normal), 12).tolist(), [0.4, 0.0])
        self.assertTrue(np.isnan(ratio_of_means(normal, 0 * normal)[0]))

    def test_in_words(self):
        self.assertEqual(with_error(0.44712, 0.00134), "0.4471 ± 0.0013")
        self.assertEqual(with_error(74123.0, 25.0), "74123 ± 25")
        self.assertEqual(with_error(0.5, 0.0), "0.5")


class Settled(unittest.TestCase):
    time = np.arange(2000) * 1e-3

    def test_a_cycle_has_settled(self):
        found = settling(0.4 + 0.1 * np.sin(90 * self.time))
        self.assertTrue(found.settled)
        self.assertAlmostEqual(found.amplitude_ratio, 1, delta=0.05)

    def test_growth_drift_and_steady_sliding(self):
        self.assertFalse(settling(0.4 + 0.05 * np.exp(self.time) * np.sin(90 * self.time)).settled)
        self.assertFalse(settling(0.4 + 0.05 * self.time).settled)

    def test_a_small_vibration_that_grows_has_not_settled(self):
        def grown(amplitude, rate):
            return settling(0.4 + amplitude * np.exp(rate * self.time) * np.sin(90 * self.time)).settled

        for amplitude in (1e-4, 1e-7):
            self.assertFalse(grown(amplitude, 1), amplitude)  # by e from half to half
            self.assertTrue(grown(amplitude, 0.2), amplitude)  # nothing to speak of
            self.assertTrue(grown(amplitude, -1), amplitude)
        self.assertTrue(grown(1e-13, 1))  # rounding


class Window(unittest.TestCase):
    def test_the_second_half(self):
        time = np.linspace(0, 4e-4, 401)
        self.assertEqual(default_window(time), (2e-4, 4e-4))
        self.assertEqual(choose_window(time), (2e-4, 4e-4))
        self.assertEqual(choose_window(time, (1e-4, 9)), (1e-4, 4e-4))
        self.assertIn("the window 0.0001 to 9 s reaches beyond", cut_away(time, (1e-4, 9)))
        self.assertIn("reaches beyond", cut_away(time, (-1e-4, 1e-4)))
        self.assertEqual(cut_away(time, (0, 4e-4)), "")
        with self.assertRaisesRegex(UnreadableRun, "goes from 0.0002 to 0.0001 s: give the earlier time first"):
            choose_window(time, (2e-4, 1e-4))
        with self.assertRaisesRegex(UnreadableRun, "Only 1[01] rows"):
            choose_window(time, (1e-4, 1.1e-4))


if __name__ == "__main__":
    unittest.main()
