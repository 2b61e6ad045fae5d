"""Prices from made-up runs; steps with damping against the scheme's limit; what files hold."""

import unittest

import numpy as np

from slipscale.planning.costs import contact_rows, damped, disk, fitted_price, undamped


class Costs(unittest.TestCase):
    def test_a_price_is_found_again(self):
        nodes, steps = np.array([400, 800, 1600, 400]), np.array([10e3, 14e3, 20e3, 40e3])
        found = fitted_price(nodes, steps, 0.2 + steps * (2e-6 + 9e-9 * nodes))
        np.testing.assert_allclose([found.start, found.per_step, found.per_node], [0.2, 2e-6, 9e-9], rtol=1e-6)
        self.assertLess(found.spread, 1e-6)
        self.assertAlmostEqual(found(10000, 1e5), 0.2 + 1e5 * (2e-6 + 9e-5), delta=1e-6)

    def test_no_part_is_negative(self):
        nodes, steps = np.array([400, 800, 1600]), np.array([10e3, 14e3, 20e3])
        found = fitted_price(nodes, steps, 9e-9 * steps * nodes * np.array([1.0, 1.1, 1.3]))
        self.assertTrue(min(found.start, found.per_step, found.per_node) >= 0)

    def test_damping_shortens_the_step(self):
        """beta2 step (step + 2 b) omega² = 2 (include/slipscale/README.md): with b = 2 ns and a limit of 10 ns."""
        step = damped(10e-9, 2e-9)
        self.assertAlmostEqual(step * (step + 4e-9), 1e-16, delta=1e-22)
        self.assertAlmostEqual(undamped(step, 2e-9), 10e-9, delta=1e-18)

    def test_disk(self):
        options = {"history_interval": 1e-8, "contact_every": 100, "fields_interval": 1e-5}
        self.assertAlmostEqual(disk(options, 1000, 11, 1e-4, 1e-9, row=100),
                               1e4 * 100 + 1e3 * 11 * 124 + 330e3 + 11 * 84e3)
        self.assertAlmostEqual(disk({**options, "contact_sums": False}, 1000, 11, 1e-4, 1e-9, row=100),
                               1e4 * 100 + 1e3 * 11 * 68 + 330e3 + 11 * 84e3)

    def test_rows_of_the_contact_by_themselves(self):
        """A thousand, of a short run one in 25 steps."""
        self.assertEqual(contact_rows({}, 1e-4, 1e-9), 1000)
        self.assertAlmostEqual(contact_rows({"contact_every": "auto"}, 1e-5, 1e-9), 400)
        self.assertAlmostEqual(contact_rows({"contact_interval": 1e-7}, 1e-5, 1e-9), 100)


if __name__ == "__main__":
    unittest.main()
