"""A study of runs/ in small, in a folder of its own: run it, read its table, see what was run again.

The environment says where the programs are: SLIPSCALE_SLIDE, SLIPSCALE_MORPHOLOGY, and so on.
"""

import csv
import os
import shutil
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

import yaml

RUNS = Path(__file__).parents[2] / "runs"
PROGRAMS = ("morphology", "homogenize", "slide", "modes", "relocalize")
SECONDS = 300

sys.path.insert(0, str(RUNS))


class StudyCase(unittest.TestCase):
    """`study` is the folder's name below runs/; its reduced.yaml says what is run."""

    study = None
    place = "in a place"  # of programs and results: a path with blanks

    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name) / self.place
        self.folder.mkdir()
        self.snakefile = RUNS / self.study / "Snakefile"
        self.reduced = yaml.safe_load((RUNS / self.study / "reduced.yaml").read_text())
        self.out = self.folder / self.reduced["output"]
        (self.folder / "programs").mkdir()
        for name in PROGRAMS:
            (self.folder / "programs" / name).symlink_to(os.environ[f"SLIPSCALE_{name.upper()}"])

    def command(self, *words, **changes):
        """The study in the test's folder, with changes to reduced.yaml."""
        config = {**self.reduced, "programs": str(self.folder / "programs"), **changes}
        (self.folder / "config.yaml").write_text(yaml.safe_dump(config, sort_keys=False))
        return ["snakemake", "-c2", "--snakefile", self.snakefile, "--directory", self.folder, "--configfile",
                self.folder / "config.yaml", *words]

    def environment(self):
        return {**os.environ, "HOME": str(self.folder)}

    def run_study(self, *words, **changes):
        """What it said; it must succeed."""
        done = subprocess.run(self.command(*words, **changes), stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True, timeout=SECONDS, env=self.environment())
        self.assertEqual(done.returncode, 0, done.stdout)
        return done.stdout

    def table(self):
        """Rows of texts."""
        with (self.out / "table.csv").open(newline="") as file:
            return list(csv.DictReader(file))

    def written(self):
        """When each mesh, run and so on ended, by its folder below the output."""
        return {str(file.parent.relative_to(self.out)): file.stat().st_mtime_ns
                for file in self.out.glob("*/*/outcome.yaml")}

    def run_again(self, before):
        """Of `written()`, what ended anew since `before`."""
        return {name for name, end in self.written().items() if end != before.get(name)}

    def runs_written(self):
        """Of `written()`, the runs."""
        return {name: end for name, end in self.written().items() if name.startswith("run/")}

    def check_going_on_after_a_kill(self, runs, at_work=1, **changes):
        """Kills the study of so many `runs` once two have ended, lets it go on and complete. Of those that had ended as
        many as are `at_work` at a time may be run again: the engine may not have taken note of them."""
        study = subprocess.Popen(self.command(**changes), stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                 stderr=subprocess.DEVNULL, env=self.environment(), start_new_session=True)
        end = time.monotonic() + SECONDS
        while len(self.runs_written()) < 2 and study.poll() is None and time.monotonic() < end:
            time.sleep(0.02)
        os.killpg(study.pid, signal.SIGKILL)
        study.wait(timeout=SECONDS)
        before = self.runs_written()
        self.assertTrue(2 <= len(before) < runs, before)
        self.run_study("--unlock", **changes)
        self.run_study("--rerun-incomplete", **changes)
        after = self.runs_written()
        self.assertEqual(len(after), runs)
        self.assertLessEqual(sum(after[name] != before[name] for name in before), at_work)
        self.assertEqual([row["status"] for row in self.table()], ["ok"] * runs)


def main():
    if not shutil.which("snakemake"):
        sys.exit("there is no snakemake: cmake/install-dependencies.sh installs it")
    unittest.main()
