"""The study of homogenize's accuracy in small: what its table holds, what is run again, and what a failure leaves.

The environment says where the programs are: SLIPSCALE_MORPHOLOGY, SLIPSCALE_HOMOGENIZE.
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

STUDY = Path(__file__).parents[2] / "runs" / "accuracy"
OUT = "out/accuracy-reduced"
SECONDS = 300

sys.path.insert(0, str(STUDY.parent))
from analysis.convergence import orders_from_errors  # noqa: E402


class Accuracy(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        (self.folder / "programs").mkdir()
        for name in ("MORPHOLOGY", "HOMOGENIZE"):
            (self.folder / "programs" / name.lower()).symlink_to(os.environ[f"SLIPSCALE_{name}"])

    def command(self, *words, **changes):
        """The study in the test's folder, with changes to reduced.yaml."""
        config = yaml.safe_load((STUDY / "reduced.yaml").read_text())
        config.update(programs=str(self.folder / "programs"), **changes)
        (self.folder / "config.yaml").write_text(yaml.safe_dump(config, sort_keys=False))
        return ["snakemake", "-c2", "--snakefile", STUDY / "Snakefile", "--directory", self.folder, "--configfile",
                self.folder / "config.yaml", *words]

    def run_study(self, *words, **changes):
        """What it said; it must succeed."""
        done = subprocess.run(self.command(*words, **changes), stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True, timeout=SECONDS, env=self.environment())
        self.assertEqual(done.returncode, 0, done.stdout)
        return done.stdout

    def environment(self):
        return {**os.environ, "HOME": str(self.folder)}

    def table(self):
        with (self.folder / OUT / "table.csv").open(newline="") as file:
            return list(csv.DictReader(file))

    def written(self):
        """When each run ended."""
        outcomes = (self.folder / OUT / "run").glob("*/outcome.yaml")
        return {file.parent.name: file.stat().st_mtime_ns for file in outcomes}

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
            self.assertGreater((self.folder / OUT / name).stat().st_size, 1000)
        self.assertIn("| triangle | 64 | direct", (self.folder / OUT / "report.md").read_text())
        self.assertFalse(list((self.folder / OUT / "run").glob("*/localization.*")))

        before = self.written()
        self.assertIn("Nothing to be done", self.run_study())
        more = {"sizes": {"size": [16, 24, 32, 64], "repeat": 1}, "tolerances": {"rtol": [1e-2, 1e-6], "repeat": 1},
                "factorisations": {"size": 64, "repeat": 1}}
        self.run_study(runs=more)
        after = self.written()
        self.assertEqual({name for name in after if after[name] != before.get(name)},
                         {"triangle_24_default_1e-10_1", "quadrilateral_24_default_1e-10_1"})
        self.assertEqual([row["size"] for row in self.table()[:4]], ["16", "16", "24", "24"])

        # A changed option of one solver concerns its runs only; a failure becomes a row and stays one.
        hopeless = {"direct": {"cell_ksp_type": "cg", "cell_pc_type": "none", "cell_ksp_max_it": 3}}
        self.run_study(runs=more, solvers=hopeless)
        self.assertEqual({name for name, end in self.written().items() if end != after[name]},
                         {"triangle_64_direct_1e-10_1"})
        failed = [row for row in self.table() if row["status"] == "failed"]
        self.assertEqual([row["solver"] for row in failed], ["direct"])
        self.assertIn("did not converge", failed[0]["reason"])
        self.assertEqual(failed[0]["C11"], "")
        self.assertIn("did not converge", (self.folder / OUT / "report.md").read_text())

    def test_goes_on_after_it_was_killed(self):
        study = subprocess.Popen(self.command(), stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                 stderr=subprocess.DEVNULL, env=self.environment(), start_new_session=True)
        end = time.monotonic() + SECONDS
        while len(self.written()) < 2 and study.poll() is None and time.monotonic() < end:
            time.sleep(0.02)
        os.killpg(study.pid, signal.SIGKILL)
        study.wait(timeout=SECONDS)
        before = self.written()
        self.assertTrue(2 <= len(before) < 9, before)
        self.run_study("--unlock")
        self.run_study("--rerun-incomplete")
        after = self.written()
        self.assertEqual(len(after), 9)
        # The run that had just ended may have been killed before the engine took note of it.
        self.assertLessEqual(sum(after[name] != before[name] for name in before), 1)
        self.assertEqual([row["status"] for row in self.table()], ["ok"] * 9)

    def test_a_mesh_that_fails(self):
        runs = {"sizes": {"element": "triangle", "size": [16, 100000], "repeat": 1}}
        runs.update(tolerances={"repeat": []}, factorisations={"repeat": []})
        self.run_study(runs=runs)
        self.assertEqual([(row["size"], row["status"]) for row in self.table()], [("16", "ok"), ("100000", "failed")])
        self.assertIn("the run was not started: morphology: -size asks for", self.table()[1]["reason"])


if __name__ == "__main__":
    if not shutil.which("snakemake"):
        sys.exit("there is no snakemake: cmake/install-dependencies.sh installs it")
    unittest.main()
