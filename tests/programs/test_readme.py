"""Every command of the README at the top, as it stands, one after the other, and its lines of Python."""

import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

TOP = Path(__file__).resolve().parents[2]
NOT_HERE = ("runs/first/run.sh", "tests/run.sh")  # the two commands that build; CI is the second


def commands(text):
    """The indented lines, those that end with a backslash joined, without what only sets up or tests a clone."""
    lines = [line[4:] for line in text.replace("\\\n", " ").splitlines() if line.startswith("    ")]
    return [line for line in lines if not line.startswith(NOT_HERE)]


def python_blocks(text):
    return re.findall(r"```python\n(.*?)```", text, re.DOTALL)


class Readme(unittest.TestCase):
    def test_every_command_runs(self):
        text = (TOP / "README.md").read_text()
        build = Path(os.environ["SLIPSCALE_SLIDE"]).parent
        found = commands(text)
        self.assertGreater(len(found), 8)
        with tempfile.TemporaryDirectory() as folder:
            (Path(folder) / "build").mkdir()
            for link, place in (("build/release", build), ("runs", TOP / "runs"), ("meshes", TOP / "meshes")):
                (Path(folder) / link).symlink_to(place)
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
        for page in TOP.rglob("*.md"):
            if {"build", "out", ".snakemake"} & set(page.relative_to(TOP).parts):
                continue
            for target in re.findall(r"\]\(([^)#\s]+)", page.read_text()):
                if "://" not in target:
                    self.assertTrue((page.parent / target).exists(), f"{page.relative_to(TOP)}: {target}")


if __name__ == "__main__":
    unittest.main()
