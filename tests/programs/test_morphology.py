"""What `morphology` leaves behind: meshes that `slide` runs, files that tell how to draw them again, pictures; and the
recipes in meshes/."""

import struct
import unittest
from pathlib import Path

import numpy as np
import yaml
from drawing import CONTOUR, DISCS, FILES, GRAINS, GRID, IMAGE, LAYERS, SQUARE, Drawing, families, png
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
    "strip of discs": {"microstructure_height": 2e-3},
    "strip of fitted discs": {"microstructure_height": 2e-3, "cell": "grid", "size": 1e-4},
    "fitted discs": {"cell": "grid", "size": 1e-4},
    "fitted families": families(cell="grid", size=8e-5),
    "fitted laminate": {**LAYERS, "cell": "grid"},
    "fitted block": {**GRID, "structured": None, "cell": "grid"},
    "picture": IMAGE,
    "despeckled picture": {**IMAGE, "image_despeckle": 5},
    "filtered picture": {**IMAGE, "image_median": 1},
    "contour of a picture": {**CONTOUR, "image_pixel": 1e-4, "size": 3e-5},
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

    def test_a_strip_of_the_composite_it_is_cut_from(self):
        """Above its end there is one region, which slide gives a material of its own; below it the same area."""
        for cell in ("triangle", "quadrilateral", "grid"):
            with self.subTest(cell):
                self.draw(DISCS, microstructure_height=2e-3, cell=cell, size=1e-4)
                report = self.report()
                end = report["microstructure_end"]
                self.assertAlmostEqual(end, 2e-3, delta=2e-4)
                mesh = self.read_mesh()
                (above,) = (tag for name, (tag, _) in mesh.field_data.items() if name == "homogenized")
                lowest = min(mesh.points[cell, 1].mean() for block, tags in zip(mesh.cells,
                                                                                mesh.cell_data["gmsh:physical"])
                             if block.type in ("triangle", "quad") for cell, tag in zip(block.data, tags) if tag == above)
                self.assertGreater(lowest, end - 1e-5)
                self.assertAlmostEqual(sum(report["fraction"].values()), 1, places=12)

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


# Columns, rows, radius in pixels, in a picture of 104 x 100.
CIRCLES = np.array([(28.3, 30.1, 17.2), (75.4, 66.7, 22.9), (80.2, 22.3, 15.6), (24.7, 74.2, 14.1)])
ACROSS_SIDES = np.array([(3.0, 50.2, 20.3), (60.2, 2.4, 21.1)])
COLUMNS, ROWS = 104, 100


def outside(circles, x, periodic=False):
    """Distance of points [.., 2] from the nearest circle, negative inside it; pixels."""
    apart = x[..., None, :] - circles[:, :2]
    if periodic:
        apart -= np.array([COLUMNS, ROWS]) * np.round(apart / (COLUMNS, ROWS))
    distance = np.hypot(apart[..., 0], apart[..., 1]) - circles[:, 2]
    return np.take_along_axis(distance, np.abs(distance).argmin(-1)[..., None], -1)[..., 0]


def photograph(circles, width, periodic=False):
    """Grey [rows][columns] 0 to 255 of white discs whose edges go from white to black within `width` pixels; 0 is
    black and white."""
    row, column = np.mgrid[0:ROWS, 0:COLUMNS]
    inside = -outside(circles, np.stack([column + 0.5, ROWS - row - 0.5], -1), periodic)
    grey = np.clip(0.5 + inside / width, 0, 1) if width else 1.0 * (inside >= 0)
    return np.round(255 * grey).astype(int).tolist()


class Contours(Drawing):
    """Squares fitted to the contours of pictures of discs."""

    def contour(self, grey, **changes):
        """Fits a picture: the run's report, the places [.., 2] of the nodes on the interface and its length, pixels."""
        (self.folder / "discs.png").write_bytes(png(grey))
        self.said = self.draw(DISCS, **{**CONTOUR, "image_file": "discs.png", **changes})
        mesh, beside = self.read_mesh(), {}
        for block, tags in zip(mesh.cells, mesh.cell_data["gmsh:physical"]):
            for cell, tag in zip(block.data, tags) if block.type in ("triangle", "quad") else ():
                for edge in zip(cell, np.roll(cell, -1)):
                    beside.setdefault(tuple(sorted(edge)), set()).add(tag)
        edges = np.array([edge for edge, tags in beside.items() if len(tags) == 2])
        x = mesh.points[:, :2] / CONTOUR["image_pixel"]
        length = np.linalg.norm(x[edges[:, 0]] - x[edges[:, 1]], axis=1).sum()
        return yaml.safe_load((self.folder / "out" / "morphology.yaml").read_text())["run"], x[np.unique(edges)], length

    def check_fraction(self, report, circles):
        fraction = report["fraction"]["inclusion"]
        self.assertAlmostEqual(fraction, report["pixel_fraction"], delta=1e-4)
        self.assertAlmostEqual(fraction, np.pi * (circles[:, 2]**2).sum() / (ROWS * COLUMNS), delta=1e-3)

    def test_edges_in_grey(self):
        report, x, length = self.contour(photograph(CIRCLES, 2))
        self.check_fraction(report, CIRCLES)
        self.assertLess(np.abs(outside(CIRCLES, x)).max(), 0.1)
        self.assertAlmostEqual(length / (2 * np.pi * CIRCLES[:, 2].sum()), 1, delta=2e-3)
        self.assertEqual(report["unresolved"], 0)
        # Two pixels are a cell, and the step is what the grid has at drawn discs.
        self.assertIn("52 columns and 50 rows of cells", self.said)
        self.assertGreater(report["step_length"], 0.35 * report["median_step_length"])
        self.assertGreater(report["smallest_angle"], 18)

    def test_black_and_white(self):
        """Where the edges of pixels are 4/pi of the circle's length."""
        report, x, length = self.contour(photograph(CIRCLES, 0), image_median=1)
        self.check_fraction(report, CIRCLES)
        self.assertLess(np.abs(outside(CIRCLES, x)).max(), 0.75)
        self.assertAlmostEqual(length / (2 * np.pi * CIRCLES[:, 2].sum()), 1, delta=0.03)

    def test_across_periodic_sides(self):
        report, x, _ = self.contour(photograph(ACROSS_SIDES, 2, periodic=True), periodic="xy")
        self.check_fraction(report, ACROSS_SIDES)
        self.assertLess(np.abs(outside(ACROSS_SIDES, x, periodic=True)).max(), 0.1)

    def test_despeckled(self):
        grey = photograph(CIRCLES, 2)
        clean = self.contour(grey)
        for row, column, value in ((50, 48, 255), (50, 49, 255), (33, 75, 0)):
            grey[row][column] = value
        spotted = self.contour(grey, image_despeckle=4)
        self.assertEqual(clean[0]["fraction"], spotted[0]["fraction"])
        self.assertEqual(clean[1].tolist(), spotted[1].tolist())
        self.assertGreater(spotted[0]["despeckled"], 0)

    def test_a_band_thinner_than_a_cell_is_counted(self):
        grey = photograph(CIRCLES, 2)
        grey[48] = grey[49] = [255] * COLUMNS
        report, _, _ = self.contour(grey, size=6e-6)
        self.assertGreater(report["unresolved"], 5)
        self.assertIn(f"too coarse for the grid in {report['unresolved']} places", self.said)
        self.assertEqual(self.contour(grey, size=1e-6)[0]["unresolved"], 0)


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
