"""Errors of made-up runs whose limit, order, constant and scatter are known."""

import unittest

import numpy as np

from slipscale.planning.errors import Runs, between, fitted, posterior

SIZES = 0.25e-3 * 2.0 ** (-0.5 * np.arange(5))
SPEED = 1.0e-4  # s/m: step over size


def made(limit=0.44, constant=-0.04, order=2.0, step_constant=0.0, step_order=1.0, noise=0.0, seed=0, kinds=1):
    """Sizes with a step in proportion, then the second size with half and a quarter of the step; of each kind."""
    h = np.concatenate([SIZES, SIZES[[1, 1]]])
    step = SPEED * h * np.concatenate([np.ones(5), [0.5, 0.25]])
    h, step = np.tile(h, kinds), np.tile(step, kinds)
    kind = np.repeat(np.arange(kinds), 7)
    draw = np.random.default_rng(seed)
    value = (limit * (1 + constant * np.where(kind, 2.0, 1.0) * (h / SIZES[0])**order +
                      step_constant * (step / (SPEED * SIZES[0]))**step_order) + noise * limit * draw.standard_normal(len(h)))
    return Runs(h, step, kind, value, np.full(len(h), max(noise, 1e-6) * limit))


class Errors(unittest.TestCase):
    def test_order_and_constant(self):
        for order in (1.0, 1.5, 2.0):
            found = fitted(made(order=order))
            self.assertAlmostEqual(found.order_of()[0], order, delta=0.02)
            self.assertAlmostEqual(found.constant_of()[0], -0.04, delta=8e-4)
            self.assertAlmostEqual(np.mean(found.limit), 0.44, delta=2e-4)

    def test_two_kinds_have_their_own(self):
        found = fitted(made(order=2.0, kinds=2))
        self.assertAlmostEqual(found.constant_of(0)[0], -0.04, delta=5e-4)
        self.assertAlmostEqual(found.constant_of(1)[0], -0.08, delta=1e-3)

    def test_step_is_told_from_mesh(self):
        found = fitted(made(order=2.0, constant=0.02, step_constant=0.05))
        self.assertAlmostEqual(np.mean(found.step_amplitude) / 0.44, 0.05, delta=2e-3)
        mean = found.expected(SIZES[0], 0.5 * SPEED * SIZES[0])[0]
        self.assertAlmostEqual(mean, 0.02 + 0.025, delta=2e-3)

    def test_bounds_hold_as_often_as_they_say(self):
        """Over many sets of runs the error of a run on a finer mesh stays below its bound in at least nine of ten."""
        held = 0
        for seed in range(60):
            order, constant = (1.0, 1.5, 2.0)[seed % 3], (-0.05, 0.02, 0.1)[seed // 3 % 3]
            found = fitted(made(order=order, constant=constant, noise=0.005, seed=seed))
            h = SIZES[-1] / 1.5
            true = constant * (h / SIZES[0])**order + 0.005 * np.random.default_rng(1000 + seed).standard_normal()
            held += abs(true) <= found.bound(h, SPEED * h)
        self.assertGreaterEqual(held, 54)

    def test_scatter_that_errors_do_not_tell_is_seen(self):
        runs = made(noise=0.01, seed=3)
        runs.error[:] = 1e-5
        self.assertGreater(fitted(runs).time_scatter(), 0.004)

    def test_a_longer_window_scatters_less(self):
        found = fitted(made(constant=0.0, noise=0.01))
        self.assertAlmostEqual(found.time_scatter(4) / found.time_scatter(1), 0.5, delta=1e-12)
        self.assertLess(found.bound(SIZES[-1], SPEED * SIZES[-1], windows=16),
                        found.bound(SIZES[-1], SPEED * SIZES[-1]))

    def test_distances_to_the_finest_run(self):
        h, fine = SIZES[:4], SIZES[4]
        runs = Runs(h, SPEED * h, np.zeros(4), 0.3 * ((h / h[0])**1.5 - (fine / h[0])**1.5), 1e-4 * np.ones(4))
        found = fitted(runs, finest=(fine, SPEED * fine))
        self.assertAlmostEqual(found.expected(fine, SPEED * fine)[0], 0.3 * (fine / h[0])**1.5, delta=0.03)

    def test_posterior_of_a_line(self):
        """Against the least squares of a line, without a prior to speak of."""
        x = np.linspace(0, 1, 6)
        matrix, value = np.column_stack([np.ones(6), x]), 2 + 3 * x + np.array([1, -1, 1, 1, -1, -1])
        mean, covariance, _ = posterior(matrix, value, np.full(6, 4.0), np.zeros(2), np.full(2, 1e6))
        np.testing.assert_allclose(mean, np.linalg.lstsq(matrix, value, rcond=None)[0], rtol=1e-8)
        np.testing.assert_allclose(covariance, 4 * np.linalg.inv(matrix.T @ matrix), rtol=1e-6)

    def test_between_morphologies(self):
        draw = np.random.default_rng(5)
        values = 0.44 + 0.03 * draw.standard_normal(400) + 0.01 * draw.standard_normal(400)
        self.assertAlmostEqual(between(values, np.full(400, 0.01))[0], 0.03, delta=0.003)
        self.assertEqual(between([0.44, 0.44], [0.01, 0.01])[0], 0.0)
        self.assertTrue(np.isnan(between([0.44], [0.01])[0]))

    def test_nothing_is_relative_to_zero(self):
        with self.assertRaises(ValueError):
            fitted(Runs([1, 0.5], [1, 0.5], [0, 0], [0.1, 0.0], [0.1, 0.1]))


if __name__ == "__main__":
    unittest.main()
