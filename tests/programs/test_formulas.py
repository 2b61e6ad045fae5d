"""Formulas in place of numbers: what they make acts at its place and time, on one rank and on two with the same bits, and
a run that goes on does so as well. Expected values are the formulas' own, evaluated here."""

import unittest

import numpy as np
from running import InScratch, arguments_of, datasets
from scenes import SIDE, block

YOUNG, POISSON, DENSITY = 45e9, 0.25, 1800
STEP = 2e-8
BODY = {"mesh_file": "block.msh", "material_block_young": YOUNG, "material_block_poisson": POISSON,
        "material_block_density": DENSITY, "time_step": STEP, "time_end": 4e-6, "history_every": 1}
SURFACE = {"surface_boundary": "bottom", "surface_speed": 2, "friction_law": "coulomb", "friction_coefficient": 0.4}
PRESSED = {**BODY, **SURFACE, "boundary_top_x": "fixed", "boundary_top_y": -1.4e-6, "boundary_top_ramp": 2e-6,
           "contact_every": 10}
PARAMETERS = {"parameters_p0": 1e6, "parameters_w": 2e6}
# Everything that may follow a formula, at once.
EVERYTHING = {
    **BODY, **PARAMETERS, "surface_boundary": "bottom", "surface_speed": "2 + 0.5*sin(w*t)",
    "surface_height": "1e-8*sin(2*pi*x/L)*(1 - cos(w*t))", "friction_law": "regularized", "friction_time": 0.6e-6,
    "friction_coefficient": "0.4 + 0.2*cos(2*pi*x/L)*cos(w*t)",
    "boundary_top_y": "rigid", "boundary_top_force": "p0*L*(1 + 0.3*sin(w*t))", "boundary_top_mass": 1e-3,
    "boundary_top_ramp": 1e-6, "boundary_right_pressure": "p0*y/H*sin(w*t)", "boundary_right_shear": "0.1*p0*y/H",
    "boundary_left_x": "1e-8*sin(w*t)*y/H", "body_acceleration": "1e5*sin(w*t), -1e5", "damping_stiffness": 2e-9,
    "initial_velocity": "0.01*sin(pi*y/H), 0.1*(x/L - 0.5)", "initial_displacement": "1e-9*y/H, 1e-9*x/L",
    "initial_pressure": "p0*(1 + 0.1*x/L)", "initial_shear": "0.1*p0", "contact_every": 10, "fields_every": 50,
}
FILES = ("history.h5", "contact.h5", "fields.h5")


class InBlock(InScratch):
    def setUp(self):
        super().setUp()
        block(self.folder / "block.msh")

    def result(self, scene, ranks=1, file="history.h5", **changes):
        self.run_scene({**scene, "output_folder": "out", **changes}, ranks=ranks)
        return datasets(self.folder / "out" / file)

    def assert_same_bits(self, left, right):
        for file in FILES:
            if not (self.folder / left / file).exists():
                continue
            one, two = datasets(self.folder / left / file), datasets(self.folder / right / file)
            self.assertEqual(one.keys(), two.keys())
            for name, values in one.items():
                self.assertEqual(values.tobytes(), two[name].tobytes(), f"{file}: {name}")

    def assert_balanced(self, seen):
        self.assertLess(np.abs(seen["energy/residual"] / seen["energy/flowed"])[1:].max(), 1e-10)


class Values(InBlock):
    def test_a_formula_of_constants_is_its_number(self):
        """To the bit, as nothing is left of it in the step."""
        for name, formula, number in (("boundary_top_y", "-1.4e-6*(p0/1e6)", -1.4e-6), ("surface_speed", "p0*2e-6", 2),
                                      ("friction_coefficient", "1/4", 0.25), ("body_acceleration", "w/2, -w", "1e6,-2e6"),
                                      ("initial_velocity", "min(3, w)/3e1, -(0.5)", "0.1,-0.5"), ("surface_height", "-5e-7*(H/H)", -5e-7)):
            with self.subTest(name):
                used = {key: value for key, value in PARAMETERS.items() if key[-2:].strip("_") in formula}
                self.run_scene({**PRESSED, name: number, "output_folder": "number"})
                self.run_scene({**PRESSED, **used, name: formula, "output_folder": "formula"}, ranks=2)
                self.assert_same_bits("number", "formula")

    def test_the_same_bits_on_two_ranks_and_when_a_run_goes_on(self):
        self.run_scene(EVERYTHING, output_folder="alone")
        self.assert_balanced(datasets(self.folder / "alone/history.h5"))
        self.run_scene(EVERYTHING, ranks=2, output_folder="two")
        self.assert_same_bits("alone", "two")
        self.run_scene({**EVERYTHING, "time_end": 2e-6}, ranks=2, output_folder="halves")
        outcome = self.slide("-restart", "halves", "-time_end", 4e-6)
        self.assertEqual(outcome.codes, [0], outcome.err)
        self.assert_same_bits("alone", "halves")

    def test_every_scheme_balances(self):
        for changes in ({"time_beta2": 0.7}, {"time_beta2": 1, "damping_mass": 1e4}):
            seen = self.result(EVERYTHING, ranks=2, **changes)
            self.assert_balanced(seen)
            self.assertGreater(np.abs(seen["energy/body_force"]).max(), 0)

    def test_a_pressure_profile_adds_up(self):
        """Linear between the nodes, so that a profile that is linear is integrated exactly: p0 L/2, moment p0 L²/3."""
        for formula in ("p0*x/L", "p0*x/L*(t >= 0)"):
            for ranks in (1, 2):
                seen = self.result(BODY, ranks, parameters_p0=1e6, boundary_top_pressure=formula, time_end=2e-7,
                                   history_momentum="true")
                gained = np.diff(seen["momentum/linear"][:, 1]) / STEP
                np.testing.assert_allclose(gained, -0.5e6 * SIDE, rtol=1e-9)
                # About the middle: -∫ p (x - L/2) dx = -p0 L²/12, of a body that has hardly moved.
                np.testing.assert_allclose(np.diff(seen["momentum/angular"]) / STEP, -1e6 * SIDE**2 / 12, rtol=1e-9)

    def test_loads_that_follow_time(self):
        """p(t) and a(t): the momentum is their integral by the scheme's own rule, the trapezium."""
        seen = self.result(BODY, 2, parameters_w=2e6, boundary_top_pressure="1e6*sin(w*t)", boundary_top_ramp=1e-6,
                           body_acceleration="1e6*cos(w*t), 0", history_momentum="true")
        t = seen["time"]
        ramp = 0.5 * (1 - np.cos(np.pi * np.minimum(t / 1e-6, 1)))
        for axis, force in ((0, DENSITY * SIDE**2 * 1e6 * np.cos(2e6 * t)), (1, -SIDE * 1e6 * np.sin(2e6 * t) * ramp)):
            expected = np.concatenate([[0], np.cumsum(0.5 * STEP * (force[1:] + force[:-1]))])
            np.testing.assert_allclose(seen["momentum/linear"][:, axis], expected, atol=1e-9 * np.abs(expected).max())
        self.assert_balanced(seen)

    def test_a_body_acceleration_that_varies_in_space(self):
        for ranks in (1, 2):
            seen = self.result(BODY, ranks, body_acceleration="0, 1e6*x/L", history_momentum="true")
            np.testing.assert_allclose(seen["momentum/linear"][:, 1], DENSITY * SIDE**2 * 0.5e6 * seen["time"], rtol=1e-9)
            self.assert_balanced(seen)

    def test_an_imposed_displacement_starts_with_its_own_speed(self):
        """The whole rim moves as a rigid body from the start: nothing is strained."""
        rim = {f"boundary_{side}_{axis}": "0.3*t + 1e4*t^2" for side in ("left", "right", "top", "bottom") for axis in "xy"}
        seen = self.result(BODY, 2, **rim, body_acceleration="2e4,2e4", initial_velocity="0.3,0.3",
                           history_points=f"{SIDE / 2},{SIDE / 2},0,{SIDE}")
        t = seen["time"]
        for point in (0, 1):
            np.testing.assert_allclose(seen[f"points/{point}/u"][:, 1], 0.3 * t + 1e4 * t**2, rtol=0, atol=1e-16)
        self.assertLess(seen["energy/strain"].max(), 1e-12 * seen["energy/kinetic"].max())
        self.assert_balanced(seen)

    def test_friction_along_the_contact(self):
        seen = self.result(PRESSED, 2, "contact.h5", friction_coefficient="0.2 + 0.4*x/L")
        slips = seen["status"] == 2
        self.assertGreater(slips.sum(), 100)
        expected = (0.2 + 0.4 * seen["x"] / SIDE)[None, :] * seen["normal_traction"]
        np.testing.assert_allclose(np.abs(seen["tangential_traction"][slips]), expected[slips], rtol=1e-12)

    def test_a_speed_programme(self):
        """Uniform sliding: the drive is τ times the path of the surface."""
        pressure = 10e6
        scene = {**BODY, **SURFACE, "initial_pressure": pressure, "initial_shear": 0.4 * pressure,
                 "boundary_top_x": "fixed", "boundary_top_y": "fixed", "surface_speed": "2*t/4e-6 + 1",
                 "boundary_left_y": None}
        block(self.folder / "block.msh", periodic=True)
        for ranks in (1, 2):
            seen = self.result(scene, ranks)
            t = seen["time"]
            np.testing.assert_allclose(seen["energy/surface_drive"], 0.4 * pressure * SIDE * (t + t**2 / 4e-6), rtol=1e-9)
            self.assert_balanced(seen)

    def test_a_surface_that_lifts(self):
        """By v t, an elastic column that is held at its top and starts at rest: p = ρ c_d v at once, and the motor's
        work is p v t, half of which is strain and half motion."""
        speed = 0.1
        block(self.folder / "block.msh", periodic=True, divisions=40)
        celerity = np.sqrt(YOUNG * (1 - POISSON) / ((1 + POISSON) * (1 - 2 * POISSON)) / DENSITY)
        seen = self.result(BODY, 2, **{**SURFACE, "friction_law": "none", "friction_coefficient": None},
                           surface_height=f"{speed}*t", boundary_top_y="fixed", time_end=0.8e-6, time_step=5e-9)
        work = DENSITY * celerity * speed**2 * seen["time"] * SIDE
        np.testing.assert_allclose(seen["energy/surface_drive"][-1], work[-1], rtol=0.02)
        self.assert_balanced(seen)
        self.assertLess(seen["energy/impact_loss"][-1], 0.05 * work[-1])


class Faults(InBlock):
    def refused(self, scene, *words, ranks=2):
        outcome = self.slide(*arguments_of(scene), ranks=ranks)
        self.assert_refused("slide", outcome, words, ranks)
        self.assertFalse((self.folder / "out").exists())

    def test_faults_are_named(self):
        for changes, words in (
                ({"boundary_top_y": None, "boundary_top_pressure": "1e6*sin(z)"},
                 ["-boundary_top_pressure is '1e6*sin(z)'", "a number", "formula of x, y, t (Pa)", "'z' at character 9",
                  "is no known name", "known are x, y, t, H, L, pi"]),
                ({"surface_speed": "2*x"}, ["-surface_speed", "formula of t (m/s)", "'x' at character 3 has no meaning here"]),
                ({"surface_speed": "2*vv", "parameters_v1": 3}, ["'vv' at character 3", "did you mean v1?", "the parameters v1"]),
                ({"surface_speed": "2*(t"}, ["-surface_speed is '2*(t'", "at character"]),
                ({"surface_speed": "t = 3"}, ["the = at character 3"]),
                ({"surface_speed": "fast"}, ["-surface_speed is 'fast', but it must be a number", "'fast' at character 1"]),
                ({"friction_coefficient": "0.3 - x/L"},
                 ["-friction_coefficient is '0.3 - x/L'", "must be a number >= 0", "at x = "]),
                ({"friction_coefficient": "0.3 - 1"}, ["which makes -0.7", "must be a number >= 0"]),
                ({"boundary_top_y": "1/x"}, ["-boundary_top_y is '1/x'", "which makes inf", "at x = 0 m"]),
                ({"boundary_top_y": "fxed"}, ["did you mean fixed?"]),
                ({"body_acceleration": "x*t,0"}, ["-body_acceleration varies with the place and with t"]),
                ({"initial_velocity": "x"}, ["-initial_velocity needs two numbers or formulas"]),
                ({"surface_speed": "t", "friction_law": "regularized", "friction_length": 1e-6},
                 ["-surface_speed is a formula", "-friction_time"]),
                ({"parameters_p0": 3}, ["-parameters_p0 has no effect"]),
                ({"parameters_x": 3, "surface_speed": "x"}, ["-parameters_x", "has a meaning of its own"]),
                ({"parameters_sin": 3}, ["-parameters_sin", "has a meaning of its own"]),
                ({"parameters_a-b": 3}, ["-parameters_a-b", "no name for a formula"])):
            with self.subTest(changes=changes):
                self.refused({**PRESSED, **changes}, *words)

    def test_a_formula_that_fails_in_the_run_stops_it(self):
        for changes in ({"friction_coefficient": "0.4 - t/4e-6"}, {"boundary_top_y": "-1e-6*sqrt(1 - t/2e-6)"}):
            with self.subTest(changes=changes):
                outcome = self.slide(*arguments_of({**PRESSED, **changes}), ranks=2)
                self.assertEqual(outcome.codes, [1, 1], outcome.out)
                self.assertIn("a formula has made what is no number", outcome.err)
                self.assertIn("-" + next(iter(changes)), outcome.err)

    def test_in_yaml(self):
        (self.folder / "scene.yaml").write_text(
            "parameters: {p0: 1e6, n: 2}\nboundary:\n  top:\n    pressure: p0*(1 + 0.5*cos(n*pi*x/L))\n"
            "body: {acceleration: [0, -min(p0, 1e5)]}\n")
        outcome = self.slide("-options_file_yaml", "scene.yaml", *arguments_of(BODY), ranks=2)
        self.assertEqual(outcome.codes, [0, 0], outcome.err)
        again = self.slide("-options_file_yaml", "out/run.yaml", "-output_folder", "again")
        self.assertEqual(again.codes, [0], again.err)
        self.assert_same_bits("out", "again")


if __name__ == "__main__":
    unittest.main()
