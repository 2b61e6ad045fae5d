"""The study of all knobs in small: its table, its front, and what is run again."""

import studies


class Tradeoff(studies.StudyCase):
    study = "tradeoff"

    def test_knobs_and_what_is_run_again(self):
        self.run_study()
        rows = self.table()
        self.assertEqual([row for row in rows if row["status"] != "ok"], [])
        for row in rows:
            self.assertLess(float(row["energy_residual"]), 1e-10)
            self.assertGreater(float(row["memory"]), 1e6)
        double, single = ([row for row in rows if (row["case"], row["knob"], row["storage"]) == ("plain", "storage", of)][0]
                          for of in ("double", "single"))
        self.assertLess(abs(float(single["normal_force"]) / float(double["normal_force"]) - 1), 1e-3)
        finest = [row for row in rows if (row["knob"], row["size"]) == ("sizes", "160")]
        self.assertEqual(len(finest), 2)
        text = (self.out / "report.md").read_text()
        self.assertIn("sticking: every knob", text)
        self.assertIn("| 80 | 10 |", text)
        self.assertGreater((self.out / "front.png").stat().st_size, 30000)
        self.assertIn("Nothing to be done", self.run_study())


if __name__ == "__main__":
    studies.main()
