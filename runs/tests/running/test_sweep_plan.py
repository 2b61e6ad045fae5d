"""Which option of a sweep goes to which program: meshes, effective materials and scenes of its runs."""

import tempfile
import unittest
from pathlib import Path

from slipscale.mistakes import Mistake
from slipscale.running.sweep_plan import plan

NUMBER = "a number > 0 (m)"
MATERIAL = {"material_<region>_young": "a number > 0 (Pa)", "material_<region>_file": "a text", "mesh_file": "a text"}
MANUALS = {
    "slide": {**MATERIAL, "friction_coefficient": "a number >= 0 (ratio)", "surface_speed": "a number (m/s)",
              "history_points": "numbers separated by commas (m)"},
    "morphology": {"seed": "a whole number >= 0", "fraction": NUMBER, "size": NUMBER, "shape": "none or disc"},
    "homogenize": {**MATERIAL, "cell_boundary": "periodic or kubc"},
}
BLOCK = {"shape": "none", "size": 1e-3}
SCENE = {"surface": {"speed": 2}, "material": {"all": {"young": 45e9}}}
COMPOSITE = {"mesh": {"shape": "disc", "fraction": 0.3, "size": 5e-4},
             "options": {"cell_boundary": "kubc",
                         "material": {"matrix": {"young": 30e9}, "inclusion": {"young": 80e9}}}}


def planned(sweep, mesh=BLOCK, homogenize=None, scene=SCENE, rows=None):
    return plan({"mesh": mesh, "homogenize": homogenize, "scene": scene, "sweep": sweep, "list": rows}, MANUALS)


class Plans(unittest.TestCase):
    def test_options_of_slide_share_a_mesh(self):
        found = planned({"surface_speed": [1, 2], "friction_coefficient": "0.1:0.1:0.2"})
        self.assertEqual(list(found.runs)[:2], ["surface_speed_1-friction_coefficient_0.1",
                                                "surface_speed_1-friction_coefficient_0.2"])
        self.assertEqual(found.meshes, {"block": BLOCK})
        scene = found.scenes["surface_speed_1-friction_coefficient_0.2"]
        self.assertEqual(scene, {"mesh": "block", "effective": None, "files": [], "options": {
            "surface_speed": 1, "material_all_young": 45e9, "friction_coefficient": 0.2}})

    def test_options_of_morphology_make_meshes(self):
        found = planned({"seed": [1, 2], "surface_speed": 1})
        self.assertEqual(found.meshes, {"block-seed_1": {**BLOCK, "seed": 1}, "block-seed_2": {**BLOCK, "seed": 2}})
        self.assertEqual(found.scenes["seed_2-surface_speed_1"]["mesh"], "block-seed_2")
        self.assertNotIn("seed", found.scenes["seed_2-surface_speed_1"]["options"])

    def test_a_homogenised_block(self):
        scene = {"surface_speed": 2}
        found = planned({"seed": [1, 2], "material_matrix_young": [10e9, 30e9], "surface_speed": [1, 2]}, BLOCK,
                        COMPOSITE, scene)
        self.assertEqual(len(found.runs), 8)
        self.assertEqual(set(found.meshes), {"block", "composite-seed_1", "composite-seed_2"})
        self.assertEqual(len(found.effectives), 4)
        run = found.scenes["seed_2-material_matrix_young_10000000000.0-surface_speed_1"]
        self.assertEqual((run["mesh"], run["options"]), ("block", {"surface_speed": 1}))
        mesh, options = found.effectives[run["effective"]]
        self.assertEqual(mesh, "composite-seed_2")
        self.assertEqual(options, {"cell_boundary": "kubc", "material_matrix_young": 10e9,
                                   "material_inclusion_young": 80e9})

    def test_an_option_changes_every_recipe_that_names_it(self):
        found = planned({"size": [1e-4], "fraction": [0.2]}, BLOCK, COMPOSITE, {})
        self.assertEqual(found.meshes, {
            "block-size_0.0001": {"shape": "none", "size": 1e-4},
            "composite-size_0.0001-fraction_0.2": {"shape": "disc", "fraction": 0.2, "size": 1e-4}})

    def test_a_mesh_of_ones_own(self):
        with tempfile.TemporaryDirectory() as folder:
            meshes = [f"{folder}/{name}.msh" for name in "ab"]
            for mesh in meshes:
                Path(mesh).write_text("")
            found = planned({"mesh_file": meshes}, None)
            self.assertEqual([scene["files"] for scene in found.scenes.values()], [[mesh] for mesh in meshes])
            self.assertEqual({scene["mesh"] for scene in found.scenes.values()}, {None})
            self.assertEqual(found.meshes, {})
            for mesh, sentence in ((BLOCK, "not both"), (None, "option of morphology, but there is no recipe")):
                with self.assertRaisesRegex(Mistake, sentence):
                    planned({"seed": 1}, mesh, scene={**SCENE, "mesh_file": meshes[0]})
        with self.assertRaisesRegex(Mistake, "There is no .*a.msh"):
            planned({"mesh_file": meshes}, None)

    def test_null_takes_an_option_away(self):
        found = planned({"surface_speed": [1, 2], "friction_coefficient": None},
                        scene={**SCENE, "history_points": None})
        self.assertEqual(list(found.runs), ["surface_speed_1", "surface_speed_2"])
        self.assertNotIn("history_points", found.scenes["surface_speed_1"]["options"])

    def test_rows(self):
        found = planned({}, rows=[{"seed": 3}, {"friction_coefficient": 0.5, "surface_speed": 1}])
        self.assertEqual(list(found.runs.values()), [{"seed": 3, "surface_speed": 2},
                                                     {"friction_coefficient": 0.5, "surface_speed": 1}])
        self.assertEqual(found.scenes["seed_3-surface_speed_2"]["options"]["surface_speed"], 2)
        self.assertEqual(found.usual, {"seed": None, "friction_coefficient": None, "surface_speed": 2})
        self.assertEqual(list(found.usual), ["seed", "friction_coefficient", "surface_speed"])

    def test_a_row_and_a_combination_that_are_equal_are_one_run(self):
        found = planned({"seed": [1, 2], "size": [1e-3]}, rows=[{"seed": 2}, {"seed": 3}])
        self.assertEqual(list(found.meshes), [f"block-seed_{seed}-size_0.001" for seed in (1, 2, 3)])
        self.assertEqual(len(found.runs), 3)
        # What two recipes say differently is neither's.
        found = planned({"size": [2e-4]}, BLOCK, COMPOSITE, {}, [{"seed": 4}])
        self.assertEqual(list(found.runs), ["size_0.0002", "seed_4"])
        self.assertEqual(found.meshes["block"], BLOCK)

    def test_mistakes_anywhere(self):
        for words, sentence in (({"sweep": {"sed": 1}}, "-sed; is -seed meant"),
                                ({"sweep": {}, "scene": {"surface": {"sped": 1}}}, "-surface_sped"),
                                ({"sweep": {}, "mesh": {**BLOCK, "sise": 1}}, "-sise; is -size meant"),
                                ({"sweep": {}, "mesh": {**BLOCK, "surface_speed": 1}}, "None of morphology"),
                                ({"sweep": {"cell_boundary": "kubc"}}, "-cell_boundary"),
                                ({"sweep": {}, "mesh": None}, "needs a recipe"),
                                ({"sweep": {}, "scene": {"output_folder": "x"}}, "gives each run a folder")):
            with self.assertRaisesRegex(Mistake, sentence):
                planned(**words)


if __name__ == "__main__":
    unittest.main()
