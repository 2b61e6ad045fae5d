"""Sides that absorb waves: what arrives along the normal leaves whole, a preload stays, the ledger closes, and bits do not
depend on the ranks. Oblique waves: tests/verification/open_end.cpp."""

import unittest

import numpy as np
from running import InScratch, arguments_of, datasets
from scenes import SIDE, SQUEAL, block

YOUNG, POISSON, DENSITY = 45e9, 0.25, 1800
FAST = np.sqrt(YOUNG * (1 - POISSON) / ((1 + POISSON) * (1 - 2 * POISSON)) / DENSITY)
SLOW = np.sqrt(YOUNG / 2 / (1 + POISSON) / DENSITY)
BODY = {"mesh_file": "block.msh", "material_block_young": YOUNG, "material_block_poisson": POISSON,
        "material_block_density": DENSITY, "history_every": 1, "time_step": 5e-9}
OPEN = {"boundary_top_absorbing": "true"}


class OpenEnd(InScratch):
    def history(self, scene, ranks=1, **changes):
        self.run_scene({**scene, **changes}, ranks=ranks)
        seen = datasets(self.folder / "out" / "history.h5")
        self.assertLess(np.abs(seen["energy/residual"] / seen["energy/flowed"])[1:].max(), 1e-10)
        return seen

    def test_a_pulse_leaves_a_strip_whole(self):
        """Upwards, of both kinds; its energy is then what was radiated."""
        block(self.folder / "block.msh", periodic=True, divisions=40)
        for speed, components in ((FAST, "0, {0}"), (SLOW, "{0}, 0")):
            pulse = "1e-7*exp(-((y - H/2)/(H/12))^2)"
            rate = f"{speed}*2*(y - H/2)/(H/12)^2*{pulse}"  # of what travels up
            for beta2 in (0.5, 0.7):
                with self.subTest(speed=speed, beta2=beta2):
                    seen = self.history(BODY, 2, **OPEN, initial_displacement=components.format(pulse), time_beta2=beta2,
                                        initial_velocity=components.format(rate), time_end=1.2 * SIDE / speed)
                    start = seen["energy/kinetic"][0] + seen["energy/strain"][0]
                    left = seen["energy/kinetic"][-1] + seen["energy/strain"][-1]
                    self.assertLess(left, 1e-3 * start)
                    self.assertGreater(seen["energy/radiated"][-1], (0.99 if beta2 == 0.5 else 0.7) * start)

    def test_a_preload_stays(self):
        """Of the uniform state, carried by two open sides that meet, in contact or not; given tractions take its place."""
        block(self.folder / "block.msh")
        pressure = 1e6
        contact = {"surface_boundary": "bottom", "surface_speed": 0, "friction_law": "coulomb", "friction_coefficient": 0.3}
        sides = {f"boundary_{side}_absorbing": "true" for side in ("left", "right", "top")}
        for own in ({}, {"boundary_top_pressure": pressure}):
            for ranks in (1, 2):
                seen = self.history({**BODY, **contact, **sides, "initial_pressure": pressure, **own}, ranks, time_end=4e-6,
                                    history_points=f"{SIDE},{SIDE},0,0")
                for point in (0, 1):
                    self.assertLess(np.ptp(seen[f"points/{point}/u"], axis=0).max(), 1e-17)
                np.testing.assert_allclose(seen["surface/normal_force"], pressure * SIDE, rtol=1e-9)
                summary = (self.folder / "out" / "summary.yaml").read_text()
                self.assertIn("no frequency: the tangential force is constant to rounding", summary)
                self.assertNotIn("spectrum_peaks", summary)
        seen = self.history({**BODY, **contact, **sides, "initial_pressure": pressure, "boundary_top_pressure": 2 * pressure},
                            2, time_end=4e-6)
        self.assertGreater(seen["surface/normal_force"][-1], 1.1 * pressure * SIDE)

    def test_off_on_a_held_side_is_off(self):
        """Over a scene that has it on, and alone; on it is refused."""
        block(self.folder / "block.msh")
        (self.folder / "scene.yaml").write_text("boundary: {top: {absorbing: true}}\n")
        for words in (["-options_file_yaml", "scene.yaml"], []):
            outcome = self.slide(*words, *arguments_of({**BODY, "boundary_top_x": "fixed", "boundary_top_absorbing": "false",
                                                        "time_end": 1e-7}), ranks=2)
            self.assertEqual((outcome.codes, outcome.err), ([0, 0], ""), outcome.out)
            self.assertNotIn("absorbing", outcome.out)
        outcome = self.slide(*arguments_of({**BODY, **OPEN, "boundary_top_x": "fixed", "time_end": 1e-7}), ranks=2)
        self.assert_refused("slide", outcome, ["-boundary_top_absorbing has no effect on a side whose motion"], 2)

    def test_a_pressed_top_yields_at_the_speed_of_its_damper(self):
        """A body without a bottom: p = ρ c_d v until the wave comes back."""
        block(self.folder / "block.msh", periodic=True, divisions=40)
        pressure = 1e6
        seen = self.history(BODY, 2, **OPEN, boundary_top_pressure=pressure, boundary_top_ramp=2e-7, time_end=0.9 * SIDE / FAST,
                            history_points=f"{SIDE / 2},{SIDE}")
        # The damper and the body behind it share the pressure.
        self.assertAlmostEqual(seen["points/0/v"][-1, 1] / (-pressure / (2 * DENSITY * FAST)), 1, delta=1e-3)

    def test_the_same_bits_while_it_squeals(self):
        block(self.folder / "block.msh", divisions=12)
        scene = {**SQUEAL, "boundary_left_absorbing": "true", "boundary_right_absorbing": "true", "contact_every": 20,
                 "fields_every": 200, "time_beta2": 0.6, "friction_time": None, "friction_rate": "slip", "damping_mass": 1e3,
                 "friction_length": 1.2e-6, "friction_rate_reference": 0.1}
        self.run_scene(scene, output_folder="alone")
        self.run_scene(scene, ranks=2, output_folder="two")
        self.run_scene({**scene, "time_end": 20e-6}, ranks=2, output_folder="halves")
        outcome = self.slide("-restart", "halves", "-time_end", scene["time_end"])
        self.assertEqual(outcome.codes, [0], outcome.err)
        for other in ("two", "halves"):
            for file in ("history.h5", "contact.h5", "fields.h5"):
                left, right = (datasets(self.folder / folder / file) for folder in ("alone", other))
                for name in left:
                    self.assertEqual(left[name].tobytes(), right[name].tobytes(), f"{file}: {name}")
        seen = datasets(self.folder / "alone" / "history.h5")
        self.assertLess(np.abs(seen["energy/residual"] / seen["energy/flowed"])[1:].max(), 1e-10)
        self.assertGreater(seen["energy/radiated"][-1], 0)

    def test_a_slanting_side_is_refused(self):
        (self.folder / "slant.geo").write_text(
            "Point(1) = {0,0,0}; Point(2) = {5e-3,0,0}; Point(3) = {5e-3,6e-3,0}; Point(4) = {0,5e-3,0};\n"
            "Line(1) = {1,2}; Line(2) = {2,3}; Line(3) = {3,4}; Line(4) = {4,1}; Curve Loop(1) = {1,2,3,4};\n"
            "Plane Surface(1) = {1}; Physical Surface(\"block\") = {1}; Physical Curve(\"top\") = {3};\n"
            "Mesh.MeshSizeMax = 1e-3;\n")
        self.launch("gmsh", "-v", "1", "-2", "-format", "msh41", "slant.geo", "-o", "block.msh")
        outcome = self.slide(*arguments_of({**BODY, **OPEN, "time_end": 1e-6}), ranks=2)
        self.assert_refused("slide", outcome, ["-boundary_top_absorbing", "does not face along x or y", "along an axis"], 2)


if __name__ == "__main__":
    unittest.main()
