"""The study of phases that rub differently, in small: what its table holds, and what is run again."""

import math

import studies


class Phases(studies.StudyCase):
    study = "phases"

    def test_coefficients_and_what_is_run_again(self):
        self.run_study()
        rows = self.table()
        self.assertEqual([row for row in rows if row["status"] != "ok"], [])
        self.assertEqual(len(rows), 12)
        beta = (1 - 2 * 0.25) / (2 * (1 - 0.25))
        for row in rows:
            self.assertLess(float(row["energy_residual"]), 1e-10)
            low, high = {"strong": (0.2, 1.2), "extreme": (0, 1.6)}[row["pair"]]
            effective = math.tan(0.5 * (math.atan(beta * low) + math.atan(beta * high))) / beta
            expected = {"effective": effective, "mean": 0.5 * (low + high)}.get(row["model"])
            if expected:
                self.assertAlmostEqual(float(row["coefficient"]), expected, delta=2e-5)  # as effective.yaml has it
                self.assertAlmostEqual(float(row["friction"]), expected, delta=2e-3)  # slides steadily
            else:
                self.assertEqual(row["coefficient"], "")
                self.assertEqual(float(row["friction_off"]), 0)
                self.assertLess(abs(float(row["friction"]) - effective), abs(float(row["friction"]) - 0.5 * (low + high)))
        text = (self.out / "report.md").read_text()
        self.assertIn("| strip of 1.25 mm | same | strong | quiet |", text)
        self.assertGreater((self.out / "friction.png").stat().st_size, 20000)
        self.assertIn("Nothing to be done", self.run_study())


if __name__ == "__main__":
    studies.main()
