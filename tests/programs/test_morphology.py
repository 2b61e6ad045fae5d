"""What `morphology` leaves behind: meshes that `slide` runs, files that tell how to draw them again, pictures; and the
recipes in meshes/."""

import struct
import unittest
from pathlib import Path

import numpy as np
import yaml
from drawing import DISCS, FILES, GRAINS, GRID, IMAGE, LAYERS, SQUARE, Drawing, families
from running import arguments_of

RECIPES = sorted((Path(__file__).parents[2] / "meshes").glob("*.yaml"))

SHAPES = {
    "discs": {},
    "ellipses": {"shape": "ellipse", "aspect": 2, "angle_deviation": "any"},
    "rectangles": {"shape": "rectangle", "aspect": 2, "rounding": 0.5, "angle": 20},
    "families": families(),
    "square array": SQUARE,
    "hexagonal array": {**SQUARE, "arrangement": "hexagonal", "rows": 4},
    "laminate": LAYERS,
    "fitted discs": {"cell": "grid", "size": 1e-4},
    "fitted families": families(cell="grid", size=8e-5),
    "fitted laminate": {**LAYERS, "cell": "grid"},
    "fitted block": {**GRID, "structured": None, "cell": "grid"},
    "picture": IMAGE,
    "despeckled picture": {**IMAGE, "image_despeckle": 5},
    "filtered picture": {**IMAGE, "image_median": 1},
    "block": {**GRID, "structured": None},
    "grid": GRID,
    "grid of triangles": {**GRID, "cell": "triangle"},
}

# 20 steps of a block pressed on the surface.
SCENE = {
    "mesh_file": "out/mesh.msh", "output_folder": "run", "time_step": 1e-9, "time_end": 20e-9,
    "material_all_young": 30e9, "material_all_poisson": 0.25, "material_all_density": 1800,
    "boundary_top_x": "fixed", "boundary_top_y": -1e-7,
}
SURFACE = {"surface_boundary": "bottom", "surface_height": 0, "surface_speed": 2, "friction_law": "coulomb",
           "friction_coefficient": 0.5}


class Results(Drawing):
    def setUp(self):
        super().setUp()
        (self.folder / "grains.png").write_bytes(GRAINS)

    def report(self, folder="out"):
        return yaml.safe_load((self.folder / folder / "morphology.yaml").read_text())["run"]

    def test_complete(self):
        said = self.draw(DISCS)
        self.assertEqual({file.name for file in (self.folder / "out").iterdir()}, FILES)
        for words in ("block 4.000 mm x 4.000 mm", "smallest gap", "cells by smallest angle", "the step is set by"):
            self.assertIn(words, said)
        mesh = self.read_mesh()
        self.assertEqual(set(mesh.field_data), {"matrix", "inclusion", "bottom", "right", "top", "left"})
        report = self.report()
        cells = sum(len(block.data) for block in mesh.cells if block.type in ("triangle", "quad"))
        self.assertEqual(report["triangles"] + report["quadrilaterals"], cells)
        self.assertAlmostEqual(report["fraction"]["matrix"] + report["fraction"]["inclusion"], 1, places=12)
        # To within one inclusion.
        self.assertLess(abs(report["fraction"]["inclusion"] - 0.25), np.pi * 0.5e-3**2 / 4e-3**2)

    def test_drawn_again_from_what_it_left(self):
        for name, shape in SHAPES.items():
            with self.subTest(name):
                self.draw(DISCS, **shape)
                self.draw({"options_file_yaml": "out/morphology.yaml", "output_folder": "again"})
                self.assertEqual(self.mesh_bytes(), self.mesh_bytes("again"))
                self.assertEqual((self.folder / "out" / "morphology.png").read_bytes(),
                                 (self.folder / "again" / "morphology.png").read_bytes())

    def test_seeds(self):
        for folder, seed, ranks in (("one", 1, 1), ("same", 1, 1), ("two ranks", 1, 2), ("other", 2, 1)):
            self.draw(DISCS, seed=seed, ranks=ranks, output_folder=folder)
        self.assertEqual(self.mesh_bytes("one"), self.mesh_bytes("same"))
        self.assertEqual(self.mesh_bytes("one"), self.mesh_bytes("two ranks"))
        self.assertNotEqual(self.mesh_bytes("one"), self.mesh_bytes("other"))

    def test_the_same_composite_at_two_sizes(self):
        for size in (2e-4, 1e-4):
            self.draw(DISCS, size=size, gap=1e-4, clearance=1e-4, output_folder=str(size))
        coarse, fine = self.report("0.0002"), self.report("0.0001")
        self.assertEqual((coarse["moved"], coarse["redrawn"], coarse["dropped"]), (0, 0, 0))
        self.assertEqual((coarse["inclusions"], coarse["smallest_gap"]), (fine["inclusions"], fine["smallest_gap"]))
        # The polygons have the area of the discs.
        self.assertAlmostEqual(coarse["fraction"]["inclusion"], fine["fraction"]["inclusion"], places=12)

    def test_families_have_regions_of_their_own(self):
        self.draw(DISCS, **families())
        mesh = self.read_mesh()
        tags = np.concatenate(mesh.cell_data["gmsh:physical"])
        for name in ("matrix", "large", "small"):
            self.assertEqual(mesh.field_data[name][1], 2)
            self.assertGreater(np.count_nonzero(tags == mesh.field_data[name][0]), 10, name)

    def test_picture(self):
        self.draw(DISCS, block_width=8e-3)
        start = (self.folder / "out" / "morphology.png").read_bytes()[:24]
        self.assertEqual(start[:8], b"\x89PNG\r\n\x1a\n")
        self.assertEqual(struct.unpack(">II", start[16:24]), (1200, 600))

    def test_pixels_become_cells(self):
        self.draw(DISCS, **IMAGE)
        mesh = self.read_mesh()
        (inclusion,) = (tag for name, (tag, _) in mesh.field_data.items() if name == "inclusion")
        middles = [mesh.points[cell, :2].mean(axis=0)
                   for block, tags in zip(mesh.cells, mesh.cell_data["gmsh:physical"])
                   if block.type == "quad" for cell, tag in zip(block.data, tags) if tag == inclusion]
        # White squares of 4 x 3 pixels, the picture's first row at the top.
        expected = [((column + 0.5) * 1e-4, (11.5 - row) * 1e-4) for row in range(12) for column in range(16)
                    if (column // 4 + row // 3) % 2]
        np.testing.assert_allclose(sorted(map(tuple, np.round(middles, 9))), sorted(expected), atol=1e-9)

    def test_one_disc_in_the_middle_of_its_cell(self):
        self.draw(DISCS, **{**SQUARE, "columns": 1, "rows": 1, "periodic": "xy", "size": 1e-4})
        mesh = self.read_mesh()
        tag = mesh.field_data["inclusion"][0]
        nodes = np.concatenate([block.data.ravel() for block, tags in zip(mesh.cells, mesh.cell_data["gmsh:physical"])
                                if tags[0] == tag])
        x = mesh.points[np.unique(nodes), :2] - 2e-3
        radius = np.sqrt(0.25 / np.pi) * 4e-3
        # A polygon's corner is off the circle by less than (edge)² / 8 radius.
        self.assertAlmostEqual(np.hypot(*x.T).max(), radius, delta=1e-4**2 / (8 * radius))
        np.testing.assert_allclose(x.min(axis=0), -x.max(axis=0), atol=1e-4**2 / (8 * radius))

    def test_the_later_place_has_the_last_word(self):
        self.draw(DISCS, **families())
        said = self.draw({"options_file_yaml": "out/morphology.yaml", "shape": "none", "structured": "true"})
        self.assertIn("note: -families_large_fraction of out/morphology.yaml gives way to -shape", said)
        self.assertIn("note: -seed of out/morphology.yaml has no effect with -shape none", said)
        self.assertIn("20 columns and 20 rows of cells, 200.0 µm x 200.0 µm", said)

    def test_a_size_that_does_not_divide_the_block(self):
        said = self.draw(DISCS, **{**GRID, "size": 3e-4})
        self.assertIn("13 columns and 13 rows of cells, 307.7 µm x 307.7 µm", said)

    def test_help(self):
        outcome = self.morphology("-help")
        self.assertEqual((outcome.codes, outcome.err), ([0], ""))
        groups = [line for line in outcome.out.splitlines() if line and line[0].isalpha() and " " not in line]
        for group in ("block", "shape", "families", "size", "image", "output"):
            self.assertIn(group, groups)
        self.assertIn("-families_<family>_fraction", outcome.out)
        self.assertEqual({file.name for file in self.folder.iterdir()}, {"grains.png"})


class InSlide(Drawing):
    def setUp(self):
        super().setUp()
        (self.folder / "grains.png").write_bytes(GRAINS)

    def test_every_shape_runs(self):
        for name, shape in SHAPES.items():
            for periodic in ("none", "x"):
                with self.subTest(name, periodic=periodic):
                    self.draw(DISCS, **{**shape, "periodic": periodic})
                    self.run_scene({**SCENE, **SURFACE}, ranks=2)

    def test_a_torus_has_no_boundary(self):
        self.draw(DISCS, periodic="xy")
        refused = self.slide(*arguments_of({**SCENE, **SURFACE}), ranks=2)
        self.assertEqual(refused.codes, [2, 2])
        self.assertIn("boundary", refused.err)
        self.run_scene({name: value for name, value in SCENE.items() if not name.startswith("boundary")}, ranks=2)


class Recipes(Drawing):
    """Those of meshes/."""

    def test_all(self):
        self.assertGreaterEqual(len(RECIPES), 9)
        for recipe in RECIPES:
            with self.subTest(recipe.name):
                said = self.draw({"options_file_yaml": recipe, "output_folder": recipe.stem})
                self.assertNotIn("note:", said)
                self.assertTrue((self.folder / recipe.stem / "mesh.msh").exists())
                self.assertIn(f"morphology -options_file_yaml meshes/{recipe.name}", recipe.read_text())


if __name__ == "__main__":
    unittest.main()
