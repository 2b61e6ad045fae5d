"""bench_step on a small mesh: it runs to its end, and every figure it prints is one. What crashes after its last line
has not passed."""

import os
import re
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

HERE = Path(__file__).parent
sys.path.insert(0, str(HERE))
from features import FEATURES  # noqa: E402

FIGURE = re.compile(r"^  (\S.*?) +([\d.]+) ns per node \(least +([\d.]+)\) +([\d.]+) x MATBAIJ$", re.M)


def figures(*command):
    """{variant: (median, least) in ns per node, ratio to MATBAIJ} of a command; AssertionError when it fails."""
    done = subprocess.run(command, capture_output=True, text=True, timeout=100)
    assert done.returncode == 0, f"exit code {done.returncode}\n{done.stdout}{done.stderr}"
    return {name: tuple(map(float, values)) for name, *values in FIGURE.findall(done.stdout)}


class Step(unittest.TestCase):
    def test_figures(self):
        for shape in ("general", "quadrilaterals"):
            found = figures(os.environ["BENCH_STEP"], "-nodes", "1000", "-repetitions", "3", "-shape", shape)
            self.assertEqual(len(found), 12, found)
            self.assertEqual(found["MATBAIJ product"][2], 1)
            for name, (median, least, ratio) in found.items():
                self.assertTrue(0 < least <= median and ratio > 0, name)

    def test_a_crash_at_the_end_is_seen(self):
        line = "  step    1.00 ns per node (least   1.00)   0.900 x MATBAIJ"
        self.assertEqual(figures("bash", "-c", f"echo '{line}'"), {"step": (1, 1, 0.9)})
        for end in ("exit 1", "kill -SEGV $$"):
            with self.assertRaisesRegex(AssertionError, "exit code"):
                figures("bash", "-c", f"echo '{line}'; {end}")


class Scripts(unittest.TestCase):
    """They run to their end on small meshes."""

    build = str(Path(os.environ.get("BENCH_STEP", "/")).resolve().parents[2]) if "BENCH_STEP" in os.environ else ""

    def said(self, script, *words):
        done = subprocess.run([sys.executable, "-B", HERE / script, *words], capture_output=True, text=True, timeout=100)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return done.stdout

    def test_table(self):
        options = ("-processes", "1", "-repetitions", "1", "-nodes", "400", "-sizes", "")
        rows = self.said("table.py", self.build, *options).splitlines()
        self.assertEqual(len(rows), 5)
        self.assertEqual({row.count("|") for row in rows}, {10})

    def test_memory(self):
        self.assertRegex(self.said("memory.py", self.build, "-nodes", "4000"), r"[1-9]\d* bytes per node at the highest")

    def test_features(self):
        rows = self.said("features.py", self.build, "-size", "2e-4", "-steps", "50", "-repeat", "1").splitlines()
        self.assertEqual([row.split(" | ")[0].removeprefix("| ") for row in rows[4:]], list(FEATURES))
        self.assertEqual({row.count("|") for row in rows[2:]}, {6})

    def test_runs(self):
        with tempfile.TemporaryDirectory() as folder:
            mesh = f"{folder}/mesh.msh"
            subprocess.run([os.environ["BENCH_STEP"], "-nodes", "100", "-write", mesh], check=True)
            run = (f"{self.build}/slide -mesh_file {mesh} -material_all_young 1e9 -material_all_poisson .3 "
                   "-material_all_density 1000 -boundary_top_y fixed -body_acceleration 0,-9.81 -time_end 1e-5 -history_boundary top")
            table = self.said("runs.py", "-repeat", "1", f"one={run}", f"two={run} -stiffness_kernel pairs")
        self.assertRegex(table, r"\| one \| [\d.]+ \| [\d.]+ \| 1.000 \| 1.000 \|\n\| two \|")


if __name__ == "__main__":
    unittest.main()
