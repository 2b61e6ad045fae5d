"""The study of relocalisation in small: what its table holds, what is run again, and what a failure leaves.

The environment says where the programs are: SLIPSCALE_MORPHOLOGY, SLIPSCALE_HOMOGENIZE, SLIPSCALE_SLIDE,
SLIPSCALE_RELOCALIZE.
"""

import csv
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import numpy as np
import yaml

STUDY = Path(__file__).parents[2] / "runs" / "relocalisation"
OUT = "out/relocalisation-reduced"
SECONDS = 300


class Relocalisation(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        (self.folder / "programs").mkdir()
        for name in ("MORPHOLOGY", "HOMOGENIZE", "SLIDE", "RELOCALIZE"):
            (self.folder / "programs" / name.lower()).symlink_to(os.environ[f"SLIPSCALE_{name}"])

    def run_study(self, **changes):
        """What it said, with changes to reduced.yaml; it must succeed."""
        config = yaml.safe_load((STUDY / "reduced.yaml").read_text())
        config.update(programs=str(self.folder / "programs"), **changes)
        (self.folder / "config.yaml").write_text(yaml.safe_dump(config, sort_keys=False))
        done = subprocess.run(["snakemake", "-c2", "--snakefile", STUDY / "Snakefile", "--directory", self.folder,
                               "--configfile", self.folder / "config.yaml"],
                              stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
                              timeout=SECONDS, env={**os.environ, "HOME": str(self.folder)})
        self.assertEqual(done.returncode, 0, done.stdout)
        return done.stdout

    def table(self):
        with (self.folder / OUT / "table.csv").open(newline="") as file:
            return list(csv.DictReader(file))

    def written(self):
        """When each run ended, by its folder."""
        return {str(file.parent.relative_to(self.folder / OUT)): file.stat().st_mtime_ns
                for file in (self.folder / OUT).glob("*/*/outcome.yaml")}

    def one(self, measure, part, component="yy", **options):
        """The row of a run that differs in these options from the default one."""
        wanted = {"case": "stable", "seed": "1", "macro": "24", "tensors": "kubc", "recovery": "nodal", "strip": "0",
                  **options, "measure": measure, "part": part, "component": component}
        found = [row for row in self.table() if all(row[name] == value for name, value in wanted.items())]
        self.assertEqual(len(found), 1, wanted)
        return {name: float(found[0][name] or "nan") for name in ("reference", "relocalised", "homogeneous")}

    def test_relocalisation_and_what_is_run_again(self):
        self.run_study()
        self.assertEqual({row["status"] for row in self.table()}, {"ok"})
        for case in ("stable", "transient"):
            error = self.one("error", "bulk", case=case)
            self.assertLess(error["relocalised"], 0.1 * error["homogeneous"], case)
        # The tensors of a block know nothing of a contact. The correction ends half a strip above it, below the bulk.
        before, after = (self.one("error", "layer", "xx", strip=strip)["relocalised"] for strip in ("0", "0.001"))
        self.assertLess(after, 0.6 * before)
        np.testing.assert_equal(self.one("error", "bulk", strip="0.001"), self.one("error", "bulk"))

        # A homogeneous body does not know which phase carries the load; a cell of another draw does.
        for tensors, macro in (("kubc", "24"), ("periodic", "12")):
            soft, stiff = (self.one("average", phase, tensors=tensors, macro=macro)
                           for phase in ("matrix", "inclusion"))
            ratio = {source: stiff[source] / soft[source] for source in soft}
            self.assertTrue(1 < ratio["reference"] < 80 / 30, ratio)  # between equal stress and equal strain
            missed, left = (abs(ratio[source] - ratio["reference"]) for source in ("homogeneous", "relocalised"))
            self.assertLess(left, 0.4 * missed, ratio)

        text = (self.folder / OUT / "report.md").read_text()
        for words in ("| stable | 1 | 24 | subc | nodal | 0.001 |", "Transient, σ_yy all", "matrix at 2.5, 0.25 mm"):
            self.assertIn(words, text)
        for name in ("stable", "transient"):
            self.assertGreater((self.folder / OUT / "picture" / name / "picture.png").stat().st_size, 50000)

        before = self.written()
        self.assertIn("Nothing to be done", self.run_study())
        # What is new is run, nothing else; a failure, here a strip as deep as the block, becomes a row.
        runs = yaml.safe_load((STUDY / "reduced.yaml").read_text())["runs"]
        runs["strips"] = {"macro": 24, "strip": 9.0}
        late = {"stable": {"run": {"macro": 24}, "words": "--time 1"}}  # a time that has no frame
        self.run_study(runs=runs, pictures=late)
        self.assertEqual({name for name, end in self.written().items() if end != before.get(name)},
                         {"run/stable_1_24_kubc_nodal_9.0", "picture/stable"})
        failed = [row for row in self.table() if row["status"] != "ok"]
        self.assertEqual([(row["strip"], row["measure"]) for row in failed], [("9.0", "")])
        self.assertIn("strip", failed[0]["reason"])
        text = (self.folder / OUT / "report.md").read_text()
        for words in (f"strip 9.0: {failed[0]['reason']}", "No picture: "):
            self.assertIn(words, text)


if __name__ == "__main__":
    if not shutil.which("snakemake"):
        sys.exit("there is no snakemake: cmake/install-dependencies.sh installs it")
    unittest.main()
