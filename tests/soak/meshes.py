"""The meshes of the soak by name, so that a scene of a few lines says which is meant."""

import subprocess
from pathlib import Path

from running import arguments_of
from scenes import SIDE, block

# Recipes of scenes.block, and of `morphology`, whose names have the seed behind them.
BLOCKS = {
    "quadrilaterals": {}, "triangles": {"cells": "triangles", "divisions": 6},
    "layers": {"regions": ("matrix", "inclusion"), "cells": "mixed"},
    "ring": {"periodic": True}, "ring_of_triangles": {"periodic": True, "cells": "triangles", "divisions": 10},
    "fine": {"divisions": 20}, "one_cell_high": {"divisions": 2},
}
DRAWN = {"block_width": SIDE, "block_height": SIDE, "size": 4e-4, "shape": "disc", "diameter": 1e-3}
COMPOSITES = {
    "discs": {**DRAWN, "fraction": 0.25}, "fitted": {**DRAWN, "fraction": 0.3, "cell": "grid", "periodic": "x"},
    "ellipses": {**DRAWN, "fraction": 0.2, "shape": "ellipse", "aspect": 2},
}
PERIODIC = ("ring", "ring_of_triangles", "fitted")
MESHES = [*BLOCKS, *(f"{name}_{seed}" for name in COMPOSITES for seed in (1, 2))]


def regions_of(mesh):
    kind = mesh.rpartition("_")[0]
    if kind in COMPOSITES:
        return ("matrix", "inclusion")
    return BLOCKS[mesh].get("regions", ("block",))


def is_periodic(mesh):
    return mesh in PERIODIC or mesh.rpartition("_")[0] in PERIODIC


def make_mesh(mesh, folder, morphology):
    """folder/<mesh>.msh, unless it is there."""
    path = Path(folder) / f"{mesh}.msh"
    if path.exists():
        return
    kind, _, seed = mesh.rpartition("_")
    if kind not in COMPOSITES:
        block(path, **BLOCKS[mesh])
        return
    words = arguments_of({**COMPOSITES[kind], "seed": seed, "output_folder": folder / f"drawn_{mesh}"})
    subprocess.run([morphology, *words], check=True, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL)
    (folder / f"drawn_{mesh}" / "mesh.msh").rename(path)
