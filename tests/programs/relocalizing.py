"""Runs `relocalize` as a user does. The environment says where it is: SLIPSCALE_RELOCALIZE."""

import os

import numpy as np
import yaml
from homogenising import Homogenising
from running import arguments_of, datasets, h5py
from scenes import SQUEAL

RELOCALIZE = os.environ["SLIPSCALE_RELOCALIZE"]
FRAMES = {"relocalized.h5", "relocalized.xdmf"}
STATISTICS = {"relocalized_statistics.h5", "relocalized_statistics.xdmf"}
FILES = {*FRAMES, *STATISTICS, "comparison.yaml"}

MATERIALS = {
    "material_matrix_young": 30e9, "material_matrix_poisson": 0.25, "material_matrix_density": 1800,
    "material_inclusion_young": 80e9, "material_inclusion_poisson": 0.2, "material_inclusion_density": 1800,
}
HETEROGENEOUS = {
    **{name: value for name, value in SQUEAL.items() if not name.startswith("material_")}, **MATERIALS,
    "friction_coefficient": 0.1, "friction_time": 1e-6, "history_points": None, "history_every": 250,
    "boundary_top_ramp": 20e-6,  # slowly: many times a wave's way through the block
    "time_step": 2e-8, "time_end": 20e-6, "fields_every": 250, "fields_quantities": "stress,strain",
    "statistics_from": 5e-6, "statistics_every": 50, "output_folder": "heterogeneous",
}
HOMOGENEOUS = {**HETEROGENEOUS, **{name: None for name in MATERIALS}, "material_file": "cell/effective.yaml",
               "output_folder": "homogeneous"}
CELL = {"mesh_file": "block.msh", **MATERIALS, "cell_boundary": "kubc", "output_folder": "cell"}
RUN = {"relocalize_run": "homogeneous", "relocalize_tensors": "cell", "output_folder": "out"}
COMPARED = {"relocalize_reference": "heterogeneous", "relocalize_layer": 0.7e-3, "relocalize_bulk": 0.7e-3}
POINTS = {"relocalize_points": "2.6e-3,0.3e-3,1.3e-3,3.3e-3"}
COMPONENTS = ("xx", "yy", "xy")


class Relocalising(Homogenising):
    """A test with a folder of its own, where it runs `relocalize`."""

    def relocalize(self, *arguments, ranks=1, folder=None):
        return self.launch(RELOCALIZE, *arguments, ranks=ranks, folder=folder)

    def run_relocalize(self, run=None, ranks=1, **changes):
        """RUN, or another, with changes: must succeed without a word on stderr. Returns what was said."""
        outcome = self.relocalize(*arguments_of({**(run or RUN), **changes}), ranks=ranks)
        self.assertEqual((outcome.codes, outcome.err), ([0] * ranks, ""), outcome.out)
        return outcome.out

    def make_runs(self, **changes):
        """From block.msh: its tensors and both runs of slide."""
        self.run_cell(CELL)
        self.run_scene(HETEROGENEOUS, **changes)
        self.run_scene(HOMOGENEOUS, **changes)

    def local(self, folder="out", file="relocalized.h5"):
        return datasets(self.folder / folder / file)

    def comparison(self, folder="out"):
        return yaml.safe_load((self.folder / folder / "comparison.yaml").read_text())

    def assert_close(self, found, expected, tolerance, name=""):
        """To a part of the largest value; nan where nan is expected."""
        found, expected = np.asarray(found), np.asarray(expected)
        scale = np.nanmax(np.abs(expected), initial=0)
        np.testing.assert_allclose(found, np.broadcast_to(expected, found.shape), rtol=0, atol=tolerance * scale,
                                   err_msg=name)


def apply(tensors, rows):
    """[cells, 3, 3] and [cells, 3]"""
    return np.einsum("cij,cj->ci", tensors, rows)


def corners_of(file):
    """Of the cells of one kind, [cells, corners, 2] m."""
    return file["mesh/coordinates"][file["mesh/cells"]]


def centres_of(file):
    """[cells, 2] m; cells of both kinds stand in XDMF's mixed stream."""
    stream = file["mesh/cells"]
    if stream.ndim == 2:
        return corners_of(file).mean(axis=1)
    centres, k = [], 0
    while k < len(stream):
        count = {4: 3, 5: 4}[stream[k]]
        centres.append(file["mesh/coordinates"][stream[k + 1:k + 1 + count]].mean(axis=0))
        k += 1 + count
    return np.array(centres)


def areas_of(file):
    """Shoelace formula."""
    x, y = np.moveaxis(corners_of(file), 2, 0)
    return 0.5 * (x * np.roll(y, -1, axis=1) - y * np.roll(x, -1, axis=1)).sum(axis=1)


def concentration_of(tensors):
    """C : A of each cell of a localization.h5, Pa."""
    return tensors["region/stiffness"][tensors["cell/region"]] @ tensors["cell/localisation"]


def frames_of(file, quantity):
    """[frames, cells, 3]"""
    return np.array([file[f"frames/{k:05d}/{quantity}"] for k in range(len(file["time"]))])


def macro_grid(width, height, columns, rows):
    """Points and quadrilaterals of a block whose lower left corner is the origin; cells row by row."""
    x, y = np.meshgrid(np.linspace(0, width, columns + 1), np.linspace(0, height, rows + 1))
    first = (np.arange(rows)[:, None] * (columns + 1) + np.arange(columns)).ravel()
    return np.stack([x.ravel(), y.ravel()], axis=1), first[:, None] + [0, 1, columns + 2, columns + 1]


def write_fields(folder, points, cells, times, strains):
    """fields.h5 as slide would leave it: `strains` [frames, cells, 3]."""
    folder.mkdir()
    with h5py.File(folder / "fields.h5", "w") as file:
        file["mesh/coordinates"], file["mesh/cells"] = points, cells
        file["mesh/region"] = np.zeros(len(cells), int)
        file["mesh/region"].attrs["names"] = np.array([b"block"])
        file["time"] = times
        for k, strain in enumerate(strains):
            file[f"frames/{k:05d}/strain"] = strain


def replace(path, dataset, values):
    """Another content of a dataset, with the attributes it had. What was linked to it elsewhere keeps the old one."""
    with h5py.File(path, "r+") as file:
        attributes = dict(file[dataset].attrs)
        del file[dataset]
        file[dataset] = values
        file[dataset].attrs.update(attributes)
