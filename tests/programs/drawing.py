"""Runs `morphology` as a user does. The environment says where it is: SLIPSCALE_MORPHOLOGY."""

import os
import struct
import zlib

import meshio
from running import InScratch, arguments_of

MORPHOLOGY = os.environ["SLIPSCALE_MORPHOLOGY"]
FILES = {"mesh.msh", "morphology.yaml", "morphology.png"}

# 5 discs or so in a few hundred cells.
DISCS = {
    "block_width": 4e-3, "block_height": 4e-3, "size": 2e-4,
    "shape": "disc", "fraction": 0.25, "diameter": 1e-3, "seed": 1,
    "output_folder": "out",
}
GRID = {"shape": "none", "structured": "true", "cell": "quadrilateral",
        "fraction": None, "diameter": None, "seed": None}
LAYERS = {"shape": "laminate", "layer_period": 1e-3, "diameter": None, "seed": None}
IMAGE = {"shape": "image", "image_file": "grains.png", "image_levels": "0.5", "image_pixel": 1e-4, "seed": None,
         **{name: None for name in ("block_width", "block_height", "size", "fraction", "diameter")}}
CONTOUR = {**IMAGE, "cell": "grid", "image_pixel": 1e-6}
SQUARE = {"arrangement": "square", "columns": 3, "rows": 3, "diameter": None, "seed": None}


def families(**keys):
    """Two kinds of inclusion, `large` and `small`, instead of one."""
    two = {"families_large_shape": "disc", "families_large_fraction": 0.15, "families_large_diameter": 1e-3,
           "families_small_shape": "ellipse", "families_small_fraction": 0.1, "families_small_diameter": 0.6e-3,
           "families_small_aspect": 1.5}
    return {"shape": None, "fraction": None, "diameter": None, **two, **keys}


def png(rows):
    """Bytes of an 8-bit grey PNG; `rows` from the top, of numbers 0 to 255."""
    def chunk(kind, data):
        return struct.pack(">I", len(data)) + kind + data + struct.pack(">I", zlib.crc32(kind + data))
    header = struct.pack(">IIBBBBB", len(rows[0]), len(rows), 8, 0, 0, 0, 0)
    lines = b"".join(b"\0" + bytes(row) for row in rows)
    return b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", header) + chunk(b"IDAT", zlib.compress(lines)) + chunk(b"IEND", b"")


GRAINS = png([[255 if (column // 4 + row // 3) % 2 else 40 for column in range(16)] for row in range(12)])


class Drawing(InScratch):
    """A test with a folder of its own, where it runs `morphology`."""

    def morphology(self, *arguments, ranks=1, folder=None):
        return self.launch(MORPHOLOGY, *arguments, ranks=ranks, folder=folder)

    def draw(self, recipe, *arguments, ranks=1, **changes):
        """Draws a recipe that must succeed without a word on stderr; returns what was said."""
        outcome = self.morphology(*arguments_of({**recipe, **changes}), *arguments, ranks=ranks)
        self.assertEqual((outcome.codes, outcome.err), ([0] * ranks, ""), outcome.out)
        return outcome.out

    def mesh_bytes(self, folder="out"):
        return (self.folder / folder / "mesh.msh").read_bytes()

    def read_mesh(self, folder="out"):
        return meshio.read(self.folder / folder / "mesh.msh")
