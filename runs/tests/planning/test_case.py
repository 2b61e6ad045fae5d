"""What scene and recipe say about waves, memory and sizes."""

import math
import unittest

from slipscale.mistakes import Mistake
from slipscale.planning.case import case_of, memory_of, speeds

SCENE = {"material_all_young": 45e9, "material_all_poisson": 0.25, "material_all_density": 1800, "surface_boundary": "bottom",
         "surface_speed": 2, "friction_law": "regularized", "friction_coefficient": 0.5, "friction_time": 1e-7,
         "time_end": 400e-6, "history_every": 20}
BLOCK = {"block_width": 5e-3, "block_height": 5e-3, "shape": "none"}
DISCS = {**BLOCK, "shape": "disc", "diameter": 0.5e-3, "fraction": 0.3, "size": 50e-6, "size_surface": 25e-6}


class Cases(unittest.TestCase):
    def test_wave_speeds(self):
        self.assertAlmostEqual(speeds(SCENE)["all"][0], math.sqrt(54e9 / 1800), delta=1e-9)
        self.assertAlmostEqual(speeds(SCENE)["all"][1], math.sqrt(18e9 / 1800), delta=1e-9)
        of_six = {"material_matrix_stiffness": "54e9,18e9,54e9,18e9,0,0", "material_matrix_density": 1800}
        self.assertAlmostEqual(speeds(of_six)["matrix"][0], math.sqrt(54e9 / 1800), delta=1e-9)
        with self.assertRaisesRegex(Mistake, "young, poisson and density of all"):
            speeds({"material_all_young": 45e9})

    def test_memory(self):
        self.assertEqual(memory_of(SCENE), 1e-7)
        length = {**SCENE, "friction_length": 1.2e-6}
        length.pop("friction_time")
        self.assertAlmostEqual(memory_of(length), 0.6e-6)
        self.assertAlmostEqual(memory_of({**length, "friction_rate": "slip", "friction_rate_reference": 1}), 0.4e-6)
        self.assertEqual(memory_of({**SCENE, "friction_law": "coulomb"}), 0.0)
        self.assertIsNone(memory_of({**SCENE, "friction_law": "none"}))
        self.assertIsNone(memory_of({**SCENE, "friction_coefficient": 0}))
        self.assertEqual(memory_of({**SCENE, "friction_coefficient": "0.3 + 0.1*x", "surface_speed": "2*t"}), 1e-7)
        with self.assertRaisesRegex(Mistake, "give friction_time"):
            memory_of({**length, "surface_speed": "2*t"})

    def test_largest_cells(self):
        """c_s T = 316 µm over two cells; a disc of 500 µm over 2.5."""
        self.assertAlmostEqual(case_of(SCENE, BLOCK).longest_size()[0], 0.5 * math.sqrt(1e7) * 1e-7)
        self.assertAlmostEqual(case_of({**SCENE, "friction_time": 1e-6}, DISCS).longest_size()[0], 200e-6)

    def test_recipe_at_a_size(self):
        case = case_of(SCENE, DISCS)
        coarse = case.recipe_of("triangle", 100e-6, seed=3)
        self.assertEqual((coarse["size"], coarse["size_surface"], coarse["seed"]), (100e-6, 50e-6, 3))
        self.assertEqual((coarse["gap"], coarse["clearance"]), (50e-6, 50e-6))  # of the recipe, at every size
        self.assertNotIn("size_surface", case.recipe_of("grid", 100e-6))

    def test_a_drawing_does_not_follow_the_size(self):
        """Gaps that the recipe leaves open are the same at every size, also where it gives none that they would follow."""
        open_ = {name: value for name, value in DISCS.items() if name != "size"}
        for recipe, gaps in ((DISCS, (50e-6, 50e-6)), (open_, (75e-6, 75e-6)), ({**open_, "gap": 60e-6}, (60e-6, 75e-6))):
            for size in (200e-6, 50e-6):
                found = case_of(SCENE, recipe).recipe_of("grid", size)
                self.assertEqual(gaps, (found["gap"], found["clearance"]))
        self.assertIsNone(case_of(SCENE, {**open_, "gap": 60e-6, "clearance": "60e-6"}).gap())
        self.assertNotIn("gap", case_of(SCENE, BLOCK).recipe_of("grid", 1e-4))

    def test_windows(self):
        case = case_of(SCENE, BLOCK)
        self.assertEqual(case.window, (200e-6, 400e-6))
        self.assertAlmostEqual(case.scene_of(3)["time_end"], 800e-6)
        self.assertNotIn("history_every", case.scene_of())
        with self.assertRaisesRegex(Mistake, "window"):
            case_of(SCENE, BLOCK, window=(2e-4, 1e-4))
        with self.assertRaisesRegex(Mistake, "no block_width"):
            case_of(SCENE, {"block_height": 1})


if __name__ == "__main__":
    unittest.main()
