"""Constants of a material as formulas of the place: with nothing that varies the bits of plain numbers, and the same bits
on any number of ranks. What they make is held to exact solutions in tests/verification/test_graded.py."""

import unittest

import numpy as np
from running import InScratch, arguments_of, datasets
from scenes import SIDE, SQUEAL, block

NUMBERS = {"young": 45e9, "poisson": 0.25, "density": 1800}
ORTHOTROPIC = (60e9, 45e9, 15e9, 20e9, 0, 0)
SCENE = {name: value for name, value in SQUEAL.items() if not name.startswith("material_")}
SCENE |= {"contact_every": 10, "fields_every": 200, "fields_quantities": "u,v,stress,strain,von_mises", "time_end": 10e-6}
UNIFORM = {**SCENE, **{f"material_block_{key}": value for key, value in NUMBERS.items()}}
GRADED = {**SCENE, "material_block_young": "45e9*(1 + 0.5*y/H + 0.2*sin(2*pi*x/L))", "material_block_poisson": "0.2 + 0.1*x/L",
          "material_block_density": "1800*(1 + 0.3*(y/H)^2)"}


class InBlock(InScratch):
    def setUp(self):
        super().setUp()
        block(self.folder / "block.msh")

    def assert_same_bits(self, left, right):
        for file in ("history.h5", "contact.h5", "fields.h5"):
            one, two = (datasets(self.folder / folder / file) for folder in (left, right))
            for name in one:
                self.assertEqual(one[name].tobytes(), two[name].tobytes(), f"{file}: {name}")


class Graded(InBlock):
    def test_nothing_that_varies_has_the_bits_of_a_number(self):
        self.run_scene({**UNIFORM, "output_folder": "number"})
        for key, number in NUMBERS.items():
            with self.subTest(key):
                self.run_scene({**UNIFORM, f"material_block_{key}": f"{number} + 0*x", "output_folder": "formula"}, ranks=2)
                self.assert_same_bits("number", "formula")
        six = {"material_all_density": 1800, "fields_quantities": "u,v,stress,strain"}
        self.run_scene({**SCENE, **six, "material_all_stiffness": ",".join(map(str, ORTHOTROPIC)), "output_folder": "number"})
        formulas = ", ".join(f"{c}*(1 + 0*y)" for c in ORTHOTROPIC)
        self.run_scene({**SCENE, **six, "material_all_stiffness": formulas, "output_folder": "formula"}, ranks=2)
        self.assert_same_bits("number", "formula")

    def test_the_same_bits_on_any_number_of_ranks_and_when_a_run_goes_on(self):
        outcome = self.run_scene(GRADED, output_folder="one")
        self.assertIn("graded", outcome.out)
        self.assertRegex(outcome.out, r"waves along y in block: .* where they are slowest; .* where fastest")
        for ranks in (2, 3):
            self.run_scene(GRADED, ranks=ranks, output_folder="more")
            self.assert_same_bits("one", "more")
        self.run_scene({**GRADED, "stiffness_kernel": "pairs"}, ranks=2, output_folder="pairs")
        self.assert_same_bits("one", "pairs")
        self.run_scene({**GRADED, "time_end": 5e-6}, ranks=2, output_folder="halves")
        outcome = self.slide("-restart", "halves", "-time_end", GRADED["time_end"])
        self.assertEqual(outcome.codes, [0], outcome.err)
        self.assert_same_bits("one", "halves")
        history = datasets(self.folder / "one" / "history.h5")
        self.assertLess(np.abs(history["energy/residual"] / history["energy/flowed"])[1:].max(), 1e-10)

    def test_frames_have_the_strain_and_stress_of_each_cell(self):
        """sigma = C(x) eps with the constants at the mean of the corners."""
        self.run_scene(GRADED, ranks=2, output_folder="out")
        seen = datasets(self.folder / "out" / "fields.h5")
        x, y = seen["mesh/coordinates"][seen["mesh/cells"]].mean(axis=1).T / SIDE
        young, nu = 45e9 * (1 + 0.5 * y + 0.2 * np.sin(2 * np.pi * x)), 0.2 + 0.1 * x
        frame = max(name.split("/")[1] for name in seen if name.startswith("frames/"))
        xx, yy, xy = seen[f"frames/{frame}/strain"].T
        scale = young / ((1 + nu) * (1 - 2 * nu))
        expected = np.stack([scale * ((1 - nu) * xx + nu * yy), scale * ((1 - nu) * yy + nu * xx), 0.5 * young / (1 + nu) * xy], 1)
        np.testing.assert_allclose(seen[f"frames/{frame}/stress"], expected, atol=1e-9 * np.abs(expected).max())
        np.testing.assert_allclose(seen[f"frames/{frame}/stress_zz"], nu * expected[:, :2].sum(axis=1), atol=1e-9 * np.abs(expected).max())

    def test_rows_that_repeat_are_found(self):
        """Along x, where the grading is along y and the nodes are numbered along x."""
        block(self.folder / "block.msh", divisions=32)
        for formula, least in (("45e9*(1 + 0*y)", 50), ("45e9*(1 + x/L + y/H)", 0)):
            outcome = self.run_scene({**UNIFORM, "material_block_young": formula, "time_end": 1e-7})
            part = float(outcome.out.split("the rows of ")[1].split(" %")[0])
            self.assertGreaterEqual(part, least)

    def test_refused(self):
        for name, value, words in (
                ("young", "45e9*(1 + t)", ["-material_block_young", "'t' at character 11 has no meaning here", "known are x, y"]),
                ("young", "45e9*(0.5 - y/H)", ["-material_block_young is '45e9*(0.5 - y/H)', which makes -", "in cell ", "of region 'block' at x = ",
                                               "must be a number", "> 0"]),
                ("poisson", "0.3 + 0.3*x/L", ["-material_block_poisson", "< 0.5", "in cell"]),
                ("density", "1800*(x > L/2)", ["-material_block_density", "which makes 0", "in cell"])):
            with self.subTest(name=name, value=value):
                outcome = self.slide(*arguments_of({**UNIFORM, f"material_block_{name}": value}), ranks=2)
                self.assert_refused("slide", outcome, words, 2)
        outcome = self.slide(*arguments_of({**SCENE, "fields_quantities": "u", "material_all_density": 1,
                                            "material_all_stiffness": "1e9, 1e9, 2e9*y/H, 1e9, 0, 0"}), ranks=2)
        self.assert_refused("slide", outcome, ["-material_all_stiffness is not positive definite", "in cell"], 2)
        outcome = self.slide(*arguments_of({**GRADED, "initial_pressure": 1e6}), ranks=2)
        self.assert_refused("slide", outcome, ["-initial_pressure", "are graded"], 2)


if __name__ == "__main__":
    unittest.main()
