"""The study of plan's promises in small: a proposal against the run that is twice finer, and a refusal."""

import studies


class Plan(studies.StudyCase):
    study = "plan"

    def test_promises_and_a_refusal(self):
        self.run_study()
        rows = {(row["scene"], row["wish"]): row for row in self.table()}
        self.assertEqual(rows["coulomb", ""]["status"], "refused")
        for wish in ("friction", "frequency"):
            row = rows["material", wish]
            self.assertEqual(row["holds"], "true", row)
            self.assertLessEqual(float(row["promised"]), float(row["wished"]))
        self.assertAlmostEqual(float(row["node_steps_said"]) / float(row["node_steps"]), 1, delta=0.02)
        self.assertIn("coulomb refused", (self.out / "report.md").read_text())
        self.assertIn("Nothing to be done", self.run_study())


if __name__ == "__main__":
    studies.main()
