"""The files of a run, as numpy arrays. A run that is still going, or was killed, can be read too.

Every array is cut to the rows that all datasets of its file have: the writer appends batch by batch, so a
running job may have some datasets one batch ahead of others.
"""

import os

os.environ.setdefault("HDF5_USE_FILE_LOCKING", "FALSE")  # before h5py: a running job holds its files open

from dataclasses import dataclass
from pathlib import Path

import h5py
import numpy as np
import yaml

from analysis.mesh import interfaces, triangles_of

OPEN, STICK, SLIP = 0, 1, 2  # the values of `status` in contact.h5
SAME_TIME = 1e-3  # of the run: frames as near as this are at the same time, as steps of two runs do not coincide


class UnreadableRun(Exception):
    """What is missing or wrong in an output folder, in one sentence."""


def open_hdf5(path, program="slide"):
    """An open, read-only `h5py.File`. Raises UnreadableRun when there is none or it cannot be read."""
    if not path.is_file():
        raise UnreadableRun(f"There is no {path.name} in {path.parent}: give the output folder of a `{program}` run.")
    try:
        return h5py.File(path, "r")
    except OSError as error:
        raise UnreadableRun(f"{path} cannot be read ({error}): was it copied or written completely?") from error


def read_dataset(file, name):
    """The dataset `name` of an open file. Raises UnreadableRun when it is not there."""
    if name not in file:
        raise UnreadableRun(f"{file.filename} has no dataset {name}: it was not written, or not by this version.")
    return file[name][()]


def read_yaml(path):
    """A YAML file of flat keys as a dict; empty when there is no such file (a run writes its summary at the end)."""
    if not path.is_file():
        return {}
    try:
        return yaml.safe_load(path.read_text()) or {}
    except yaml.YAMLError as error:
        raise UnreadableRun(f"{path} is not valid YAML ({' '.join(str(error).split())}).") from error


def grows(dataset):
    """Whether the writer appends rows to it; where a node lies, say, is written once."""
    return dataset.maxshape[:1] == (None,)


def read_rows(file, required):
    """All datasets of history.h5 by name, those that grow cut to the rows that all of them have."""
    columns, fixed = {}, set()

    def take(name, item):
        if isinstance(item, h5py.Dataset):
            columns[name] = item[()]
            if not grows(item):
                fixed.add(name)

    file.visititems(take)
    for name in required:
        read_dataset(file, name)
    rows = min(len(columns[name]) for name in columns.keys() - fixed)
    if rows < 2:
        raise UnreadableRun(f"{file.filename} has no rows yet: let the run go on for a while.")
    return {name: values if name in fixed else values[:rows] for name, values in columns.items()}


@dataclass
class Point:
    """A probe point: x [2] m, u [n, 2] m, v [n, 2] m/s, stress [n, 3] Pa (xx, yy, xy)."""

    x: np.ndarray
    u: np.ndarray
    v: np.ndarray
    stress: np.ndarray


@dataclass
class LocalPoint:
    """A probe point of `relocalize`: region name, x [2] m, time [n] s, stress and homogeneous_stress [n, 3] Pa."""

    region: str
    x: np.ndarray
    time: np.ndarray
    stress: np.ndarray
    homogeneous_stress: np.ndarray


class History:
    """history.h5: one row per recorded step.

    time [n] s, step [n]; friction [n], tangential over normal force on the measured boundary;
    boundary[name][force] [n] N/m and surface[quantity] [n], N/m or W/m; energy[term] [n] J/m;
    contact[state] [n], fractions of the contact nodes; points[k] a Point.
    """

    def __init__(self, folder):
        with open_hdf5(Path(folder) / "history.h5") as file:
            columns = read_rows(file, required=("time", "friction/global"))

        def group(prefix):
            return {name[len(prefix):]: values for name, values in columns.items() if name.startswith(prefix)}

        self.time = columns["time"]
        self.step = columns.get("step")
        self.friction = columns["friction/global"]
        self.surface = group("surface/")
        self.energy = group("energy/")
        self.contact = group("contact/")
        self.boundary = {}
        for name, values in group("boundary/").items():
            boundary, _, force = name.rpartition("/")
            self.boundary.setdefault(boundary, {})[force] = values
        of_points = group("points/")
        count = len({name.split("/")[0] for name in of_points})
        self.points = [Point(**{part: of_points.get(f"{k}/{part}") for part in ("x", "u", "v", "stress")})
                       for k in range(count)]

    def mean_friction(self, boundary, rows):
        """Mean tangential over mean normal force on a boundary in the chosen rows; 0 when nothing presses.

        Never the mean of the ratio: the normal force can come near 0 at an instant.
        """
        forces = self.boundary[boundary]
        normal = np.mean(forces["normal_force"][rows])
        return np.mean(forces["tangential_force"][rows]) / normal if normal > 0 else 0.0


class ContactHistory:
    """contact.h5: the contact nodes, sorted along x, at every saved time. Also a context manager: it stays open.

    time [m] s, x [nc] m. `read(name, rows)` gives the chosen rows (a slice) of `u` [m, nc, 2] m, `slip_rate` m/s,
    `normal_traction` (>= 0 in compression), `tangential_traction` Pa or `status` (OPEN, STICK, SLIP), all [m, nc].
    """

    def __init__(self, folder):
        self._file = open_hdf5(Path(folder) / "contact.h5")
        self.x = read_dataset(self._file, "x")
        growing = [name for name, dataset in self._file.items() if grows(dataset)]
        self.rows = min((len(self._file[name]) for name in growing), default=0)
        self.time = read_dataset(self._file, "time")[:self.rows]

    def read(self, name, rows=slice(None)):
        if name not in self._file:
            read_dataset(self._file, name)
        start, stop, stride = rows.indices(self.rows)
        return self._file[name][start:stop:stride]

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._file.close()


class OnMesh:
    """A file that holds a mesh and what lies on it. Also a context manager: it stays open.

    path; coordinates [np, 2] m; region [nc] and region_names; triangles [nt, 3] point numbers (a quadrilateral gives
    two) and cell_of_triangle [nt].
    """

    def __init__(self, path, program):
        self.path = path
        self._file = open_hdf5(path, program)
        self.coordinates = read_dataset(self._file, "mesh/coordinates")[:, :2]
        self.region = read_dataset(self._file, "mesh/region").ravel()
        self.region_names = [name.decode() for name in self._file["mesh/region"].attrs.get("names", [])]
        self.triangles, self.cell_of_triangle = triangles_of(read_dataset(self._file, "mesh/cells"))

    def outlines(self):
        """Segments [ns, 2, 2] m between the regions."""
        return interfaces(self.coordinates, self.triangles, self.region[self.cell_of_triangle])

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._file.close()


class Fields(OnMesh):
    """fields.h5, or relocalized.h5 which is laid out alike: fields on the mesh at the saved times, time [m] s.

    `read(name, frame)` gives `u` [np, 3] m, `v` [np, 3] m/s, `stress` [nc, 3] Pa or `strain` [nc, 3] (xx, yy, xy;
    engineering shear), if it was saved; frame -1 is the last.
    """

    def __init__(self, folder, name="fields.h5", program="slide"):
        super().__init__(Path(folder) / name, program)
        self._frames = sorted(self._file.get("frames", {}))
        self.time = read_dataset(self._file, "time")[:len(self._frames)]
        self._frames = self._frames[:len(self.time)]
        if not self._frames:
            raise UnreadableRun(f"{self._file.filename} has no frame yet.")

    def read(self, name, frame=-1):
        return read_dataset(self._file, f"frames/{self._frames[frame]}/{name}")

    def cell_history(self, name, cell):
        """The values [m, 3] of one cell in all frames."""
        return np.array([self._file[f"frames/{frame}/{name}"][cell] for frame in self._frames])

    def nearest(self, time):
        """The frame nearest to a time in s; the last for None. Raises UnreadableRun when none is near."""
        if time is None:
            return len(self.time) - 1
        frame = int(np.argmin(np.abs(self.time - time)))
        if abs(self.time[frame] - time) > SAME_TIME * self.time[-1]:
            raise UnreadableRun(f"{self._file.filename} has no frame at {time:g} s, the nearest is at "
                                f"{self.time[frame]:g} s: choose that one.")
        return frame

    def local_points(self):
        """The probe points of relocalized.h5, a list of LocalPoint."""
        group = self._file.get("points", {})
        return [LocalPoint(self._region_name(group[k]["region"][()]),
                           *(read_dataset(self._file, f"points/{k}/{name}")
                             for name in ("x", "time", "stress", "homogeneous_stress")))
                for k in sorted(group, key=int)]

    def _region_name(self, region):
        if isinstance(region, bytes):
            return region.decode()
        region = int(np.ravel(region)[0])
        return self.region_names[region] if region < len(self.region_names) else f"region {region}"


class Statistics(OnMesh):
    """statistics.h5, or relocalized_statistics.h5 which is laid out alike: statistics over `window`, a pair in s.

    `read(name)` gives the `mean`, `deviation`, `lowest`, `highest`, `quantile_low` or `quantile_high` of the stress
    [nc, 3] Pa (xx, yy, xy).
    """

    def __init__(self, folder, name="statistics.h5", program="slide"):
        super().__init__(Path(folder) / name, program)
        of = self._file["statistics"].attrs if "statistics" in self._file else {}
        self.window = (float(of.get("from", np.nan)), float(of.get("to", np.nan)))

    def read(self, name):
        return read_dataset(self._file, f"statistics/stress/{name}")


class Summary:
    """What run.yaml (the options in effect) and summary.yaml (the headline numbers) say; both dicts may be empty."""

    def __init__(self, folder):
        self.options = read_yaml(Path(folder) / "run.yaml")
        self.headline = read_yaml(Path(folder) / "summary.yaml")

    def number(self, option):
        """An option as a float, or None. YAML reads 30e9 as text, hence the conversion."""
        try:
            return float(self.options.get(option))
        except (TypeError, ValueError):
            return None

    def measured_boundary(self, history):
        """The boundary where the load is measured: option history_boundary, else `top` as `slide` takes it, else the
        first one recorded."""
        for name in (self.options.get("history_boundary"), "top"):
            if name in history.boundary:
                return name
        if not history.boundary:
            raise UnreadableRun("history.h5 records no boundary force: name one with -history_boundary.")
        return next(iter(history.boundary))
