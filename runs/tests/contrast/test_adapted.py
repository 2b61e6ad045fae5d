"""Rows of an adaptation, and of which its best level is."""

import tempfile
import unittest
from pathlib import Path

import yaml

from contrast.adapted import COMPARED, adapted_rows, before_of, best_level, cases_of, left_by

OPTIONS = {"young": 300, "diameter": 1.0, "size": 0.125, "seed": 2, "way": "time"}


def distances(spectrum):
    return {"folder": f"trial-{spectrum}", **{name: 0.5 for name in COMPARED}, "spectrum_distance": spectrum}


class Adapted(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.outcome = Path(temporary.name) / "outcome.yaml"
        self.write(reason=None, status="ok")
        (self.outcome.parent / "adapt.yaml").write_text(yaml.safe_dump({
            "before": distances(1.4), "nearest": {"value": 2.4e-6, **distances(0.6)}, "levels": {
                "scaling": {"status": "ok", "reason": None, "value": 5e-7, "after": distances(0.8)},
                "frequency": {"status": "failed", "reason": "no root", "surface": {"homogeneous": {"time_seen": 1e-6}}},
                "search": {"status": "ok", "reason": None, "value": 1.8e-6, "match": "power",
                           "after": distances(0.7)}}}, sort_keys=False))

    def write(self, **end):
        self.outcome.write_text(yaml.safe_dump({"options": OPTIONS, "wall_seconds": 3.0, **end}))

    def test_a_row_for_each_level_and_the_nearest_trial(self):
        rows = adapted_rows(self.outcome)
        self.assertEqual([(row["level"], row["status"], row.get("after_spectrum_distance")) for row in rows],
                         [("scaling", "ok", 0.8), ("frequency", "failed", None), ("search", "ok", 0.7),
                          ("nearest", "ok", 0.6)])
        self.assertEqual({row["model"] for row in rows}, {"adapted"})
        self.assertEqual(rows[1]["time_seen_homogeneous"], 1e-6)

    def test_the_best_level_of_a_case(self):
        cases = cases_of([{**dict.fromkeys(("after_spectrum_distance",)), **row} for row in adapted_rows(self.outcome)])
        best = best_level(cases[300, 1.0, 0.125, 2], "time")
        self.assertEqual((best["level"], best["folder"]), ("search", "trial-0.7"))
        self.assertEqual(before_of(cases[300, 1.0, 0.125, 2]), 1.4)
        self.assertEqual([left_by(cases[300, 1.0, 0.125, 2], way) for way in ("time", "damping")], [0.7, float("inf")])
        self.assertIsNone(best_level(cases[300, 1.0, 0.125, 2], "damping"))

    def test_what_was_not_started_is_one_row(self):
        self.write(status="failed", reason="the run was not started: no mesh")
        rows = adapted_rows(self.outcome)
        self.assertEqual([(row["status"], row["reason"]) for row in rows],
                         [("failed", "the run was not started: no mesh")])
        self.assertEqual(cases_of(rows), {})


if __name__ == "__main__":
    unittest.main()
