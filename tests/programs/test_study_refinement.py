"""The refinement study in small: orders, what is run again, a failure as a row, another family of meshes by one
file."""

import csv
import math
import subprocess

import yaml

import studies
from slipscale.running.commands import words

GEO = """DefineConstant[ h = 1e-3 ];
Point(1) = {0, 0, 0, h}; Point(2) = {10e-3, 0, 0, h}; Point(3) = {10e-3, 5e-3, 0, h}; Point(4) = {0, 5e-3, 0, h};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
Curve Loop(1) = {1, 2, 3, 4}; Plane Surface(1) = {1};
Physical Surface("block") = {1}; Physical Curve("bottom") = {1}; Physical Curve("top") = {3};
"""


class Refinement(studies.StudyCase):
    study = "refinement"

    def rows(self, sequence, variant, quantity):
        return [row for row in self.table() if (row["sequence"], row["variant"], row["quantity"]) ==
                (sequence, variant, quantity)]

    def errors(self, *what):
        return [float(row["error"]) for row in self.rows(*what)]

    def test_refinement_and_what_is_run_again(self):
        self.run_study()
        self.assertEqual({row["status"] for row in self.table()}, {"ok"})
        # The paper's claim: trajectories under Coulomb friction are not those of a finer mesh (√2: unrelated), under
        # the regularised law they tend to them. The contact loses O(h) in impacts, so the order is 1 or more.
        self.assertGreater(min(self.errors("before", "coulomb", "velocity")), 0.8)
        errors = self.errors("before", "T300", "velocity")
        self.assertEqual(len(errors), 3)
        self.assertTrue(errors[0] > 2 * errors[1] > 4 * errors[2] > 0, errors)
        orders = self.read("orders.csv")
        verdicts = {(row["variant"], row["quantity"]): row for row in orders if row["sequence"] == "before"}
        self.assertEqual(verdicts["coulomb", "velocity"]["verdict"], "no convergence")
        self.assertEqual(verdicts["T300", "velocity"]["verdict"], "converges")
        self.assertGreater(float(verdicts["T300", "velocity"]["order"]), 1)
        # Friction cannot exceed its coefficient on average; the frequency is that of the block's squeal.
        for friction, frequency in zip(self.rows("cycle", "T600", "friction"), self.rows("cycle", "T600", "frequency")):
            self.assertTrue(0.4 < float(friction["value"]) < 0.505, friction)
            self.assertAlmostEqual(float(frequency["value"]) / 382e3, 1, delta=0.05)
        for row in self.table():
            self.assertEqual(int(row["node_steps"]), int(row["nodes"]) * int(row["steps"]))
            self.assertLess(float(row["energy_residual"]), 1e-9)
            self.assertGreater(float(row["seconds"]), 0)
        for name in ("before", "cycle"):
            self.assertGreater((self.out / "picture" / name / "picture.png").stat().st_size, 50000)
        self.assertIn("| coulomb | velocity |", (self.out / "report.md").read_text())

        # A size more is a run more, for each variant that asks for it; a step that is too long fails and is a row.
        before = self.written()
        self.assertIn("Nothing to be done", self.run_study())
        sequences = [dict(sequence) for sequence in self.reduced["sequences"]]
        sequences[0].update(size=[1e-3, *sequences[0]["size"]])
        sequences[1].update(name="unstable", size=0.5e-3, step=[1e-8, 1e-6], distances=[], averages=["friction"])
        del sequences[1]["step_per_size"]
        self.run_study(sequences=sequences)
        self.assertEqual(self.run_again(before), {
            "mesh/wide_0.001", "run/undamped_wide_coulomb_0.001_2e-08", "run/undamped_wide_T300_0.001_2e-08",
            "run/damped_block_T600_0.0005_1e-06", "picture/before", "picture/unstable"})
        failed = [row for row in self.table() if row["status"] != "ok"]
        self.assertEqual([(row["sequence"], row["step"], row["quantity"]) for row in failed],
                         [("unstable", "1e-06", "")])
        self.assertIn("stable", failed[0]["reason"])
        self.assertIn(failed[0]["reason"], (self.out / "report.md").read_text())

    def read(self, name):
        return csv.DictReader((self.out / name).read_text().splitlines())

    def test_other_meshes_by_one_file(self):
        """Halved by `slide` or meshed anew, equal squares give equal trajectories; a .geo, a .msh and a scene
        in a file serve as well."""
        study = yaml.safe_load((studies.RUNS / self.study / "study.yaml").read_text())
        wide = study["families"]["wide"]
        (self.folder / "block.geo").write_text(GEO)
        subprocess.run([self.folder / "programs/morphology", *words({**wide["morphology"], "size": 0.5e-3}).split(),
                        "-output_folder", self.folder / "drawn"], check=True, stdout=subprocess.DEVNULL)
        sequence = {**self.reduced["sequences"][0], "variants": "T300", "size": [0.5e-3, 0.25e-3],
                    "reference": {"family": "wide", "size": 0.125e-3}, "portraits": {}}
        families = {
            "halved": {**wide, "refine_from": 0.5e-3},
            "geo": {"file": str(self.folder / "block.geo")},
            "ready": {"files": {0.5e-3: str(self.folder / "drawn/mesh.msh"), 0.25e-3: "nowhere.msh"}}}
        (self.folder / "scene.yaml").write_text(yaml.safe_dump(study["scenes"]["undamped"]["options"]))
        scenes = {"written": {"file": str(self.folder / "scene.yaml"), "sample": 10e-9}}
        self.run_study(families=families, scenes=scenes, sequences=[
            *({**sequence, "name": name, "family": name} for name in ("wide", *families)),
            {**sequence, "name": "written", "scene": "written",
             "reference": {**sequence["reference"], "scene": "undamped"}}])
        self.assertEqual(self.errors("written", "T300", "velocity"), self.errors("wide", "T300", "velocity"))
        wide, halved, geo = (self.errors(name, "T300", "velocity") for name in ("wide", "halved", "geo"))
        for own, other in zip(wide, halved):
            self.assertTrue(math.isclose(own, other, rel_tol=1e-4), (wide, halved))
        self.assertEqual([row["nodes"] for row in self.rows("wide", "T300", "velocity")],
                         [row["nodes"] for row in self.rows("halved", "T300", "velocity")])
        self.assertTrue(0 < geo[1] < geo[0] < 1, geo)
        self.assertFalse((self.out / "mesh/halved_0.00025").exists())

        rows = [row for row in self.table() if row["sequence"] == "ready"]
        self.assertEqual([(row["size"], row["status"]) for row in rows], [("0.0005", "ok"), ("0.00025", "failed")])
        self.assertEqual(float(rows[0]["error"]), wide[0])
        self.assertIn("nowhere.msh", rows[1]["reason"])

    def test_the_same_composite_on_every_mesh(self):
        """composite.yaml with other sizes says whether all meshes show the same drawing."""
        changes = yaml.safe_load((studies.RUNS / self.study / "composite.yaml").read_text())
        self.out = self.folder / changes["output"]
        sequence = {**changes["sequences"][0], "variants": "T600", "window": [5e-6, 10e-6], "step_per_size": 1.5e-5}
        changes["scenes"]["composite"]["options"]["time_end"] = 10e-6
        changes["families"]["coarse"] = changes["families"]["composite"]  # for whose meshes discs have to be moved
        changes["sequences"] = [{**sequence, "size": [0.1e-3, 0.08e-3]},
                                {**sequence, "name": "coarse", "family": "coarse", "size": [0.3e-3, 0.1e-3]}]
        self.run_study(**changes)
        self.assertEqual({row["status"] for row in self.table()}, {"ok"})
        text = (self.out / "report.md").read_text()
        for said in ("Composite: the same drawing on all 2 meshes", "Coarse: not the same drawing on all 2 meshes"):
            self.assertIn(said, text)


if __name__ == "__main__":
    studies.main()
