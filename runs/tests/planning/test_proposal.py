"""The cheapest run that keeps the wishes, what a budget buys, and refusals, from made-up pilots."""

import unittest
from pathlib import Path

import numpy as np

from slipscale.planning import refusals
from slipscale.planning.case import case_of
from slipscale.planning.costs import Price
from slipscale.planning.errors import Runs, fitted
from slipscale.planning.pilots import Mesh, Pilot
from slipscale.planning.proposal import Scaling, Search, scaling_of
from tests.planning.test_case import BLOCK, SCENE

SIZES = 0.4e-3 * 2.0 ** (-0.5 * np.arange(5))
SPEED = 1e-4


def search(constant=0.1, noise=0.0, allowed=0.01):
    draw = np.random.default_rng(2)
    value = 0.44 * (1 + constant * (SIZES / SIZES[0])**2 + noise * draw.standard_normal(5))
    fit = fitted(Runs(SIZES, SPEED * SIZES, np.zeros(5), value, np.full(5, 0.44 * max(noise, 1e-6))))
    return Search({"friction": fit}, {"friction": allowed}, {"grid": Scaling(25e-6, SPEED)}, case_of(SCENE, BLOCK),
                  Price(0.1, 1e-6, 1e-8, 0.1), SIZES[0], (0.9, 0.45))


def pilot(h, regime="stick-slip-separated", frequency=380e3, settled=True):
    return Pilot("size", "grid", h, 0.9, None, Mesh(Path("mesh")), 1e-8, 1.0, settled=settled, regime=regime,
                 frequency=frequency)


class Proposals(unittest.TestCase):
    def test_the_cheapest_keeps_the_wish_and_no_coarser_does(self):
        one = search()
        best = one.cheapest()
        self.assertLessEqual(best.bounds["friction"], 0.01)
        self.assertLess(0.1 * (best.h / SIZES[0])**2, 0.01)  # what it is in truth
        coarser = one.with_bounds(one.candidate("grid", 0, best.h * 2**0.25, 0.9, 1))
        self.assertGreater(coarser.bounds["friction"], 0.01)

    def test_scatter_asks_for_a_longer_window(self):
        self.assertEqual(search(constant=0.02).cheapest().windows, 1)
        best = search(constant=0.02, noise=0.01).cheapest()
        self.assertGreater(best.windows, 3)  # (1.96 * .01 / .01)², and more for the mesh

    def test_a_tighter_wish_costs_more(self):
        self.assertGreater(search(allowed=0.002).cheapest().seconds, 5 * search(allowed=0.02).cheapest().seconds)

    def test_a_budget(self):
        one = search(allowed=0.001)
        small, large = one.best(5.0), one.best(50.0)
        self.assertLessEqual(small.seconds, 5.0)
        self.assertLess(large.bounds["friction"], small.bounds["friction"])
        self.assertIsNone(one.best(0.01))

    def test_scaling(self):
        found = scaling_of(SIZES, 25e-6 / SIZES**2, SPEED * SIZES)
        self.assertAlmostEqual(found.density, 25e-6)
        self.assertAlmostEqual(found.step, SPEED)


class Refusals(unittest.TestCase):
    def test_coulomb(self):
        self.assertIn("Coulomb", refusals.of_law(case_of({**SCENE, "friction_law": "coulomb"}, BLOCK)))
        self.assertIn("Coulomb", refusals.of_law(case_of({**SCENE, "friction_time": 0}, BLOCK)))
        self.assertIsNone(refusals.of_law(case_of(SCENE, BLOCK)))
        self.assertIsNone(refusals.of_law(case_of({**SCENE, "friction_law": "none"}, BLOCK)))

    def test_memory(self):
        """T = 0.1 µs: c_s T = 316 µm, two cells of 158 µm."""
        case = case_of(SCENE, BLOCK)
        self.assertIn("0.000158 m", refusals.of_memory(case, 0, 60, 0.5e-3, given=0.2e-3))
        self.assertIsNone(refusals.of_memory(case, 0, 60, 0.5e-3, given=0.15e-3))
        self.assertIn("more than 60", refusals.of_memory(case, 600, 60, case.memory_size()))
        self.assertIsNone(refusals.of_memory(case, 60, 60, case.memory_size()))
        self.assertIsNone(refusals.of_memory(case, 600, 60, 0.5 * case.memory_size()))  # it is not the memory

    def test_drawing(self):
        self.assertIsNone(refusals.of_drawing([pilot(h) for h in SIZES[:3]], "grid", []))
        self.assertIn("only 2 meshes of grid cells show one drawing and run, and an order needs 3: 400 µm moved. Wider gap",
                      refusals.of_drawing([pilot(h) for h in SIZES[:2]], "grid", ["400 µm moved"]))

    def test_regime(self):
        alike = [pilot(h) for h in SIZES]
        self.assertEqual(refusals.usable(alike), alike)
        self.assertIsNone(refusals.of_regime(alike, alike))
        coarse = [pilot(SIZES[0], "steady"), *alike[1:]]
        self.assertEqual(refusals.usable(coarse), alike[1:])
        for other in ({"regime": "slip"}, {"frequency": 1087e3}):
            jumps = [*alike[:3], pilot(SIZES[3], **other), alike[4]]
            self.assertIn("the regime changes", refusals.of_regime(refusals.usable(jumps), jumps))

    def test_window(self):
        case, good, bad = case_of(SCENE, BLOCK), pilot(1e-4), pilot(1e-4, settled=False)
        self.assertIsNone(refusals.of_window([good, good, bad], case))
        self.assertIn("2 of 3 runs", refusals.of_window([good, bad, bad], case))
        self.assertIn("-time_end 0.0008", refusals.of_window([bad, bad, bad], case))


if __name__ == "__main__":
    unittest.main()
