"""Matching growing modes: what counts as near, and that the search finds the parameters of made-up modes."""

import math
import unittest

from slipscale.adapting.mode_match import misfit, nearest
from slipscale.reading.modes import Mode

FASTEST = Mode(400e3, 5e4, 0, 0, {})


def mode(frequency, growth):
    return Mode(frequency, growth, 0, 0, {})


class Misfit(unittest.TestCase):
    def test_the_same_modes_have_none(self):
        self.assertEqual(misfit([(FASTEST, FASTEST)], []), 0)

    def test_growth_counts_by_the_fastest_and_frequency_by_a_twentieth(self):
        self.assertAlmostEqual(misfit([(FASTEST, mode(400e3, 4e4))], []), 0.2)
        self.assertAlmostEqual(misfit([(FASTEST, mode(404e3, 5e4))], []), 0.2)
        slow = mode(600e3, 1e4)  # a fifth of the weight
        self.assertAlmostEqual(misfit([(FASTEST, FASTEST), (slow, mode(600e3, 2e4))], []), math.sqrt(0.2 * 0.04 / 1.2))

    def test_no_partner_and_a_stray_mode_count_as_wholly_wrong(self):
        self.assertEqual(misfit([(FASTEST, None)], []), 1)
        self.assertEqual(misfit([(FASTEST, mode(800e3, 9e5))], []), 1)
        self.assertEqual(misfit([(FASTEST, FASTEST)], [6e4]), 1)
        self.assertAlmostEqual(misfit([(FASTEST, FASTEST)], [1e4]), 0.2)
        with self.assertRaises(ValueError):
            misfit([], [])


class Nearest(unittest.TestCase):
    def bowl(self, **found):
        """Of logarithms, with its floor at the parameters that are given."""
        self.calls = 0

        def evaluate(at):
            self.calls += 1
            off = [math.log(at[name] / value) for name, value in found.items()]
            return math.hypot(*off, *(0.5 * (one - other) for one, other in zip(off, off[1:]))) + 0.1

        return evaluate

    def test_one_parameter(self):
        at, value = nearest(self.bowl(time=3.1e-7), {"time": 1e-6}, (1, 0.25, 0.5, 2, 4), 40)
        self.assertAlmostEqual(at["time"] / 3.1e-7, 1, delta=3e-3)
        self.assertAlmostEqual(value, 0.1, delta=3e-3)
        self.assertLess(self.calls, 35)

    def test_three_parameters(self):
        truth = {"time": 8e-7, "coefficient": 0.45, "density": 1900}
        at, value = nearest(self.bowl(**truth), {"time": 6e-7, "coefficient": 0.5, "density": 1800}, (1, 0.5, 2), 150)
        for name, expected in truth.items():
            self.assertAlmostEqual(at[name] / expected, 1, delta=1e-2, msg=name)

    def test_where_nothing_can_be_evaluated(self):
        self.assertEqual(nearest(lambda at: math.inf, {"time": 1.0}, (1, 2), 10)[1], math.inf)

    def test_no_further_than_it_makes_sense(self):
        at, _ = nearest(self.bowl(time=1e-3), {"time": 1e-6}, (1, 2, 4), 60)
        self.assertLessEqual(at["time"], 20.001e-6)

    def test_no_more_evaluations_than_asked_for(self):
        nearest(self.bowl(time=1e-9), {"time": 1.0}, (1, 2), 7)
        self.assertLessEqual(self.calls, 2 + 7 + 2)


if __name__ == "__main__":
    unittest.main()
