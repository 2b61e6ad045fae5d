"""Reads every folder of fields that record_fields_writer made with meshio and compares with the analytic fields."""

import sys
from pathlib import Path

import h5py
import meshio
import numpy as np


def centres(points, cells):
    return np.concatenate([points[block.data].mean(axis=1) for block in cells])


def extents(points, cells):
    return np.concatenate([np.ptp(points[block.data][:, :, 0], axis=1) for block in cells])


def check(folder):
    with meshio.xdmf.TimeSeriesReader(folder / "fields.xdmf") as reader:
        points, cells = reader.read_points_cells()
        times = []
        for frame in range(reader.num_steps):
            time, on_points, on_cells = reader.read_data(frame)
            times.append(time)
            x, y = points.T
            u = np.stack([np.sin(2 * np.pi * x) * (1 + y) + time, np.cos(2 * np.pi * x) - 2 * y, 0 * x], axis=1)
            assert np.allclose(on_points["u"], u, atol=1e-13), "u"
            assert np.allclose(on_points["v"], -u, atol=1e-13), "v"
            centre = centres(points, cells)
            stress = np.concatenate(on_cells["stress"]).reshape(-1, 3, 3)
            assert np.allclose(stress[:, [0, 1], [0, 1]], centre, atol=1e-13), "stress is not that of its cell"
            assert np.all(stress[:, 0, 1] == time) and np.all(stress[:, 1, 0] == time)
            assert np.all(stress[:, 2] == 0) and np.all(stress[:, :, 2] == 0)  # nothing is known of zz
            region = np.concatenate(on_cells["region"])
            assert set(region) == {0, 1}
    assert times == [0.0, 0.1, 1.0 / 3], times
    # Blocks are 1 x 0.5 m with 9 x 5 cells: on a torus no cell is drawn across the block.
    assert len(points) == 60 and extents(points, cells).max() < 0.2, "streaks"
    with h5py.File(folder / "fields.h5") as file:
        assert file["frames/00001/u"].attrs["units"] == b"m"
        assert set(file["mesh/region"].attrs["names"]) == {b"matrix", b"inclusion"}
        assert list(file["time"]) == times
    print(folder.name, len(points), "points", sum(len(block.data) for block in cells), "cells")


folders = sorted(path.parent for path in Path(sys.argv[1]).glob("*/fields.xdmf"))
assert len(folders) == 6, folders
for folder in folders:
    check(folder)
