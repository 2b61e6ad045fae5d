"""slipscale adapt: the strip S1 that squeals in slip and separation, whose relaxation time is to be found."""

import os
import subprocess
import tempfile
import unittest
from pathlib import Path

import numpy as np
import yaml

PERIOD = 6.283185307179586
TRUTH = 0.1
DRIVE = 0.5 * 1e-4 * PERIOD * 7e-4  # μ N0 V
# P_in over it, nx = 64: verification/second_program.py
POWER = {0.0: 0.435, 0.025: 0.423, 0.05: 0.398, 0.1: 0.332, 0.2: 0.216}
SCENE = {  # c_s = ρ = 1, H = 2, p0/G = 1e-4
    "material_all_young": 2.6, "material_all_poisson": 0.3, "material_all_density": 1, "surface_boundary": "bottom",
    "surface_speed": 7e-4, "friction_law": "regularized", "friction_coefficient": 0.5, "boundary_top_x": "fixed",
    "boundary_top_y": "fixed", "initial_pressure": 1e-4, "initial_shear": 5e-5, "initial_sine_amplitude": 7e-6,
    "initial_sine_wavelength": PERIOD, "damping_stiffness": 0.02, "time_end": 400, "time_safety": 0.4,
    "history_every": 4, "history_boundary": "top", "contact_every": 8}


def run(program, options):
    subprocess.run([os.environ[f"SLIPSCALE_{program.upper()}"],
                    *(word for name, value in options.items() for word in (f"-{name}", str(value)))],
                   check=True, stdout=subprocess.DEVNULL)


class Strip(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(temporary.cleanup)
        cls.folder = Path(temporary.name)
        run("morphology", {"block_width": PERIOD, "block_height": 2, "shape": "none", "cell": "quadrilateral",
                           "structured": "true", "size": PERIOD / 32, "periodic": "x",
                           "output_folder": cls.folder / "mesh"})

    def slide(self, name, **options):
        run("slide", {**SCENE, "mesh_file": self.folder / "mesh" / "mesh.msh", **options,
                      "output_folder": self.folder / name})

    def adapt(self, truth, own, *words):
        """The exit code and adapt.yaml."""
        output = self.folder / f"{truth}_{own}"
        done = subprocess.run(
            [os.environ["SLIPSCALE_COMMAND"], "adapt", self.folder / truth, self.folder / own, "--output", output,
             "--program", os.environ["SLIPSCALE_SLIDE"], "--window", "200", "400", *words],
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
        self.assertIn(done.returncode, (0, 1), done.stdout)
        return done.returncode, yaml.safe_load((output / "adapt.yaml").read_text())

    def started(self):
        return {file: file.stat().st_mtime_ns for file in self.folder.glob("*/trials/*/outcome.yaml")}

    def test_the_relaxation_time_is_found_again(self):
        self.slide("truth", friction_time=TRUTH)
        for own in (0.07, 0.17):
            self.slide(f"own{own}", friction_length=own * 7e-4)  # L*, which the trials take the place of
            code, found = self.adapt("truth", f"own{own}", "--points", "5")
            levels = found["levels"]
            self.assertEqual((code, levels["search"]["match"]), (0, "power"), found["reason"])
            self.assertAlmostEqual(levels["search"]["value"] / TRUTH, 1, delta=0.03)
            # The search matches the power; the spectrum follows as far as two chaotic runs allow.
            self.assertLess(levels["search"]["after"]["spectrum_distance"], 0.5 * found["before"]["spectrum_distance"])
            # The law of one frequency, though a cycle that separates has many, knows the time of its run.
            for scale, time in (("heterogeneous", TRUTH), ("homogeneous", own)):
                self.assertAlmostEqual(levels["frequency"]["surface"][scale]["time_seen"] / time, 1, delta=0.2)
            scan = [row for row in levels["search"]["scan"] if row["friction_time"] <= 0.2]
            expected = np.interp([row["friction_time"] for row in scan], list(POWER), list(POWER.values()))
            np.testing.assert_allclose([row["power_into_body"] / DRIVE for row in scan], expected, rtol=0.1)  # nx = 32

        before = self.started()
        self.adapt("truth", "own0.07", "--points", "5")
        self.assertEqual(self.started(), before)  # nothing was run again

    def test_more_power_than_any_time_lets_pass(self):
        self.slide("rougher", friction_coefficient=0.7, friction_time=TRUTH)
        self.slide("own", friction_time=TRUTH)
        code, found = self.adapt("rougher", "own", "--level", "search", "--match", "power", "--points", "3")
        self.assertEqual(code, 1)
        self.assertRegex(found["reason"], "not bracketed: power .* lies outside")
        self.assertIsNone(found["best"])


if __name__ == "__main__":
    unittest.main()
