"""The text and the picture of a made-up study: what converges and what does not, prices, drawings, failures."""

import contextlib
import io
import tempfile
import unittest
from pathlib import Path

from refinement import picture as refinement_picture
from refinement.findings import report
from slipscale.running.table import read_csv, write_csv
from tests import fake_run

SIZES = (0.5e-3, 0.25e-3, 0.125e-3)
REFERENCE = 0.0625e-3


def base(h, variant, **more):
    return {"sequence": "before", "variant": variant, "along": "size", "scene": "r", "family": "block", "size": h,
            "step": 2e-5 * h, "status": "ok", "reason": None, "quantity": None, "run": f"{variant}_{h:g}",
            "nodes": round(25e-6 / h**2), "steps": round(10 / h), "node_steps": 25e-5 / h**3, "seconds": 2e-12 / h**3,
            **more}


def rows():
    """A velocity of second order, one that stays √2 apart, an average of first order."""
    found = []
    for h in SIZES:
        found += [base(h, "good", kind="trajectory", quantity="velocity", unit="1", reference_h=REFERENCE,
                       error=4e5 * (h**2 - REFERENCE**2)),
                  base(h, "bad", kind="trajectory", quantity="velocity", unit="1", reference_h=REFERENCE, error=1.41),
                  base(h, "good", kind="average", quantity="friction", unit="1", value=0.44 + 40 * h, scatter=1e-3)]
    return found + [base(REFERENCE, "bad", status="failed", reason="it fell")]


class Report(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)

    def through_a_file(self, table):
        write_csv(self.folder / "table.csv", table)
        return read_csv(self.folder / "table.csv")

    def test_lines(self):
        text = report(self.through_a_file(rows()))
        for words in ("| good | velocity | 0.098 | 0.023 | 0.0047 | 2.0, 2.0 | 0.0016 | 32 times |",
                      "| bad | velocity | 1.410 | 1.410 | 1.410 | no convergence | - | - |",
                      "| good | friction | 0.4600 | 0.4500 | 0.4450 | 1.0 | 0.4400 ± 0.0062 | 0.001 | 1000 times |",
                      "|  | node-steps | 2e+06 | 1.6e+07 | 1.3e+08 |", "|  | seconds | 0.016 | 0.13 | 1 |",
                      "**before: scene r, meshes block, element size and time step refined together**",
                      "sequence before, variant bad, family block, size 6.25e-05, step 1.25e-09: it fell"):
            self.assertIn(words, text)
        self.assertIn("| 0.5 mm | 0.25 mm | 0.125 mm |", text)

    def test_folded(self):
        table = rows() + [{**row, "sequence": "after"} for row in rows()]
        text = report(self.through_a_file(table), ["after"])
        self.assertIn("<summary>before: scene r", text)
        self.assertIn("**after: scene r", text)

    def test_several_families(self):
        table = [{**row, "family": {"good": "squares", "bad": "discs"}[row["variant"]]} for row in rows()]
        self.assertIn("meshes squares and discs, element", report(self.through_a_file(table)))

    def test_the_step_alone(self):
        table = [{**row, "along": "step", "size": 1e-4, "reference_h": 2e-5 * REFERENCE} for row in rows()]
        text = report(self.through_a_file(table))
        self.assertIn("time step refined, element size 0.1 mm", text)
        self.assertIn("| 10 ns | 5 ns | 2.5 ns | order |", text)
        self.assertIn("| good | velocity | 0.098 | 0.023 | 0.0047 |", text)

    def test_drawings(self):
        drawn = {"inclusions": 7, "inclusion_fraction": 0.3, "moved": 0, "redrawn": 0, "dropped": 0}
        same = [{**row, **drawn} for row in rows()]
        self.assertIn("the same drawing on all 3 meshes, 7 inclusions", report(self.through_a_file(same)))
        for row in same[:3]:  # all of the coarsest mesh
            row.update(moved=2)
        self.assertIn("Block: not the same drawing on all 3 meshes", report(self.through_a_file(same)))
        self.assertIn("moved or dropped at 0.0005 m (2 mended)", report(self.through_a_file(same)))

    def picture(self, *words):
        with contextlib.redirect_stderr(io.StringIO()) as said:
            code = refinement_picture.main([str(self.folder / "table.csv"), words[0], str(self.folder / "picture.png"),
                                            *words[1:]])
        return code, said.getvalue()

    def test_picture(self):
        self.through_a_file(rows())
        self.assertEqual(self.picture("before"), (0, ""))
        plain = (self.folder / "picture.png").stat().st_size
        for h in SIZES[:2]:
            fake_run.write_run(self.folder / "run" / f"good_{h:g}")
        portraits = ("--variants", "good", "--size", "0.5e-3", "0.25e-3", "--window", "3e-4", "4e-4")
        self.assertEqual(self.picture("before", *portraits), (0, ""))
        self.assertGreater((self.folder / "picture.png").stat().st_size, 1.1 * plain)

    def test_one_sentence_where_there_is_nothing_to_draw(self):
        self.through_a_file(rows())
        for words in (("after",), ("before", "--variants", "good", "--size", "7")):
            code, said = self.picture(*words)
            self.assertEqual((code, said.count("\n")), (2, 1))


if __name__ == "__main__":
    unittest.main()
