"""Tables whose orders, exponents and errors are known, and the columns read from effective.yaml."""

import contextlib
import io
import tempfile
import unittest
from pathlib import Path

import yaml

from accuracy import work_precision
from accuracy.work_precision import Study, change, power_of
from slipscale.reading import UnreadableRun
from slipscale.reading.effective import read_effective, relative_errors, square_symmetric
from slipscale.running.table import write_csv

BASE = 50e6  # bytes


def row(size, element="triangle", solver="default", rtol=1e-10, repeat=1, **more):
    """A run whose time is proportional to the unknowns, whose memory exceeds BASE by a power of 1.5 of them."""
    unknowns = 2 * size**2
    return {"element": element, "size": size, "solver": solver, "rtol": rtol, "repeat": repeat, "status": "ok",
            "reason": None, "unknowns": unknowns, "seconds": 1e-5 * unknowns * repeat,
            "set_up_seconds": 2e-6 * unknowns, "solve_seconds": 5e-6 * unknowns, "memory": BASE + 0.1 * unknowns**1.5,
            "method": "preonly + cholesky" if solver == "direct" or size < 50 else "cg + gamg", "iterations": 20,
            "C11": 3.0 * (1 + rtol), "C12": 1.0, "C66": 1.0, "error_C11": 0.3 / size**2, **more}


ROWS = [row(128), row(16, memory=BASE), row(64), row(64, repeat=2), row(64, rtol=1e-2), row(64, rtol=1e-4),
        row(128, solver="direct"), row(64, "quadrilateral"), row(64, "grid"),
        row(256, status="failed", seconds=None)]


class Curves(unittest.TestCase):
    def test_what_belongs_together(self):
        study = Study(ROWS)
        sizes = [[entry["size"] for entry in rows] for rows in (
            study.over_size("triangle"), study.iterative("triangle"), study.over_size("triangle", "direct"),
            study.over_size("quadrilateral"))]
        self.assertEqual(sizes, [[16, 64, 128], [64, 128], [128], [64]])
        self.assertEqual([entry["rtol"] for entry in study.over_tolerance()], [1e-2, 1e-4, 1e-10])
        self.assertEqual([entry["repeat"] for entry in study.over_size("triangle")], [1, 1, 1])

    def test_powers(self):
        study = Study(ROWS)
        rows = study.over_size("triangle")
        self.assertAlmostEqual(power_of(rows, "seconds").exponent, 1, delta=1e-12)
        self.assertEqual(study.least_memory(), BASE)
        self.assertAlmostEqual(power_of(rows, "memory", BASE).exponent, 1.5, delta=1e-9)
        self.assertIsNone(power_of(study.over_size("quadrilateral"), "seconds"))

    def test_change_is_the_largest_of_the_moduli(self):
        tight = row(64)
        self.assertAlmostEqual(change({**tight, "C12": 1.0 - 3e-4, "C66": 1.0 + 1e-4}, tight), 3e-4, delta=1e-12)

    def test_needs_a_run_that_is_ok(self):
        with self.assertRaisesRegex(UnreadableRun, "reason"):
            Study([row(64, status="failed")])


class Picture(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)

    def main(self, rows):
        write_csv(self.folder / "table.csv", rows)
        (self.folder / "study.yaml").write_text(yaml.safe_dump({"orientation": [
            {"name": "another code", "unknowns": [1000, 9000], "seconds": [1, 9], "error": [1e-3, 1e-4],
             "megabytes": [100, 300]}, {"name": "a third", "seconds": [7], "error": [2e-3]}]}))
        with contextlib.redirect_stderr(io.StringIO()) as said:
            code = work_precision.main([str(self.folder / name) for name in ("table.csv", "picture.png")]
                                       + ["--orientation", str(self.folder / "study.yaml")])
        return code, said.getvalue()

    def test_whole_and_partial_tables(self):
        for rows in (ROWS, [row(16)], [row(64, "quadrilateral", rtol=1e-2)]):
            self.assertEqual(self.main(rows), (0, ""))
            self.assertGreater((self.folder / "picture.png").stat().st_size, 20000)

    def test_legends_tell_the_exponents(self):
        axes = work_precision.draw(ROWS).axes
        legends = [[text.get_text() for text in panel.get_legend().get_texts()] for panel in axes]
        self.assertIn("triangles, multigrid: exponent 1.00", legends[1])
        self.assertIn("triangles, multigrid: exponent 1.50", legends[2])
        self.assertIn("fitted grid, multigrid", legends[1])
        self.assertIn("64 across, solver tolerance 1e-02 to 1e-10", legends[0])

    def test_one_sentence_when_every_run_failed(self):
        code, said = self.main([row(64, status="failed")])
        self.assertEqual((code, said.count("\n")), (2, 1))


class Effective(unittest.TestCase):
    REPORT = """stiffness: [5.7e+10, 5.9e+10, 2.3e+10, 1.5e+10, 1e+4, -2e+4]  # Pa
homogenize:
  boundary: kubc
  cells: 12
  ranks: 2
  periodic:
    cost: {solver: none, unknowns: 1, iterations: [99, 99, 99], set_up_seconds: 9, solve_seconds: [9, 9, 9]}
  kubc:
    cost: {solver: cg + gamg, unknowns: 50, iterations: [3, 7, 5], set_up_seconds: 0.5, solve_seconds: [1, 2, 1e-1]}
  memory: 1.5e+07  # B
  seconds: 4
"""

    def test_columns(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "effective.yaml"
            path.write_text(self.REPORT)
            found = read_effective(folder)
            self.assertEqual(found, {
                "unknowns": 50, "cells": 12, "ranks": 2, "method": "cg + gamg", "iterations": 7, "set_up_seconds": 0.5,
                "solve_seconds": 3.1, "seconds": 4.0, "memory": 1.5e7, "C11": 5.7e10, "C22": 5.9e10, "C12": 2.3e10,
                "C66": 1.5e10, "C16": 1e4, "C26": -2e4})
            for line in ("  memory", "  boundary", "stiffness"):
                path.write_text("".join(text for text in self.REPORT.splitlines(True) if not text.startswith(line)))
                with self.assertRaisesRegex(UnreadableRun, "run it again"):
                    read_effective(folder)

    def test_errors(self):
        moduli = square_symmetric({"C11": 57.0, "C22": 59.0, "C12": 22.0, "C66": 15.0})
        self.assertEqual(moduli, {"C11": 58.0, "C12": 22.0, "C66": 15.0})
        found = relative_errors(moduli, {"C11": "5.8e+1", "C12": 20})
        self.assertEqual(found["error_C11"], 0)
        self.assertAlmostEqual(found["error_C12"], 0.1, delta=1e-15)


if __name__ == "__main__":
    unittest.main()
