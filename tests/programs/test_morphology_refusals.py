"""Mistakes in a recipe: one sentence that names the option, the fault and the cure, exit code 2 on every rank, no file
touched. Where the sentence names a value that is feasible, that value is.

SLIPSCALE_RANKS says on how many ranks.
"""

import os
import re
import unittest
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field

from drawing import CONTOUR, DISCS, FILES, GRAINS, GRID, IMAGE, LAYERS, SQUARE, Drawing, families, png
from running import arguments_of, snapshot

RANKS = int(os.environ.get("SLIPSCALE_RANKS", "1"))
AT_ONCE = 2
FEASIBLE = r"(?:comes to|at most|less than|give(?: -layer_period)?) ([0-9](?:[0-9.e-]*[0-9])?)"


@dataclass
class Mistake:
    """Words that the sentence must have, and how the recipe is spoiled."""

    words: list
    changes: dict = field(default_factory=dict)  # None leaves an option out
    cure: str = ""  # the option that takes the value after "give at most", "give less than", "give"


def value(option, wrong, *words):
    """A value that the option does not take; the sentence must name both."""
    return Mistake([f"-{option} ", str(wrong), *words], {option: wrong})


def missing(option, **changes):
    return Mistake([f"-{option} ", "needed here but not given"], {**changes, option: None})


def idle(option, given, *words, **changes):
    """An option without effect; the sentence must have it, and the reason."""
    return Mistake([f"-{option} has no effect", *words, "; remove it, or"], {**changes, option: given})


def bad_picture(file, *words):
    return Mistake([f"-image_file '{file}'", *words], {**IMAGE, "image_file": file})


MISTAKES = {
    # What cannot be
    "fraction beyond packing": Mistake(["-fraction 0.92", "densest packing", "give less than"],
                                       {"fraction": 0.92, "gap": 2e-5}),
    "fraction beyond reach": Mistake(["-fraction 0.7 ", "random placement comes to", "-edge cut"],
                                     {"fraction": 0.7, "edge": "inside", "diameter": 5e-4, "gap": 1e-5, "size": 1e-4},
                                     cure="fraction"),
    "fraction below one inclusion": Mistake(["-fraction 0.001", "less than half an inclusion", "give at least"],
                                            {"fraction": 0.001}),
    "array too close": Mistake(["-fraction 0.7 leaves", "less than the gap"],
                               {**SQUARE, "fraction": 0.7}, cure="fraction"),
    "array's diameter too large": Mistake(["-diameter 0.0013 leaves", "less than the gap"],
                                          {**SQUARE, "fraction": None, "diameter": 1.3e-3}, cure="diameter"),
    "gap beyond the spacing": Mistake(["-gap 0.002 is larger than the spacing"], {**SQUARE, "gap": 2e-3}),
    "odd rows on a torus": Mistake(["-rows 3", "even number of rows"],
                                   {**SQUARE, "arrangement": "hexagonal", "periodic": "xy"}, cure="rows"),
    "inclusion larger than the block": Mistake(["-diameter 0.005", "the width of the block (0.004 m)"],
                                               {"diameter": 5e-3, "fraction": 0.7, "periodic": "x"}, cure="diameter"),
    "family larger than the block": Mistake(["-families_large_diameter 0.005", "block (0.004 m)"],
                                            families(families_large_diameter=5e-3)),
    "keep-out as high as the block": Mistake(["-keep_out", "no room for inclusions along the height"],
                                             {"keep_out": 4e-3}),
    "size larger than the block": Mistake(["-size 0.005 is more than the width of the block (0.004 m)"],
                                          {**GRID, "size": 5e-3}, cure="size"),
    "size larger than the inclusions": Mistake(["-size 0.0015 is more than the inclusions are wide (0.001 m)"],
                                               {"size": 1.5e-3}),
    "interface edge beyond the ellipse": Mistake(
        ["-size_interface 0.0003 is more than the inclusions are wide (0.00025 m)"],
        {"shape": "ellipse", "aspect": 4, "size": 3e-4, "size_interface": 3e-4}),
    "interface edge beyond the array": Mistake(["-size 0.001 is more than the inclusions are wide"],
                                               {**SQUARE, "size": 1e-3, "gap": 0}),
    "interface coarser than the bulk": Mistake(["-size_interface 0.0003 is more than -size (0.0002 m)"],
                                               {"size_interface": 3e-4}, cure="size_interface"),
    "surface coarser than the bulk": Mistake(["-size_surface 0.0003 is more than -size (0.0002 m)"],
                                             {"size_surface": 3e-4}, cure="size_surface"),
    "two cells across a period": Mistake(["-size 0.002", "fewer than three cells across the periodic width"],
                                         {**GRID, "periodic": "x", "size": 2e-3}, cure="size"),
    "two cells across a period, free mesh": Mistake(
        ["-size 0.0014", "fewer than three cells across the periodic height"],
        {**GRID, "structured": None, "periodic": "xy", "size": 1.4e-3,
         "block_width": 6e-3}, cure="size"),
    "more cells than a file holds": Mistake(["-size asks for about", "give a larger one"], {"size": 1e-7}),
    "laminate off its period": Mistake(["hold", "3.5 periods along y", "-layer_period"],
                                       {**LAYERS, "periodic": "xy", "layer_period": 4e-3 / 3.5}, cure="layer_period"),
    "laminate thicker than the block": Mistake(
        ["-layer_period 0.005 is more than the block across the layers (0.004 m)"],
        {**LAYERS, "layer_period": 5e-3}, cure="layer_period"),
    "layers thinner than the edges": Mistake(["-size 0.0002 is more than the thinner layers are thick (5e-05 m)"],
                                             {**LAYERS, "fraction": 0.05}, cure="size"),
    "cells beyond mending": Mistake(["-worst_angle asks for 44", "smaller -worst_angle"], {"worst_angle": 44}),
    # Pictures
    "picture missing": bad_picture("absent.png", "cannot be opened", "PNG or PGM"),
    "picture is a folder": bad_picture(".", "cannot be opened"),
    "picture is garbage": bad_picture("prose.png", "cannot be read", "PNG or PGM"),
    "picture truncated": bad_picture("truncated.png", "cannot be read"),
    "picture truncated, PGM": bad_picture("truncated.pgm", "ends early"),
    "picture without size": bad_picture("header.pgm", "header that makes no sense"),
    "picture without a region's grey": Mistake(["no pixel", "region 'inclusion'", "-image_levels"],
                                               {**IMAGE, "image_file": "dark.png"}),
    "picture too narrow for a period": Mistake(["'narrow.png' has 2 columns", "-periodic x"],
                                               {**IMAGE, "image_file": "narrow.png", "periodic": "x"}),
    "levels descend": Mistake(["-image_levels must ascend", "0.3 follows 0.6"], {**IMAGE, "image_levels": "0.6,0.3"}),
    "level beyond white": Mistake(["-image_levels", "1.5"], {**IMAGE, "image_levels": "0.5,1.5"}),
    "one region name for two": Mistake(["-image_regions names 1 regions", "part 2"],
                                       {**IMAGE, "image_regions": "matrix"}),
    "region name twice": Mistake(["'Grain'", "another region (capitals do not count)"],
                                 {**IMAGE, "image_regions": "grain,Grain"}),
    "region name empty": Mistake(["-image_regions", "no option can spell"], {**IMAGE, "image_regions": ",grain"}),
    "region named like a side": Mistake(["'top'", "name of a side"], {**IMAGE, "image_regions": "matrix,top"}),
    # Families
    "family key misspelt": Mistake(
        ["-families_large_fractoin is not an option", "did you mean -families_large_fraction?"],
        families(families_large_fractoin=0.1)),
    "families differ in capitals": Mistake(["the family 'large'", "another region (capitals do not count)"],
                                           families(families_Large_aspect=2)),
    "family named matrix": Mistake(["'matrix'", "another region"],
                                   families(families_matrix_shape="disc", families_matrix_fraction=0.1,
                                            families_matrix_diameter=1e-3)),
    "family named like a side": Mistake(["the family 'Top'", "name of a side"], families(families_Top_shape="disc")),
    "family named all": Mistake(["the family 'all'", "meaning of its own"], families(families_all_shape="disc")),
    "family without fraction": missing("families_large_fraction", **families()),
    "families and a shape": Mistake(["-shape contradicts -families_large_diameter"], {**families(), "shape": "disc"}),
    "families in an array": Mistake(["-arrangement square", "families"], {**families(), **SQUARE}),
    # Without effect
    "fraction beside families": idle("fraction", 0.2, "beside families", **families()),
    "seed of an array": idle("seed", 3, "with -arrangement square", **SQUARE),
    "deviation in an array": idle("diameter_deviation", 0.1, "in an array", **SQUARE),
    "columns at random": idle("columns", 3, "with -arrangement random"),
    "aspect of a disc": idle("aspect", 2, "with -shape disc"),
    "aspect of a family of discs": idle("families_large_aspect", 2, "with -families_large_shape disc", **families()),
    "rounding of an ellipse": idle("rounding", 0.5, "with -shape ellipse", shape="ellipse", aspect=2),
    "distribution of equal discs": idle("diameter_distribution", "uniform", "with equal diameters"),
    "angle of any angle": idle("angle", 30, "-angle_deviation any", shape="ellipse", aspect=2, angle_deviation="any"),
    "growth without refinement": idle("size_growth", 0.1, "with edges of one length"),
    "keep-out on a torus": idle("keep_out", 1e-4, "with -periodic xy", periodic="xy"),
    "strip of a torus": idle("microstructure_height", 2e-3, "with -periodic xy", periodic="xy"),
    "strip of a laminate": idle("microstructure_height", 2e-3, "with -shape laminate", **LAYERS),
    "strip as high as the block": Mistake(["-microstructure_height 0.004 leaves less than a cell (0.0002 m) above it"],
                                          {"microstructure_height": 4e-3}, cure="microstructure_height"),
    "strip lower than a cell": Mistake(["-microstructure_height 0.0001 leaves less than a cell", "smaller -size"],
                                       {"microstructure_height": 1e-4}),
    "strip without inclusions": Mistake(["-microstructure_height 0.0004 leaves no inclusion of the region 'inclusion'"],
                                        {"microstructure_height": 4e-4, "edge": "inside"}),
    "picture of discs": idle("image_file", "grains.png", "with inclusions"),
    "layers of discs": idle("layer_period", 1e-3, "with inclusions"),
    "structured discs": idle("structured", "true", "with interfaces inside the block"),
    "interface edges of a grid": idle("size_interface", 1e-4, "with -cell grid", cell="grid"),
    "structured beside a grid": idle("structured", "true", "with -cell grid", **{**GRID, "cell": "grid",
                                                                                 "structured": None}),
    "gap finer than the grid": Mistake(["-size 0.0002 is too coarse for the grid", "m apart"],
                                       {**SQUARE, "cell": "grid", "fraction": 0.78, "gap": 0, "clearance": 0,
                                        "periodic": "x"}),
    "angle in a structured mesh": idle("worst_angle", 20, "with -structured", **GRID),
    "discs in a homogeneous block": idle("fraction", 0.2, "with -shape none", **GRID),
    "gap of a laminate": idle("gap", 1e-4, "with -shape laminate", **LAYERS),
    "size of a picture": idle("size", 1e-4, "with -shape image", "give -cell grid", **IMAGE),
    "triangles of a picture": idle("cell", "triangle", "whose pixels are the cells", "give -cell grid", **IMAGE),
    "contour's width": idle("block_width", 1e-4, "with -shape image", **CONTOUR),
    "contour's edges": idle("size_surface", 1e-6, "with -cell grid", **CONTOUR),
    "contours of three regions": Mistake(["-image_levels gives 2 levels", "leave out -cell grid"],
                                         {**CONTOUR, "image_levels": "0.3,0.6", "image_regions": "a,b,c"}),
    "contour coarser than the picture": Mistake(["-size 2e-05 is more than the height of the picture (1.2e-05 m)"],
                                                {**CONTOUR, "size": 2e-5}),
    "contour coarser than the period": Mistake(["-size 6e-06 leaves fewer than three cells"],
                                               {**CONTOUR, "size": 6e-6, "periodic": "x"}),
    "contour lost between the nodes": Mistake(["-size 2e-06 is too coarse for the picture", "0.500 of the pixels",
                                               "give a smaller one"], CONTOUR),
    "width of a picture": idle("block_width", 1e-4, "with -shape image", **IMAGE),
    "fraction and diameter of an array": Mistake(["-fraction contradicts -diameter"], {**SQUARE, "diameter": 1e-3}),
    # Numbers and words
    "no shape": missing("shape"),
    "no width": missing("block_width"),
    "no size": missing("size"),
    "no diameter": missing("diameter"),
    "no aspect": missing("aspect", shape="ellipse"),
    "no columns": missing("columns", **{**SQUARE, "columns": None}),
    "no folder": missing("output_folder"),
    "size zero": value("size", 0, "> 0", "(m)"),
    "height negative": value("block_height", -1e-3, "> 0"),
    "fraction zero": value("fraction", 0, "above 0 and below 1"),
    "fraction one": value("fraction", 1, "above 0 and below 1"),
    "fraction in percent": value("fraction", "30%", "number"),
    "diameter negative": value("diameter", -1, "> 0"),
    "gap negative": value("gap", -1e-5, ">= 0"),
    "strip negative": value("microstructure_height", -1e-3, "none or a number"),
    "keep-out negative": value("keep_out", -1e-5, ">= 0"),
    "aspect below one": value("aspect", 0.5, ">= 1"),
    "rounding zero": value("rounding", 0, "> 0 and <= 1"),
    "seed negative": value("seed", -1, "from 0 to 2147483647"),
    "seed beyond its bound": value("seed", 4294967296, "at most 2147483647"),
    "seed no whole number": value("seed", 1.5, "whole number"),
    "columns zero": value("columns", 0, "from 1 to 2147483647"),
    "worst angle 45": value("worst_angle", 45, "below 45"),
    "angle a word": value("angle", "north", "degree"),
    "spread a word": value("angle_deviation", "some", "any or a number"),
    "shape nonsense": value("shape", "discs", "did you mean disc?"),
    "arrangement nonsense": value("arrangement", "cubic", "square"),
    "periodic nonsense": value("periodic", "y", "none, x or xy"),
    "option unknown": Mistake(["-wind_speed is not an option of morphology"], {"wind_speed": 3}),
    "option misspelt": Mistake(["did you mean -diameter?"], {"diametre": 1e-3}),
    "an option of PETSc's that nobody reads": Mistake(["-ksp_type was given but neither morphology nor PETSc"],
                                                      {"ksp_type": "cg"}),
    # Folders
    "folder is a file": Mistake(["-output_folder 'prose.png'", "is no folder"], {"output_folder": "prose.png"}),
    "folder in a file": Mistake(["-output_folder 'prose.png/out'", "is no folder"],
                                {"output_folder": "prose.png/out"}),
    "folder that nobody can make": Mistake(["-output_folder '/proc/slipscale'"], {"output_folder": "/proc/slipscale"}),
}


def pictures(folder):
    (folder / "grains.png").write_bytes(GRAINS)
    (folder / "truncated.png").write_bytes(GRAINS[:len(GRAINS) // 2])
    (folder / "dark.png").write_bytes(png([[0, 10, 20]] * 3))
    (folder / "narrow.png").write_bytes(png([[0, 255]] * 3))
    (folder / "truncated.pgm").write_text("P2 3 2 255\n0 255 0 255\n")
    (folder / "header.pgm").write_text("P2 3 0 255\n0 255 0\n")
    (folder / "prose.png").write_text("A picture has pixels.\n")


class Refusals(Drawing):
    def test_mistakes(self):
        with ThreadPoolExecutor(AT_ONCE) as pool:
            made = {name: pool.submit(self.make, mistake, self.folder / str(count), (count + RANKS) % 2 == 0)
                    for count, (name, mistake) in enumerate(MISTAKES.items())}
            for name, mistake in MISTAKES.items():
                with self.subTest(name):
                    self.check(mistake, *made[name].result())

    def make(self, mistake, folder, older):
        """Draws the spoiled recipe in its own folder: what was said, and what the folder held before and after.

        Files of an older mesh may be there or not: each mistake meets both, on one rank or on two.
        """
        folder.mkdir()
        pictures(folder)
        if older:
            (folder / "out").mkdir()
            for file in (*FILES, "notes.txt"):
                (folder / "out" / file).write_text("of an older mesh")
        before = snapshot(folder)
        outcome = self.morphology(*arguments_of({**DISCS, **mistake.changes}), ranks=RANKS, folder=folder)
        return outcome, before, snapshot(folder), folder

    def check(self, mistake, outcome, before, after, folder):
        self.assert_refused("morphology", outcome, mistake.words, RANKS)
        self.assertEqual(before, after, "files were touched")
        if mistake.cure and RANKS == 1:
            feasible = re.search(FEASIBLE, outcome.err)
            self.assertTrue(feasible, outcome.err)
            cured = {**DISCS, **mistake.changes, mistake.cure: feasible[1]}
            again = self.morphology(*arguments_of(cured), folder=folder)
            self.assertEqual((again.codes, again.err), ([0], ""), outcome.err)


if __name__ == "__main__":
    unittest.main()
