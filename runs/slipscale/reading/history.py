"""history.h5 and contact.h5 as numpy arrays.

Every array is cut to the rows that all datasets of its file have: the writer appends batch by batch, so a
running job may have some datasets one batch ahead of others.
"""

from dataclasses import dataclass
from pathlib import Path

import h5py
import numpy as np

from slipscale.reading.files import UnreadableRun, grows, open_hdf5, read_dataset

OPEN, STICK, SLIP = 0, 1, 2  # the values of `status` in contact.h5


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
    `normal_traction` (>= 0 in compression), `tangential_traction` Pa or `status` (OPEN, STICK, SLIP), all [m, nc], and
    of the sums over every step since t = 0, where the run kept them (`-contact_sums`): `sums/friction_work` and
    `sums/impact_loss` J/m², `sums/slip_distance` m, `sums/pressure_slip` Pa m, `sums/time_closed` s, `sums/impulse`
    Pa s, `sums/closures`. tributary_length [nc] m and region_share [nc, regions] with region_names; None in files of
    earlier versions.
    """

    def __init__(self, folder):
        self._file = open_hdf5(Path(folder) / "contact.h5")
        self.x = read_dataset(self._file, "x")
        self.y = self._file["y"][()] if self.holds("y") else None
        self.tributary_length = self._file["tributary_length"][()] if self.holds("tributary_length") else None
        self.region_share = self._file["region_share"][()] if self.holds("region_share") else None
        names = self._file.attrs.get("regions", "")
        self.region_names = (names.decode() if isinstance(names, bytes) else str(names)).split("\n")
        self.sums = [f"sums/{name}" for name in self._file.get("sums", ())]
        growing = [*(name for name in self._file if name != "sums" and grows(self._file[name])), *self.sums]
        self.rows = min((len(self._file[name]) for name in growing), default=0)
        self.time = read_dataset(self._file, "time")[:self.rows]

    def holds(self, name):
        return name in self._file

    def read(self, name, rows=slice(None)):
        if name not in self._file:
            read_dataset(self._file, name)
        start, stop, stride = rows.indices(self.rows)
        return self._file[name][start:stop:stride]

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self._file.close()
