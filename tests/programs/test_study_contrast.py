"""The study of high contrast in small: what its table holds, what is run again, and what a failure leaves."""

import numpy as np
import yaml

import studies


class Contrast(studies.StudyCase):
    study = "contrast"

    def rows(self, **wanted):
        return [row for row in self.table() if all(row[name] == value for name, value in wanted.items())]

    def test_morphologies_adaptations_and_what_is_run_again(self):
        self.run_study()
        runs = [row for row in self.table() if row["model"] != "adapted"]
        self.assertEqual([row for row in runs if row["status"] != "ok"], [])
        for row in runs:
            self.assertLess(float(row["energy_residual"]), 1e-10)
            # The coefficient; T follows the pressure by .6 µs, and N is another at the end of the window of 60 µs.
            self.assertLessEqual(float(row["friction"]), 0.5 * (1 + 0.6 / 60))
        for young in ("80", "300"):
            # Between the bounds of Reuss and Voigt of the longitudinal modulus, 1.2 E at ν = .25, fraction .3 ± .05.
            soft, stiff = 1.2 * 30e9, 1.2e9 * float(young)
            for row in self.rows(young=young, model="homogeneous"):
                self.assertLess(float(row["C11"]), 0.65 * soft + 0.35 * stiff)
                self.assertGreater(float(row["C11"]), 1 / (0.75 / soft + 0.25 / stiff))
                self.assertGreater(float(row["spectrum_distance"]), 0)

        adapted = self.rows(model="adapted")
        self.assertEqual({(row["way"], row["level"]) for row in adapted if row["level"] != "nearest"},
                         {("time", "scaling"), ("time", "frequency"), ("time", "search"), ("coefficient", "search"),
                          ("density", "search"), ("density_time", "search"), ("modes", "modes")})
        scaled = self.rows(model="adapted", level="scaling")[0]
        frequency = {row["model"]: float(row["frequency"]) for row in self.rows(young="300", seed="1", way="")}
        np.testing.assert_allclose(float(scaled["value"]),
                                   0.6e-6 * frequency["heterogeneous"] / frequency["homogeneous"], rtol=1e-6)
        for row in adapted:  # a level without a reason came nearer, one with a reason says why it did not
            if row["level"] != "nearest" and row["status"] == "ok":
                self.assertLess(float(row["after_spectrum_distance"]), float(row["before_spectrum_distance"]))
            elif row["level"] != "nearest":
                self.assertNotEqual(row["reason"], "")
        density = self.rows(way="density", level="search")[0]
        self.assertLess(abs(float(density["after_frequency"])), 0.02)  # which the density moves at will

        text = (self.out / "report.md").read_text()
        for words in ("| 5 | 80 | 3 |", "| 5 | 300 | 3 |", "Why adaptations failed",
                      "Adapting density, then T, by search: "):
            self.assertIn(words, text)
        for name in ("scatter", "adapted"):
            self.assertGreater((self.out / f"{name}.png").stat().st_size, 30000)

        before = self.written()
        self.assertIn("Nothing to be done", self.run_study())
        # Adapting again takes the trials that were run, and finds the same.
        trials = {file: file.stat().st_mtime_ns for file in self.out.glob("adapt/*/trials/*/outcome.yaml")}
        self.assertGreater(len(trials), 15)
        found = {file: yaml.safe_load(file.read_text()) for file in self.out.glob("adapt/*/adapt.yaml")}
        # What is new is run, nothing else; a composite that cannot be drawn becomes rows.
        dense = {**self.reduced["runs"], "large": {"young": 300, "diameter": 9.0, "seed": 1}}
        self.run_study("--forcerun", "adapt", runs=dense)
        self.assertTrue(all("9.0" in name for name in self.run_again(before) if "adapt" not in name))
        self.assertEqual({file: file.stat().st_mtime_ns for file in trials}, trials)
        self.assertEqual({file: yaml.safe_load(file.read_text()) for file in found}, found)
        failed = self.rows(diameter="9.0")
        self.assertEqual([row["status"] for row in failed], ["failed", "failed"])
        self.assertTrue(all(row["reason"] for row in failed))


if __name__ == "__main__":
    studies.main()
