"""The power at one frequency against its mean over time, computed from the law of friction itself."""

import unittest

import numpy as np

from slipscale.adapting.relaxation import (most_power_of_one_frequency, power_of_one_frequency, scaled_time,
                                           time_of_one_frequency)

OMEGA, COEFFICIENT, PRESSURE, SWING, VELOCITY = 2 * np.pi * 357e3, 0.5, 15e6, 6e6, 1.3
STRENGTH = 0.5 * COEFFICIENT * SWING * VELOCITY


def mean_power(time, phase, samples=4096):
    """Mean of τv over a period, the traction from T dτ/dt = μp - τ integrated step by step (exact for p linear over a
    step) until it is periodic."""
    t = np.arange(60 * samples) * 2 * np.pi / OMEGA / samples
    p = PRESSURE + SWING * np.cos(OMEGA * t)
    x = (t[1] - t[0]) / time
    e, g = np.exp(-x), -np.expm1(-x) / x
    traction = np.full_like(t, COEFFICIENT * PRESSURE)
    for k in range(1, len(t)):
        traction[k] = e * traction[k - 1] + COEFFICIENT * ((1 - g) * p[k] + (g - e) * p[k - 1])
    last = slice(-samples, None)
    return np.mean(traction[last] * VELOCITY * np.cos(OMEGA * t[last] + phase))


class OneFrequency(unittest.TestCase):
    def test_power_of_the_law(self):
        for time, phase in ((0.6e-6, -0.8), (0.2e-6, 0.4), (2.5e-6, -2.0)):
            self.assertAlmostEqual(power_of_one_frequency(OMEGA, time, STRENGTH, phase) / mean_power(time, phase), 1,
                                   delta=1e-5)

    def test_the_root_returns_the_time(self):
        for phase in (-0.3, 0.0, 0.4, 1.2, 2.5):
            for time in (0.1e-6, 0.6e-6, 2.5e-6):
                power = power_of_one_frequency(OMEGA, time, STRENGTH, phase)
                other = (1 - STRENGTH * np.cos(phase) / power) / (OMEGA**2 * time)  # the product of both is known
                expected = min(root for root in (time, other) if root > 0)
                self.assertAlmostEqual(time_of_one_frequency(OMEGA, power, STRENGTH, phase) / expected, 1, places=9)
        self.assertAlmostEqual(time_of_one_frequency(
            OMEGA, power_of_one_frequency(OMEGA, 0.6e-6, STRENGTH, 0.4), STRENGTH, 0.4), 0.6e-6, places=15)

    def test_no_power(self):
        self.assertAlmostEqual(time_of_one_frequency(OMEGA, 0.0, STRENGTH, 0.7), 1 / np.tan(0.7) / OMEGA, places=15)
        self.assertIsNone(time_of_one_frequency(OMEGA, 0.0, STRENGTH, -0.7))

    def test_more_than_can_pass_has_no_root(self):
        for phase in (-1.0, 0.3):
            most, least = most_power_of_one_frequency(STRENGTH, phase)
            self.assertIsNone(time_of_one_frequency(OMEGA, 1.001 * most, STRENGTH, phase))
            self.assertIsNotNone(time_of_one_frequency(OMEGA, 0.999 * most, STRENGTH, phase))
            self.assertIsNone(time_of_one_frequency(OMEGA, least - 0.001 * most, STRENGTH, phase))
        self.assertAlmostEqual(most_power_of_one_frequency(STRENGTH, -1.0)[0], STRENGTH / 2 * (1 + np.cos(1.0)),
                               delta=1e-6 * STRENGTH)

    def test_scaling(self):
        self.assertAlmostEqual(scaled_time(0.6e-6, 400e3, 300e3), 0.8e-6, places=15)
        self.assertIsNone(scaled_time(0.6e-6, 400e3, 0.0))


if __name__ == "__main__":
    unittest.main()
