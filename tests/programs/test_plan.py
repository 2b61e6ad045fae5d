"""slipscale plan: scene R, whose averages on fine meshes are known, from its plan to the run that it proposes."""

import os
import subprocess
import tempfile
import unittest
from pathlib import Path

import yaml

# A homogeneous block that squeals; on meshes from .25 to .0625 mm of a second program: friction .434 to .438, 381 to 383.3
# kHz (runs/refinement).
SCENE = """\
material: {all: {young: 45.0e+9, poisson: 0.25, density: 1800}}
surface: {boundary: bottom, speed: 2}
friction: {law: regularized, threshold: regularized, coefficient: 0.5, time: 0.6e-6}
boundary: {top: {x: fixed, y: -1.3888888888888889e-6, ramp: 40.0e-6}}
damping: {stiffness: 2.0e-9}
time: {end: 400.0e-6}
history: {interval: 50.0e-9, points: [2.5e-3, 0]}
"""
BLOCK = "block: {width: 5.0e-3, height: 5.0e-3}\nshape: none\n"
FRICTION, FREQUENCY = 0.4372, 383.3e3


class Plan(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        (self.folder / "scene.yaml").write_text(SCENE)
        (self.folder / "block.yaml").write_text(BLOCK)

    def plan(self, *words, code=0):
        """What it said, and plan.yaml."""
        done = subprocess.run([os.environ["SLIPSCALE_COMMAND"], "plan", "scene.yaml", "--recipe", "block.yaml", "--output",
                               "plan", *words], cwd=self.folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                              text=True, timeout=200)
        self.assertEqual(done.returncode, code, done.stdout)
        file = self.folder / "plan" / "plan.yaml"
        return done.stdout, yaml.safe_load(file.read_text()) if file.is_file() else None

    def pilots(self):
        return {file: file.stat().st_mtime_ns for file in self.folder.glob("plan/pilots/run/*/outcome.yaml")}

    def test_the_proposed_run_keeps_what_was_promised(self):
        said, found = self.plan("--want", "friction:4%,frequency:2%", "--sizes", "0.5e-3")
        self.assertIn("pilot runs, about", said)
        self.assertEqual(found["status"], "ok")
        before = self.pilots()
        self.assertGreaterEqual(len(before), 7)
        command = said.partition("run it:  ")[2].splitlines()[0].split()
        self.assertEqual(Path(command[0]).resolve(), Path(os.environ["SLIPSCALE_SLIDE"]).resolve())
        done = subprocess.run(command, cwd=self.folder,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=200)
        self.assertEqual(done.returncode, 0, done.stdout)
        summary = yaml.safe_load((self.folder / "plan" / "run" / "summary.yaml").read_text())
        self.assertAlmostEqual(summary["steps"] / found["proposal"]["steps"], 1, delta=0.01)
        self.assertLess(abs(summary["load"]["mean_friction"] / FRICTION - 1), 0.04)
        self.assertLess(abs(summary["dominant_frequency"] / FREQUENCY - 1), 0.02)
        for result in found["results"].values():
            self.assertLessEqual(result["promised"], result["wish"])
        self.assertGreater((self.folder / "plan" / "plan.png").stat().st_size, 10000)
        # Other wishes are answered from the same pilots.
        self.plan("--want", "friction:5%", "--sizes", "0.5e-3")
        self.assertEqual({file: before[file] for file in before}, {file: self.pilots()[file] for file in before})
        # Of another block they are run again.
        self.plan("--want", "friction:5%", "--sizes", "0.5e-3", "-block_height", "4.5e-3")
        self.assertFalse([file for file, end in before.items() if self.pilots()[file] == end])

    def test_a_trajectory(self):
        said, found = self.plan("--want", "trajectory_displacement:2%", "--before", "10e-6", "30e-6", "-time_end", "30e-6",
                                "--budget", "20s", "--sizes", "0.25e-3")
        self.assertLessEqual(found["results"]["trajectory_displacement"]["promised"], 0.02)
        self.assertLess(found["proposal"]["seconds"], 20)

    def test_refusals(self):
        said, found = self.plan("--want", "friction:1%", "-friction_law", "coulomb", code=1)
        self.assertEqual(found["status"], "refused")
        self.assertIn("Coulomb", found["reason"])
        said, _ = self.plan("--want", "friction:1%", "-friction_time", "20e-9", code=1)
        self.assertIn("shorter than two cells", said)
        said, _ = self.plan("--want", "friction:1%", "-time_end", "60e-6", "--sizes", "0.25e-3", code=1)
        self.assertIn("has not settled", said)
        said, _ = self.plan("--want", "fricton:1%", code=2)
        self.assertIn("is friction meant?", said)
        self.plan("--want", "friction:1%", "-friction_cofficient", "0.3", code=2)

    def test_what_cannot_be_told_is_said_before_any_pilot(self):
        (self.folder / "scene.yaml").write_text(SCENE.replace(", points: [2.5e-3, 0]", ""))
        for wish, cure in (("friction:3%,stress_inclusion:5%", "no region inclusion, whose stress is wished for: the mesh has "
                            "matrix"),
                           ("velocity:3%", "name one, as -history_points")):
            said, _ = self.plan("--want", wish, "--sizes", "0.5e-3", code=2)
            self.assertIn(cure, said)
            self.assertEqual(said.count("\n"), 1, said)
            self.assertFalse(self.pilots())
        for word, value in (("--sizes", "0"), ("--sizes", "nan"), ("--jobs", "0"), ("--cells", "squares"),
                            ("--cells", "grid,grid")):
            said, _ = self.plan("--want", "friction:3%", word, value, code=2)
            self.assertRegex(said, rf"^slipscale plan: {word}: .*\n$")
        said, _ = self.plan("--want", "friction:3%", "--sizes", "1", "-friction_law", "none", code=2)  # larger than the block
        self.assertRegex(said, r"^slipscale plan: no(ne of the pilot meshes| mesh of) .*\n$")


if __name__ == "__main__":
    unittest.main()
