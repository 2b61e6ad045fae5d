"""Which runs the study makes of its knobs, and which of them none beats."""

import unittest

from slipscale.running.table import run_name
from tradeoff.front import front, within
from tradeoff.knobs import groups_of, reference_of, runs_of

CONFIG = {"defaults": {"case": "plain", "size": 100, "model": "whole", "young": 80}, "reference": {"size": 50},
          "knobs": {"sizes": {"size": [200, 100]}, "models": {"model": ["whole", "homogeneous-kubc"]}},
          "of_cases": {"plain": {}, "hard": {"young": 1000}}, "left_out": {"plain": ["models"]},
          "extremes": {"contrast": {"case": "hard", "model": ["whole", "homogeneous-kubc"], "young": [60, 80]}}}


class Knobs(unittest.TestCase):
    def test_runs_and_references(self):
        groups = groups_of(CONFIG)
        self.assertEqual(set(groups), {("plain", "sizes"), ("hard", "sizes"), ("hard", "models"), ("hard", "contrast")})
        self.assertEqual([run["young"] for run in groups["hard", "sizes"]], [1000, 1000])
        runs = runs_of(CONFIG)
        # plain: 200, 100 and 50; hard: the same, and the homogeneous block; four of the contrast
        self.assertEqual(len(runs), 3 + 3 + 1 + 4 + 1)  # the homogeneous block's reference keeps the model it is told to
        for name, run in runs.items():
            self.assertEqual(name, run_name(run))
        self.assertEqual(reference_of(CONFIG, {**CONFIG["defaults"], "size": 200})["size"], 50)

    def test_an_unknown_option(self):
        with self.assertRaisesRegex(ValueError, "unknown option 'siz'"):
            groups_of({**CONFIG, "knobs": {"sizes": {"siz": [1]}}})

    def test_front(self):
        rows = [{"seconds": 1, "off": -0.1}, {"seconds": 2, "off": 0.2}, {"seconds": 3, "off": 0.05},
                {"seconds": 4, "off": None}, {"seconds": 3, "off": 0.06}]
        self.assertEqual(front(rows, "seconds", "off"), [rows[0], rows[2]])
        known = [{**row, "bar": 0.12} for row in rows]  # what is nearer than its bar is no nearer than that
        self.assertEqual(front(known, "seconds", "off", "bar"), known[:1])
        self.assertEqual(within(rows, "seconds", "off", 0.07), rows[2])
        self.assertEqual(within(rows, "seconds", "off", 0.15), rows[0])
        self.assertIsNone(within(rows, "seconds", "off", 0.01))


if __name__ == "__main__":
    unittest.main()
