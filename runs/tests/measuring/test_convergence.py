"""Orders, limits and exponents of sequences for which they are known exactly."""

import math
import unittest

import numpy as np

from slipscale.measuring.convergence import fit_power, observed_order, observed_orders, orders_from_errors, richardson

UNEVEN = np.array([0.5, 0.25, 0.1, 0.0625])


def sequence(h, order, limit=56.954, slope=-3.0):
    return limit + slope * np.asarray(h) ** order


class Orders(unittest.TestCase):
    def test_from_errors(self):
        for order in (0.5, 1, 2, 3.7):
            np.testing.assert_allclose(orders_from_errors(UNEVEN, -4 * UNEVEN**order), order, rtol=1e-13)

    def test_no_order_where_an_error_vanishes(self):
        found = orders_from_errors([4, 2, 1, 0.5], [1, 0.25, 0, 0.1])
        self.assertEqual(found[0], 2)
        self.assertTrue(np.isnan(found[1:]).all())

    def test_without_the_limit(self):
        for h in ([0.4, 0.2, 0.1], [0.25, 0.1, 0.0625], [1, 0.9, 0.1]):
            for order in (-1, 0.3, 1, 2, 4):
                self.assertAlmostEqual(observed_order(h, sequence(h, order)), order, delta=1e-9)

    def test_logarithm_is_the_order_zero(self):
        h = [0.25, 0.1, 0.0625]
        self.assertAlmostEqual(observed_order(h, np.log(h)), 0, delta=1e-10)

    def test_of_every_three(self):
        np.testing.assert_allclose(observed_orders(UNEVEN, sequence(UNEVEN, 2)), [2, 2], rtol=1e-9)
        # h + h^2 is between its two orders and tends to the lower one.
        h = 0.5 ** np.arange(4, 14)
        found = observed_orders(h, h + h**2)
        self.assertTrue(np.all((1 < found) & (found < 2)) and np.all(np.diff(found) < 0))
        self.assertAlmostEqual(found[-1], 1 + 1.5 * h[-2] / math.log(2), delta=2 * h[-3] ** 2)

    def test_no_order_outside_the_asymptotic_range(self):
        for values in ([1, 2, 1.5], [1, 1, 1], [1, 2, 2], [2, 2, 1]):
            self.assertTrue(math.isnan(observed_order([4, 2, 1], values)), values)

    def test_refuses_sizes_that_do_not_fall(self):
        for h in ([1, 2, 3], [2, 2, 1], [2, 1, 0], [2, 1, -1]):
            with self.assertRaises(ValueError):
                observed_order(h, [1, 2, 3])
            with self.assertRaises(ValueError):
                orders_from_errors(h, [1, 2, 3])


class Richardson(unittest.TestCase):
    def test_exact_for_one_power(self):
        for order in (1, 2, 3.5):
            found = richardson(UNEVEN, sequence(UNEVEN, order), order)
            self.assertAlmostEqual(found.limit, 56.954, delta=1e-12)
            self.assertAlmostEqual(found.error, -3 * UNEVEN[-1] ** order, delta=1e-12)

    def test_trapezium_rule_becomes_simpsons(self):
        def trapezium(intervals):
            x = np.linspace(0, 1, intervals + 1)
            return np.trapz(x**3, x)

        self.assertAlmostEqual(richardson([1, 0.5], [trapezium(1), trapezium(2)], 2).limit, 0.25, delta=1e-15)

    def test_refuses_what_gives_no_limit(self):
        for h, order in (([1.0], 2), ([2.0, 1.0], 0), ([2.0, 1.0], float("nan"))):
            with self.assertRaises(ValueError):
                richardson(h, np.ones(len(h)), order)


class FitPower(unittest.TestCase):
    def test_exact_power(self):
        x = np.array([3.0, 50.0, 700.0, 2e4])
        power = fit_power(x, 0.02 * x**1.3)
        self.assertAlmostEqual(power.exponent, 1.3, delta=1e-13)
        self.assertAlmostEqual(power.factor, 0.02, delta=1e-13)
        self.assertLess(power.spread, 1e-13)
        np.testing.assert_allclose(power(10.0), 0.02 * 10**1.3, rtol=1e-12)

    def test_scatter(self):
        # Factors e^1, e^-2, e^1 at x = 1, e, e^2: a line through them keeps the slope, and misses by sqrt(6/1/2).
        power = fit_power(np.exp([0, 1, 2]), np.exp([1, 2 - 2, 4 + 1]))
        self.assertAlmostEqual(power.exponent, 2, delta=1e-14)
        self.assertAlmostEqual(power.spread, math.sqrt(3), delta=1e-14)

    def test_two_points_have_no_spread(self):
        power = fit_power([1, 10], [5, 500])
        self.assertAlmostEqual(power.exponent, 2, delta=1e-14)
        self.assertTrue(math.isnan(power.spread))

    def test_refuses_what_has_no_power(self):
        for x, y in (([1], [1]), ([2, 2], [1, 3]), ([1, 2], [0, 1]), ([1, -2], [1, 1])):
            with self.assertRaises(ValueError), np.errstate(all="ignore"):
                fit_power(x, y)


if __name__ == "__main__":
    unittest.main()
