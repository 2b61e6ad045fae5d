"""Made-up sequences whose order and limit are known, and such as have none."""

import math
import unittest

import numpy as np

from refinement.orders import APART, CONVERGES, SETTLED, SHORT, STALLS, apart, found_in, refine, summary_rows

SIZES = (0.5, 0.25, 0.125, 0.1, 0.0625)
REFERENCE = 0.03125


def row(h, variant="x", along="size", **more):
    return {"sequence": "a", "variant": variant, "along": along, "unit": "1", "status": "ok", "size": h, "step": h,
            "seconds": h**-3, "node_steps": 7 * h**-3, **more}


def distances(errors, **more):
    return [row(h, kind="trajectory", quantity="velocity", error=error, **more) for h, error in zip(SIZES, errors)]


def averages(values, scatter=0.0, shared=0.0, **more):
    """`scatter` is the standard error of the change from one size to the next that counts, from four parts of the
    window; a wave over them, `shared`, is the same on all sizes."""
    found = []
    for h, value, sign in zip(SIZES, values, (1, -1, 1, 1, -1)):
        own = value + sign * scatter * np.sqrt(3) / 2 * np.array([1, -1, 1, -1]) + shared * np.array([1, 2, -1, -2])
        found.append(row(h, kind="average", quantity="friction", value=value, scatter=shared,
                         parts=" ".join(f"{part:.12g}" for part in own), **more))
    return found


class Distances(unittest.TestCase):
    def test_the_reference_shares_the_error(self):
        """A reference at half the finest size takes a quarter off an error of second order: its distance is no
        order."""
        for order in (1.0, 1.7, 2.0):
            found = refine(distances([0.3 * (h**order - REFERENCE**order) for h in SIZES]), REFERENCE)
            self.assertEqual(found.verdict, CONVERGES)
            np.testing.assert_allclose(found.orders, order, rtol=1e-9)
            self.assertAlmostEqual(found.order, order, delta=1e-9)
            self.assertAlmostEqual(found.bar, 0.3 * REFERENCE**order, delta=1e-12)
            # node-steps grow with h to the power -3
            self.assertAlmostEqual(math.log10(found.price()), 3 / order, delta=1e-9)

    def test_against_the_truth(self):
        found = refine(distances([0.3 * h**1.5 for h in SIZES]))
        self.assertEqual(found.verdict, CONVERGES)
        np.testing.assert_allclose(found.orders, 1.5, rtol=1e-12)
        self.assertTrue(math.isnan(found.bar))

    def test_against_other_meshes(self):
        """Their finest run is taken for the truth, but not by runs as fine as itself."""
        errors = [0.3 * h**1.5 for h in SIZES[:-1]] + [1e-6]
        found = refine(distances(errors), 0.05, own=False)
        np.testing.assert_allclose(found.orders, 1.5, rtol=1e-12)
        self.assertEqual(len(found.orders), 2)

    def test_no_convergence(self):
        for verdict, errors in ((APART, (1.34, 1.35, 1.38, 1.37, 1.35)),  # unrelated trajectories
                                (APART, (1.3, 1.2, 1.1, 0.9, 0.7)),  # falls, but still far away
                                (STALLS, (0.1, 0.05, 0.02, 0.02, 0.02)),
                                (STALLS, (0.1, 0.05, 0.02, 0.03, 0.01)),
                                (STALLS, (0.5, 0.47, 0.44, 0.43, 0.40))):  # slower than any order
            found = refine(distances(errors), REFERENCE)
            self.assertEqual(found.verdict, verdict, errors)
            for value in (found.order, found.bar, found.price()):
                self.assertTrue(math.isnan(value))

    def test_sizes_that_are_close_give_no_order(self):
        np.testing.assert_array_equal(apart(np.array(SIZES), 3), [0, 1, 2, 4])
        np.testing.assert_array_equal(apart(np.array([4, 3.5, 3, 2.9]), 2), [0, 1, 2, 3])
        jitter = [0.3 * (h - REFERENCE) for h in SIZES]
        jitter[3] *= 0.9  # at .1, between .125 and .0625
        np.testing.assert_allclose(refine(distances(jitter), REFERENCE).orders, 1, rtol=1e-9)

    def test_a_failed_run_is_left_out(self):
        rows = distances([0.3 * (h - REFERENCE) for h in SIZES], reference_h=REFERENCE)
        rows[1].update(status="failed", quantity=None)
        found = found_in(rows)
        self.assertEqual(len(found), 1)
        np.testing.assert_allclose(found[0].orders, 1, rtol=1e-9)

    def test_one_run_has_no_order(self):
        self.assertEqual(refine(distances([0.2]), REFERENCE).verdict, SHORT)


class Averages(unittest.TestCase):
    def test_order_and_limit(self):
        for order in (0.7, 1.0, 2.0):
            found = refine(averages([0.44 - 0.1 * h**order for h in SIZES], scatter=1e-9))
            self.assertEqual(found.verdict, CONVERGES)
            self.assertAlmostEqual(found.order, order, delta=1e-5)
            self.assertAlmostEqual(found.limit, 0.44, delta=1e-6)
            self.assertAlmostEqual(found.bar, 1.25 * 0.1 * SIZES[-1] ** order, delta=1e-5)
            np.testing.assert_allclose(found.errors, [0.1 * h**order for h in SIZES], rtol=1e-3)

    def test_no_higher_order_is_believed_than_the_schemes(self):
        found = refine(averages([0.44 - 0.1 * h**4 for h in SIZES]))
        self.assertAlmostEqual(found.order, 4, delta=1e-6)
        self.assertGreater(found.bar, 1.25 * 0.1 * SIZES[-1] ** 4)
        self.assertAlmostEqual(found.price(), 10**1.5, delta=1e-6)

    def test_changes_within_the_scatter_are_none(self):
        found = refine(averages([0.4300, 0.4340, 0.4376, 0.4380, 0.4370], scatter=0.002))
        self.assertEqual((found.verdict, found.limit), (SETTLED, 0.4370))
        self.assertAlmostEqual(found.bar, 0.0036, delta=1e-12)  # the range of those apart: .4340, .4376, .4370
        self.assertTrue(math.isnan(found.order))

    def test_what_all_sizes_share_is_no_scatter_of_a_change(self):
        """A slow wave moves the averages of all runs alike: an order stands out from it."""
        found = refine(averages([0.44 - 0.1 * h for h in SIZES], shared=0.05))
        self.assertEqual(found.verdict, CONVERGES)
        self.assertAlmostEqual(found.order, 1, delta=1e-9)

    def test_changes_beyond_the_scatter_without_an_order(self):
        found = refine(averages([0.43, 0.41, 0.42, 0.45, 0.40], scatter=0.0001))
        self.assertEqual(found.verdict, STALLS)
        for value in (found.order, found.limit, found.bar, found.price()):
            self.assertTrue(math.isnan(value))

    def test_a_drift_that_grows_has_no_limit(self):
        found = refine(averages(1 / np.sqrt(SIZES)))
        self.assertEqual(found.verdict, STALLS)

    def test_the_scatter_is_the_least_error_bar(self):
        found = refine(averages([0.44 - 0.1 * h**2 for h in SIZES], scatter=0.001))
        self.assertEqual(found.verdict, CONVERGES)
        self.assertAlmostEqual(found.bar, 0.001, delta=1e-9)  # more than 1.25 times 0.1 * 0.0625^2

    def test_known_limit(self):
        found = refine(averages([0.44 + 0.1 * h**1.5 for h in SIZES]), known=0.44)
        np.testing.assert_allclose(found.orders, 1.5, rtol=1e-9)
        self.assertEqual((found.verdict, found.limit, found.bar), (CONVERGES, 0.44, 0))

    def test_along_the_step(self):
        rows = [{**each, "size": 1.0, "along": "step"} for each in averages([1 + h for h in SIZES])]
        found = refine(rows[::-1])
        np.testing.assert_array_equal(found.h, SIZES)
        self.assertAlmostEqual(found.limit, 1, delta=1e-9)


class Tables(unittest.TestCase):
    def test_what_belongs_together(self):
        rows = [*averages([1 - h for h in SIZES]), *averages([2 - h for h in SIZES], variant="y"),
                *distances([h - REFERENCE for h in SIZES], reference_h=REFERENCE),
                row(0.03125, status="failed", quantity=None), row(0.03125, quantity=None)]
        found = summary_rows(found_in(rows[::-1]))
        self.assertEqual(sorted((each["variant"], each["quantity"], round(each["order"], 6)) for each in found),
                         [("x", "friction", 1), ("x", "velocity", 1), ("y", "friction", 1)])
        self.assertEqual({each["verdict"] for each in found}, {CONVERGES})


if __name__ == "__main__":
    unittest.main()
