"""The spectrum of signals whose spectrum is known."""

import unittest

import numpy as np

from slipscale.measuring.spectrum import dominant_frequency, evenly_spaced, strongest_line, welch

RATE, SAMPLES, SEGMENT = 2e7, 4000, 1000  # Hz; bins of 20 kHz


def sinusoid(frequency, amplitude=1.0, phase=0.3):
    return amplitude * np.cos(2 * np.pi * frequency * np.arange(SAMPLES) / RATE + phase)


class Welch(unittest.TestCase):
    def test_power_of_a_sinusoid_on_a_bin(self):
        frequency, density = welch(sinusoid(4e5, amplitude=3.0), RATE, SEGMENT)
        np.testing.assert_allclose(density.sum() * frequency[1], 4.5, rtol=1e-12)
        peak = int(np.argmax(density))
        self.assertEqual(frequency[peak], 4e5)
        np.testing.assert_allclose(density[[peak - 1, peak, peak + 1]] * frequency[1], [0.75, 3.0, 0.75], rtol=1e-10)
        self.assertLess(density[peak + 2], 1e-20)  # a Hann window leaks into the next bin only

    def test_level_of_white_noise(self):
        noise = 0.2 * np.random.default_rng(7).standard_normal(400000)
        frequency, density = welch(noise, RATE, SEGMENT)
        self.assertEqual(len(frequency), SEGMENT // 2 + 1)
        np.testing.assert_allclose(density[1:-1].mean(), 2 * 0.04 / RATE, rtol=0.01)

    def test_mean_does_not_matter(self):
        signal = sinusoid(3.1e5)
        np.testing.assert_allclose(welch(signal + 5, RATE)[1], welch(signal, RATE)[1], atol=1e-18)

    def test_odd_segment_keeps_the_power(self):
        frequency, density = welch(sinusoid(25 * RATE / 999), RATE, 999)
        np.testing.assert_allclose(density.sum() * frequency[1], 0.5, rtol=1e-9)

    def test_refuses_a_segment_longer_than_the_signal(self):
        with self.assertRaises(ValueError):
            welch(sinusoid(4e5), RATE, SAMPLES + 1)


class DominantFrequency(unittest.TestCase):
    def test_between_bins(self):
        for true in (4.00e5, 4.03e5, 4.0999e5, 4.17e5):
            found = dominant_frequency(*welch(sinusoid(true), RATE, SEGMENT))
            self.assertAlmostEqual(found / true, 1, delta=2e-5)

    def test_higher_of_two_peaks(self):
        signal = sinusoid(3.55e5, 0.5) + sinusoid(7.1e5, 0.4)
        self.assertAlmostEqual(dominant_frequency(*welch(signal, RATE, SEGMENT)), 3.55e5, delta=20)

    def test_what_is_slower_than_the_window_can_tell_does_not_dominate(self):
        """A line of 2 kHz lasts .4 of a segment; one of .01 beside it is the strongest line, and not what dominates."""
        slow, line = sinusoid(2e3, 1.0), sinusoid(3.55e5, 0.01)
        self.assertEqual(dominant_frequency(*welch(slow + line, RATE)), 0)
        self.assertGreater(dominant_frequency(*welch(0.001 * slow + line, RATE)), 3.5e5)
        flat = np.where(np.arange(500) == 100, 1.0, 1e-3)
        flat[1] = 2.0
        self.assertEqual(strongest_line(np.arange(500.0), flat), 100.0)
        self.assertEqual(dominant_frequency(np.arange(500.0), flat), 0.0)

    def test_peak_in_the_last_bin(self):
        frequency, density = np.arange(10.0), np.arange(10.0)
        self.assertEqual(dominant_frequency(frequency, density), 9.0)


class EvenlySpaced(unittest.TestCase):
    def test_even_signal_is_left_alone(self):
        time = 1e-4 + np.arange(100) / RATE
        values, rate = evenly_spaced(time, time)
        self.assertIs(values, time)
        self.assertAlmostEqual(rate / RATE, 1, delta=1e-9)

    def test_last_row_at_the_end_of_the_run(self):
        time = np.append(np.arange(100) / RATE, 99.4 / RATE)
        values, rate = evenly_spaced(time, 3 * time)
        self.assertEqual(len(values), 100)
        np.testing.assert_allclose(values, 3 * np.arange(100) / RATE, atol=1e-18)
        self.assertAlmostEqual(rate / RATE, 1, delta=1e-9)


if __name__ == "__main__":
    unittest.main()
