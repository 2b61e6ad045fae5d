"""The study of strips of microstructure in small: what its table holds, and what is run again."""

import studies


class Strip(studies.StudyCase):
    study = "strip"

    def rows(self, **wanted):
        return [row for row in self.table() if all(row[name] == value for name, value in wanted.items())]

    def test_heights_and_what_is_run_again(self):
        self.run_study()
        rows = self.table()
        self.assertEqual([row for row in rows if row["status"] != "ok"], [])
        self.assertEqual(len(rows), 6)
        for row in rows:
            self.assertLess(float(row["energy_residual"]), 1e-10)
            # The coefficient; T follows the pressure by a relaxation time of .6 µs, and the window of 40 µs ends where N has
            # another value than where it begins, though not twice its mean.
            self.assertLessEqual(float(row["friction"]), 0.5 * (1 + 0.6 / 40))
        for row in self.rows(height="5"):  # the whole composite misses nothing of itself
            for name in ("friction_off", "frequency_off", "spectrum_distance", "mean_stress_distance"):
                self.assertEqual(float(row[name]), 0, name)
        for seed in ("1", "2"):
            # The cells near the contact are those of the whole composite; their stress is nearer to its than that of
            # a homogeneous block, in which no inclusion bears more.
            homogeneous, strip = (self.rows(seed=seed, height=height)[0] for height in ("0", "2.5"))
            self.assertLess(float(strip["mean_stress_distance"]), float(homogeneous["mean_stress_distance"]))
        text = (self.out / "report.md").read_text()
        self.assertIn("| sticking | grid | 2.5 | 2 |", text)
        self.assertGreater((self.out / "heights.png").stat().st_size, 30000)
        self.assertIn("Nothing to be done", self.run_study())


if __name__ == "__main__":
    studies.main()
