"""Every study as a plan: its Snakefile, study.yaml and reduced.yaml are taken, and so many jobs follow. Nothing is
run."""

import re
import subprocess

import studies

STUDIES = ("accuracy", "contrast", "equivalence", "phases", "plan", "refinement", "relocalisation", "stability", "strip",
           "sweep", "tradeoff")


class Plan(studies.StudyCase):
    """Of the study of which setUp makes the folder; the others use it as well."""

    study = STUDIES[0]

    def jobs(self, study, file):
        """Planned jobs by rule."""
        done = subprocess.run(
            ["snakemake", "-n", "-c2", "--snakefile", studies.RUNS / study / "Snakefile", "--directory", self.folder,
             "--configfile", studies.RUNS / study / file, "--config", f"programs={self.folder / 'programs'}"],
            stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
            timeout=studies.SECONDS, env=self.environment())
        self.assertEqual(done.returncode, 0, done.stdout)
        return {rule: int(count) for rule, count in re.findall(r"^(\w+) +(\d+) +\d+ +\d+$", done.stdout, re.M)}

    def test_all_are_here(self):
        self.assertEqual(sorted(file.parent.name for file in studies.RUNS.glob("*/Snakefile")), sorted(STUDIES))

    def test_plans(self):
        for study in STUDIES:
            with self.subTest(study=study):
                full, reduced = (self.jobs(study, file) for file in ("study.yaml", "reduced.yaml"))
                for jobs in (full, reduced):
                    self.assertEqual(sum(count for rule, count in jobs.items() if rule != "total"), jobs["total"])
                self.assertGreater(reduced["total"], 5)
                self.assertGreater(full["total"], 2 * reduced["total"])
        self.assertFalse((self.folder / "out").exists())

    def test_an_own_composite_as_the_readme_has_it(self):
        """Its six runs and no others are planned, and it is said before anything runs."""
        lines = (studies.RUNS / "equivalence" / "README.md").read_text().split("## Your own composite")[1].splitlines()
        example = "\n".join(line[4:] for line in lines if line.startswith("    ") and "snakemake" not in line)
        (self.folder / "mine.yaml").write_text(example)
        done = subprocess.run(["snakemake", "-c2", "-n", "--snakefile", studies.RUNS / "equivalence" / "Snakefile",
                               "--configfile", self.folder / "mine.yaml", "--config",
                               f"programs={self.folder / 'programs'}"],
                              cwd=self.folder, capture_output=True, text=True, env=self.environment(),
                              timeout=studies.SECONDS)
        said = done.stdout + done.stderr
        self.assertEqual(done.returncode, 0, said)
        self.assertIn("6 runs: own 6; they and the table are written to out/mine", said)
        self.assertRegex(said, r"(?m)^slide +6 ")
        self.assertFalse((self.folder / "out").exists())


if __name__ == "__main__":
    studies.main()
