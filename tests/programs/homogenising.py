"""Runs `homogenize` as a user does. The environment says where it is: SLIPSCALE_HOMOGENIZE."""

import os
import shutil
import subprocess

import numpy as np
import yaml
from drawing import Drawing
from running import arguments_of

HOMOGENIZE = os.environ["SLIPSCALE_HOMOGENIZE"]
FILES = {"effective.yaml", "localization.h5", "localization.xdmf"}
SIDE = 1e-3  # m

# Periodic cells of some 270 triangles.
DISCS = {"block_width": SIDE, "block_height": SIDE, "size": 1e-4, "periodic": "xy",
         "shape": "disc", "fraction": 0.25, "diameter": 4e-4, "seed": 1, "gap": 5e-5, "output_folder": "drawn"}
LAYERS = {**DISCS, "shape": "laminate", "fraction": 0.4, "layer_period": SIDE / 2, "diameter": None, "seed": None,
          "gap": None}

RUN = {
    "mesh_file": "cell.msh",
    "material_matrix_young": 30e9, "material_matrix_poisson": 0.3, "material_matrix_density": 2000,
    "material_inclusion_young": 80e9, "material_inclusion_poisson": 0.2, "material_inclusion_density": 4000,
    "output_folder": "out",
}
ONE_REGION = {name: None for name in RUN if name.startswith("material_inclusion_")}

HOLLOW = f"""
Point(1) = {{0, 0, 0}}; Point(2) = {{{SIDE}, 0, 0}}; Point(3) = {{{SIDE}, {SIDE}, 0}}; Point(4) = {{0, {SIDE}, 0}};
Point(5) = {{{0.5 * SIDE}, {0.5 * SIDE}, 0}};
Point(6) = {{{0.8 * SIDE}, {0.5 * SIDE}, 0}}; Point(7) = {{{0.2 * SIDE}, {0.5 * SIDE}, 0}};
Point(8) = {{{0.7 * SIDE}, {0.5 * SIDE}, 0}}; Point(9) = {{{0.3 * SIDE}, {0.5 * SIDE}, 0}};
Line(1) = {{1, 2}}; Line(2) = {{2, 3}}; Line(3) = {{3, 4}}; Line(4) = {{4, 1}};
Circle(5) = {{6, 5, 7}}; Circle(6) = {{7, 5, 6}}; Circle(7) = {{8, 5, 9}}; Circle(8) = {{9, 5, 8}};
Curve Loop(1) = {{1:4}}; Curve Loop(2) = {{5, 6}}; Curve Loop(3) = {{7, 8}};
Plane Surface(1) = {{1, 2}}; Plane Surface(2) = {{3}};
Mesh.MeshSizeMin = {0.12 * SIDE}; Mesh.MeshSizeMax = {0.12 * SIDE};
Physical Surface("matrix") = {{1}};
"""
PAIRS = f"""
Periodic Curve{{2}} = {{-4}} Translate{{{SIDE}, 0, 0}}; Periodic Curve{{3}} = {{-1}} Translate{{0, {SIDE}, 0}};
"""
LOOSE_DISC = 'Physical Surface("inclusion") = {2};\n'


def hollow(path, periodic=False, disc=False):
    """Writes a square with a round hole; `disc`: with a smaller disc in it, which touches nothing."""
    geometry = path.with_suffix(".geo")
    geometry.write_text(HOLLOW + (PAIRS if periodic else "") + (LOOSE_DISC if disc else ""))
    subprocess.run(["gmsh", "-v", "1", "-2", "-format", "msh41", geometry, "-o", path], check=True,
                   stdin=subprocess.DEVNULL)
    geometry.unlink()


def voigt(six):
    """[c11, c22, c12, c66, c16, c26] as a matrix."""
    c11, c22, c12, c66, c16, c26 = six
    return np.array([[c11, c12, c16], [c12, c22, c26], [c16, c26, c66]])


class Homogenising(Drawing):
    """A test with a folder of its own, where it runs `homogenize`."""

    def draw_cell(self, path, **recipe):
        """A mesh of `morphology`: DISCS with changes."""
        self.draw({**DISCS, **recipe})
        shutil.move(self.folder / "drawn" / "mesh.msh", path)

    def homogenize(self, *arguments, ranks=1, folder=None):
        return self.launch(HOMOGENIZE, *arguments, ranks=ranks, folder=folder)

    def run_cell(self, run=None, ranks=1, **changes):
        """RUN, or another, with changes: must succeed without a word on stderr. Returns what was said."""
        outcome = self.homogenize(*arguments_of({**(run or RUN), **changes}), ranks=ranks)
        self.assertEqual((outcome.codes, outcome.err), ([0] * ranks, ""), outcome.out)
        return outcome.out

    def effective(self, folder="out"):
        return yaml.safe_load((self.folder / folder / "effective.yaml").read_text())
