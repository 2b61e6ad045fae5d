"""The study of homogenize's accuracy in small: what its table holds, what is run again, and what a failure leaves."""

import studies
from slipscale.measuring.convergence import orders_from_errors


class Accuracy(studies.StudyCase):
    study = "accuracy"

    def test_accuracy_and_what_is_run_again(self):
        self.run_study()
        rows = self.table()
        self.assertEqual([row["status"] for row in rows], ["ok"] * 9)
        for element in ("triangle", "quadrilateral"):
            chosen = [row for row in rows
                      if (row["element"], row["solver"], row["rtol"]) == (element, "default", "1e-10")]
            self.assertEqual([row["size"] for row in chosen], ["16", "32", "64"])
            for name in ("C11", "C66"):
                errors = [float(row[f"error_{name}"]) for row in chosen]
                self.assertLess(abs(errors[-1]), 5e-4)
                # Second order; the meshes are not similar to each other.
                order = orders_from_errors([1 / 16, 1 / 64], [errors[0], errors[-1]])[0]
                self.assertAlmostEqual(order, 2, delta=0.25)
                self.assertGreater(min(errors), 0)  # an energy from above
        multigrid, direct = (next(row for row in rows if (row["size"], row["element"], row["solver"], row["rtol"]) == (
            "64", "triangle", solver, "1e-10")) for solver in ("default", "direct"))
        self.assertEqual((multigrid["method"], direct["method"]), ("cg + gamg", "preonly + cholesky"))
        for name in ("C11", "C12", "C66"):
            self.assertAlmostEqual(float(multigrid[name]) / float(direct[name]), 1, delta=1e-8)
        for name in ("picture.png", "report.md"):
            self.assertGreater((self.out / name).stat().st_size, 1000)
        self.assertIn("| triangle | 64 | direct", (self.out / "report.md").read_text())
        self.assertFalse(list((self.out / "run").glob("*/localization.*")))

        before = self.written()
        self.assertIn("Nothing to be done", self.run_study())
        more = {"sizes": {"size": [16, 24, 32, 64], "repeat": 1}, "tolerances": {"rtol": [1e-2, 1e-6], "repeat": 1},
                "factorisations": {"size": 64, "repeat": 1}}
        self.run_study(runs=more)
        self.assertEqual(self.run_again(before), {
            "mesh/triangle_24", "mesh/quadrilateral_24", "run/triangle_24_default_1e-10_1",
            "run/quadrilateral_24_default_1e-10_1"})
        self.assertEqual([row["size"] for row in self.table()[:4]], ["16", "24", "32", "64"])  # as study.yaml has it

        # A changed option of one solver concerns its runs only; a failure becomes a row and stays one.
        before = self.written()
        hopeless = {"direct": {"cell_ksp_type": "cg", "cell_pc_type": "none", "cell_ksp_max_it": 3}}
        self.run_study(runs=more, solvers=hopeless)
        self.assertEqual(self.run_again(before), {"run/triangle_64_direct_1e-10_1"})
        failed = [row for row in self.table() if row["status"] == "failed"]
        self.assertEqual([row["solver"] for row in failed], ["direct"])
        self.assertIn("did not converge", failed[0]["reason"])
        self.assertEqual(failed[0]["C11"], "")
        self.assertIn("did not converge", (self.out / "report.md").read_text())

    def test_goes_on_after_it_was_killed(self):
        self.check_going_on_after_a_kill(runs=9)

    def test_a_mesh_that_fails(self):
        runs = {"sizes": {"element": "triangle", "size": [16, 100000], "repeat": 1}}
        runs.update(tolerances={"repeat": []}, factorisations={"repeat": []})
        self.run_study(runs=runs)
        self.assertEqual([(row["size"], row["status"]) for row in self.table()], [("16", "ok"), ("100000", "failed")])
        self.assertIn("the run was not started: morphology: -size asks for", self.table()[1]["reason"])


if __name__ == "__main__":
    studies.main()
