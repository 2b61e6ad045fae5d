"""The study of equivalence in small: what its tables hold, what is run again, and what a failure leaves."""

import csv
import subprocess

import studies

WINDOW = (150e-6, 300e-6)


class Equivalence(studies.StudyCase):
    study = "equivalence"

    def row(self, rows, **options):
        found = [row for row in rows if all(row[name] == str(value) for name, value in options.items())]
        self.assertEqual(len(found), 1, options)
        return found[0]

    def verdicts(self):
        with (self.out / "verdicts.csv").open(newline="") as file:
            return list(csv.DictReader(file))

    def runs(self, model, coefficient, load):
        from equivalence.verdict import read_run
        return [read_run(self.out / f"run/{model}_{seed}_small_near_0_{coefficient}_2_{load}_T0.3_cycle", WINDOW)
                for seed in (1, 2)]

    def test_an_own_composite_as_the_readme_has_it(self):
        """Its six runs and no others are planned, and it is said before anything runs."""
        lines = (studies.RUNS / "equivalence" / "README.md").read_text().split("## Your own composite")[1].splitlines()
        example = "\n".join(line[4:] for line in lines if line.startswith("    ") and "snakemake" not in line)
        (self.folder / "mine.yaml").write_text(example)
        done = subprocess.run(["snakemake", "-c2", "-n", "--snakefile", self.snakefile, "--configfile",
                               self.folder / "mine.yaml", "--config", f"programs={self.folder / 'programs'}"],
                              cwd=self.folder, capture_output=True, text=True, env=self.environment(),
                              timeout=studies.SECONDS)
        said = done.stdout + done.stderr
        self.assertEqual(done.returncode, 0, said)
        self.assertIn("6 runs: own 6; they and the table are written to out/mine", said)
        self.assertRegex(said, r"(?m)^slide +6 ")
        self.assertFalse((self.folder / "out").exists())

    def test_equivalence_and_what_is_run_again(self):
        from equivalence.verdict import EQUIVALENT, judge, verdict
        self.run_study()
        runs, points = self.table(), self.verdicts()
        self.assertEqual({row["status"] for row in (*runs, *points)}, {"ok"})
        # Phases that differ by a thousandth cannot be told from their homogenised block: the meshes of two draws differ
        # more. Were they not vibrating, this would say nothing.
        self.assertEqual(len(points), 4)
        for row in points:
            self.assertEqual(row["verdict"], EQUIVALENT, row)
            self.assertGreater(float(row["amplitude_composites"]), 0.1)
            self.assertLess(float(row["spectrum_apart"]), 0.2)
        # Another coefficient of friction is told apart, in friction and in the verdict.
        composites, others = self.runs("composite", 0.5, 15), self.runs("homogenised", 0.6, 15)
        self.assertFalse(judge("friction", composites, others).within)
        self.assertNotEqual(verdict(composites, others), EQUIVALENT)

        # With a memory that is a time, everything is proportional to load and speed together, to the last bit as both
        # are doubled: a map over one of them is a map over their ratio.
        options = {"model": "composite", "seed": 1, "coefficient": 0.5}
        slow, fast = self.row(runs, **options, load=15), self.row(runs, **options, speed=4)
        for name in ("friction", "frequency", "amplitude", "stick", "open", "power_ratio"):
            self.assertEqual(slow[name], fast[name], name)
        self.assertEqual(2 * float(slow["normal_force"]), float(fast["normal_force"]))

        text = (self.out / "report.md").read_text()
        self.assertIn("| sticking, refine 0 |\n", text)
        for name in ("sticking", "loads"):
            self.assertGreater((self.out / "picture" / name / "picture.png").stat().st_size, 20000)

        before = self.written()
        self.assertIn("Nothing to be done", self.run_study())
        # What is new is run, nothing else; a failure becomes a row, and its point has no verdict.
        impossible = {"model": ["composite", "homogenised"], "seed": 1, "coefficient": -1, "speed": 2, "load": 15,
                      "refine": 0, "window": "cycle"}
        self.run_study(runs={**self.reduced["runs"], "doubled": impossible})
        self.assertEqual({name for name in self.run_again(before) if not name.startswith("picture/")},
                         {f"run/{model}_1_small_near_0_-1_2_15_T0.3_cycle" for model in impossible["model"]})
        failed = [row for row in self.table() if row["status"] != "ok"]
        self.assertEqual([row["model"] for row in failed], ["composite", "homogenised"])
        self.assertIn("friction_coefficient", failed[0]["reason"])
        self.assertEqual(self.row(self.verdicts(), coefficient=-1)["status"], "failed")
        self.assertIn(failed[0]["reason"], (self.out / "report.md").read_text())


if __name__ == "__main__":
    studies.main()
