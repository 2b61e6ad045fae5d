"""A search for values that are known: of a smooth function, a flat one, one that jumps and one that is not monotone."""

import unittest

import numpy as np

from slipscale.adapting.search import judge, refine, scan_values


def power(value):
    return 0.44 / (1 + value**2)


class Search(unittest.TestCase):
    def setUp(self):
        self.values = scan_values(1.0, 2.0, 7)

    def test_values_around_the_start(self):
        np.testing.assert_allclose(self.values, [0.125, 0.25, 0.5, 1, 2, 4, 8])

    def test_a_monotone_function_is_bracketed_and_met(self):
        found = np.array([power(value) for value in self.values])
        scan = judge(self.values, found, power(0.7))
        self.assertTrue(scan.monotone and not scan.flat)
        self.assertEqual(scan.brackets, [(0.5, 1.0)])
        asked = []

        def evaluate(value):
            asked.append(value)
            return power(value)
        value = refine(evaluate, power(0.7), (0.5, 1.0), (power(0.5), power(1.0)), 1e-3, 8)
        self.assertAlmostEqual(power(value) / power(0.7), 1, delta=1e-3)
        self.assertLessEqual(len(asked), 5)

    def test_what_is_never_reached_has_no_bracket(self):
        scan = judge(self.values, np.array([power(value) for value in self.values]), 0.5)
        self.assertEqual(scan.brackets, [])
        self.assertAlmostEqual(scan.highest, power(0.125))

    def test_flat_and_not_monotone(self):
        flat = judge(self.values, np.linspace(0.99, 1.01, 7), 1.0)
        self.assertTrue(flat.flat)
        bent = judge(self.values, np.array([1, 2, 3, 4, 3, 2, 1.0]), 2.5)
        self.assertFalse(bent.monotone)
        self.assertEqual(bent.brackets, [(0.25, 0.5), (2.0, 4.0)])

    def test_small_scatter_is_no_turn(self):
        self.assertTrue(judge(self.values, np.array([7, 6, 6.05, 5, 3, 1, 0.0]), 2).monotone)

    def test_failed_trials_are_left_out(self):
        scan = judge(self.values, np.array([np.nan, 6, np.nan, 4, 3, np.nan, 1]), 3.5)
        self.assertEqual(scan.brackets, [(1.0, 2.0)])
        self.assertTrue(judge(self.values, np.full(7, np.nan), 1.0).flat)

    def test_a_jump_is_closed_in_but_not_met(self):
        asked = []

        def jump(value):
            asked.append(value)
            return 3.0 if value < 0.73 else 1.0
        value = refine(jump, 2.0, (0.5, 1.0), (3.0, 1.0), 1e-3, 12)
        self.assertAlmostEqual(asked[-1], 0.73, delta=0.01)
        self.assertIn(jump(value), (1.0, 3.0))


if __name__ == "__main__":
    unittest.main()
