"""When a promise counts as kept, and the mesh that it is held against."""

import tempfile
import unittest
from pathlib import Path

from plan.finer import finer_options
from plan.kept import judged, verdict
from plan.report import text_of
from tests.fake_run import write_run


class Kept(unittest.TestCase):
    def test_verdict(self):
        self.assertEqual(verdict(-0.01, 0.02, 0.0), {"within": True, "holds": True})
        self.assertEqual(verdict(0.025, 0.02, 0.003), {"within": False, "holds": True})
        self.assertEqual(verdict(-0.03, 0.02, 0.003), {"within": False, "holds": False})

    def test_a_run_against_itself(self):
        with tempfile.TemporaryDirectory() as folder:
            write_run(Path(folder) / "run")
            found = judged("friction", 0.01, Path(folder) / "run", Path(folder) / "run", (2e-4, 4e-4))
            self.assertAlmostEqual(found["value"], 0.44, delta=0.002)
            self.assertEqual((found["apart"], found["within"]), (0.0, True))
            self.assertGreater(found["finer_error"], 0)
            found = judged("trajectory_velocity", 0.01, Path(folder) / "run", Path(folder) / "run", None, (1e-5, 4e-5))
            self.assertEqual((found["apart"], found["holds"]), (0.0, True))

    def test_twice_finer(self):
        self.assertEqual(finer_options({"proposal": {"cell": "grid", "size": 1e-4}}), {"cell": "grid", "size": 5e-5})

    def test_report(self):
        row = {"scene": "load", "status": "ok", "reason": None, "wish": "friction", "wished": 0.02, "promised": 0.018,
               "value": 0.44, "finer": 0.45, "error": 0.001, "finer_error": 0.002, "apart": -0.0222, "within": False,
               "holds": True, "between_morphologies": None, "cell": "grid", "size": 1e-4, "step": 1e-8, "windows": 2,
               "pilot_seconds_announced": 3, "pilot_seconds": 2, "seconds_said": 10, "seconds": 14, "seconds_finer": 90,
               "memory_said": 5e7, "memory": 6e7, "disk_said": 1e6, "disk": 1.1e6}
        text = text_of([row, {"scene": "coulomb", "status": "refused", "reason": "no mesh"}],
                       {"load": {"what": "a load", "want": "friction:2%"}, "coulomb": {"what": "the law", "want": "x:1%"}})
        self.assertIn("Of 1 wishes 1 hold, 0 of them without", text)
        self.assertIn("within 30 % for 0 of 1 scenes", text)
        self.assertIn("| with its scatter |", text)
        self.assertIn("coulomb refused: no mesh", text)


if __name__ == "__main__":
    unittest.main()
