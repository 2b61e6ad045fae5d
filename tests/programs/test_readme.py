"""Every command of the README at the top, as it stands, one after the other, and its lines of Python; and every command
of the other pages, as far as it costs little (readme_commands.py)."""

import os
import re
import subprocess
import sys
import tempfile
import unittest
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import readme_commands
from readme_commands import BUILDS, TOP, Fault, Place, indented, inline, without_report

EQUATIONS = ("include/slipscale/README.md",)  # pages whose indented lines are no commands


def pages():
    return [page for page in TOP.rglob("*.md")
            if not {"build", "out", ".snakemake"} & set(page.relative_to(TOP).parts)]


def commands(text):
    """Of the top README, without what only sets up or tests a clone."""
    return [line for line in indented(text) if not line.startswith(BUILDS)]


def python_blocks(text):
    return re.findall(r"```python\n(.*?)```", text, re.DOTALL)


class Readme(unittest.TestCase):
    def test_every_command_runs(self):
        text = (TOP / "README.md").read_text()
        found = commands(text)
        self.assertGreater(len(found), 8)
        with tempfile.TemporaryDirectory() as folder:
            Place(folder)
            for command in found:
                with self.subTest(command):
                    done = subprocess.run(["bash", "-c", command], cwd=folder, capture_output=True, text=True)
                    self.assertEqual(done.returncode, 0, done.stdout[-2000:] + done.stderr[-2000:])
            environment = {**os.environ, "PYTHONPATH": str(TOP / "runs"), "MPLBACKEND": "Agg"}
            for block in python_blocks(text):
                done = subprocess.run([sys.executable, "-c", block], cwd=folder, capture_output=True, text=True,
                                      env=environment)
                self.assertEqual(done.returncode, 0, done.stderr)
            self.assertTrue((Path(folder) / "friction.png").is_file())

    def test_every_link_leads_somewhere(self):
        for page in pages():
            for target in re.findall(r"\]\(([^)#\s]+)", page.read_text()):
                if "://" not in target:
                    self.assertTrue((page.parent / target).exists(), f"{page.relative_to(TOP)}: {target}")


class OtherPages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        (Path(cls.temporary.name) / ".snakemake").mkdir()  # two that start at once would both make it
        cls.place = Place(cls.temporary.name)
        cls.place.fill()

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def fault(self, line):
        """What is wrong with it, or None."""
        try:
            self.place.attempt(line)
        except Fault as fault:
            return str(fault)

    def test_every_command(self):
        found = {}
        for page in pages():
            text = page.read_text()
            lines = [] if str(page.relative_to(TOP)) in (*EQUATIONS, "README.md") else indented(text)
            for line in (*lines, *inline(text)):
                found.setdefault(line, page.relative_to(TOP))
        self.assertGreater(len(found), 60)
        with ThreadPoolExecutor(2) as pool:
            for line, fault in zip(found, pool.map(self.fault, found)):
                with self.subTest(page=str(found[line]), command=line):
                    self.assertIsNone(fault)

    def test_what_is_mistyped_is_found(self):
        for line in ("snakemke -c2 --snakefile runs/sweep/Snakefile", "snakemake -c2 --snakefile runs/swep/Snakefile",
                     "snakemake -c2 --snakfile runs/sweep/Snakefile",
                     "snakemake -c2 --snakefile runs/equivalence/Snakefile --configfile mien.yaml",
                     "bild/release/slipscale table out/sweep", "build/release/slipscale tabl out/sweep",
                     "build/release/slipscale table out/sweep --sort frction",
                     "build/release/slipscale maps out/sweep/table.csv picture.png --valu stick",
                     "build/release/slipscale sweep scene.yaml -friction_coeficient 0.1:0.1:0.8",
                     "build/release/slipscale sweep scen.yaml -friction_coefficient 0.1:0.1:0.8",
                     "slipscale sweep --stdy FOLDER", "morphology … -sede 2", "morphology … -seed two",
                     "slide … -friction_lenght 0.6e-6", "runs/first/rum.sh", "tests/run.sh --ful",
                     "runs/profiles/slurm/array.sh 20 runs/sweep/Snakfile", "cmake --presets release",
                     "cmake --preset relase", "cmake --build build/relase", "cmake -B build -D SLIPSCALE_TEST=OFF",
                     "cmake --install build/release --component slipscal", "ctest --test-dir build/release -L uint",
                     "ctest -R bit_identiti", "cp -r runs/swep runs/mine", "src/mesh/plx*.cpp",
                     "python3 tests/verification/table.py build/release --ito x",
                     "build/release/tests/bench/bench_step -node 4000"):
            with self.subTest(line):
                self.assertIsNotNone(self.fault(line))

    def test_what_a_study_file_may_hold_is_said(self):
        """Each entry of study.yaml, and of a sequence of refinement, stands in the tables of its page."""
        from refinement.sequences import ENTRIES
        from slipscale.reading import yaml_file
        for study in TOP.glob("runs/*/study.yaml"):
            rows = re.findall(r"^\|.*", without_report((study.parent / "README.md").read_text()), re.M)
            said = set(re.findall(r"`(\w+)[`:]", "\n".join(rows)))
            wanted = set(yaml_file.options(study)) | (set(ENTRIES) if study.parent.name == "refinement" else set())
            self.assertEqual(wanted - said, set(), study.parent.name)


if __name__ == "__main__":
    assert readme_commands.BUILD.is_dir()
    unittest.main()
