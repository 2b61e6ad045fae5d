"""What modes let expect, and the tables of other studies."""

import unittest
from pathlib import Path
from types import SimpleNamespace

from slipscale.mistakes import Mistake
from stability import outcomes, points
from stability.predicted import (COMPETE, EQUIVALENT, FREQUENCY, GROWTH, ONE_ONLY, QUIET, counted, cycle_takes, expected,
                                 growing, rival)

RUNS = Path(__file__).parents[2]


class Expected(unittest.TestCase):
    def test_modes_that_grow_and_their_rivals(self):
        modes = [SimpleNamespace(frequency=frequency, growth_rate=growth) for frequency, growth in
                 ((4e5, 2e4), (5e5, -1e3), (3e5, 3e4))]
        grow = growing(modes)
        self.assertEqual(grow, [(3e5, 3e4), (4e5, 2e4)])
        self.assertAlmostEqual(rival(grow), 2 / 3)
        self.assertEqual(rival([(3e5, 3e4), (3.05e5, 2e4)]), 0)  # the same mode twice

    def test_what_is_expected(self):
        one = [(3.5e5, 5e4), (5e5, 1e4)]
        like = [(3.6e5, 4.5e4)]
        self.assertEqual(expected([one, like], [one]), EQUIVALENT)
        self.assertEqual(expected([[], []], [[]]), QUIET)
        self.assertEqual(expected([one, like], [[]]), ONE_ONLY)
        self.assertEqual(expected([one, like], [[(3.5e5, 5e4), (5e5, 4e4)]]), COMPETE)
        self.assertEqual(expected([one, [(5e5, 5e4)]], [one]), COMPETE)
        self.assertEqual(expected([one, like], [[(4.1e5, 5e4)]]), FREQUENCY)
        self.assertEqual(expected([one, like], [[(3.5e5, 9e4)]]), GROWTH)

    def test_which_mode_a_cycle_takes(self):
        grow = [(3.5e5, 5e4), (5e5, 1e4)]
        self.assertEqual([cycle_takes(frequency, grow) for frequency in (3.6e5, 5.1e5, 10.0e5, 2e5)], [1, 2, -2, 0])

    def test_counting(self):
        self.assertEqual(counted([(True, True), (True, False), (True, True)]),
                         {(True, True): 2, (True, False): 1, (False, True): 0, (False, False): 0})


class OtherStudies(unittest.TestCase):
    def test_the_tables_of_their_readmes(self):
        swept = outcomes.swept(RUNS / "sweep" / "README.md")
        self.assertEqual(len(swept), 112)
        self.assertEqual({row["regime"] for row in swept}, {"steady", "slip-separated", "stick-slip-separated"})
        verdicts = outcomes.verdicts(RUNS / "equivalence" / "README.md")
        self.assertEqual(len(verdicts), 32)
        self.assertEqual(sum(row["verdict"] == "equivalent" for row in verdicts), 4)
        with self.assertRaisesRegex(Mistake, "does not say what was seen: there is no table with the columns"):
            outcomes.verdicts(RUNS / "sweep" / "README.md")

    def test_points(self):
        defaults = {"model": "plain", "block": "5x5", "seed": 1, "size": 0.25e-3, "coefficient": 0.5, "time": 0.6e-6}
        sweep = points.swept({"seen": RUNS / "sweep/README.md", "length": 1.2e-6, "coefficients": [0.5], "speeds": [2]},
                             defaults, str)
        self.assertEqual([row["options"]["time"] for row in sweep], [0.6e-6] * 2)
        judged = points.judged({"seen": RUNS / "equivalence/README.md", "memories": {
            "T0.6": {"time": 0.6e-6}, "L1.2": {"length": 1.2e-6}}, "seeds": {"5x5": [1, 2]}, "blocks": [1],
            "memory": ["L1.2"]}, defaults, str)
        self.assertEqual([row["composites"][0]["time"] for row in judged], [1.2e-6, 0.6e-6, 0.3e-6, 0.15e-6])
        self.assertEqual(len(points.named(judged)), 12)


if __name__ == "__main__":
    unittest.main()
