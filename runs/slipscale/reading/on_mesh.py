"""fields.h5, statistics.h5 and what `relocalize` and `homogenize` write alike: values on the cells and nodes of a
mesh."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from slipscale.reading.files import UnreadableRun, open_hdf5, read_dataset
from slipscale.reading.mesh import interfaces, triangles_of

SAME_TIME = 1e-3  # of the run: frames as near as this are at the same time, as steps of two runs do not coincide


@dataclass
class LocalPoint:
    """A probe point of `relocalize`: region name, x [2] m, time [n] s, stress and homogeneous_stress [n, 3] Pa."""

    region: str
    x: np.ndarray
    time: np.ndarray
    stress: np.ndarray
    homogeneous_stress: np.ndarray


class OnMesh:
    """A file that holds a mesh and what lies on it. Also a context manager: it stays open.

    path; mesh_checksum; coordinates [np, 2] m; region [nc] and region_names; triangles [nt, 3] point numbers (a
    quadrilateral gives two) and cell_of_triangle [nt].
    """

    def __init__(self, path, program):
        self.path = path
        self._file = open_hdf5(path, program)
        self.coordinates = read_dataset(self._file, "mesh/coordinates")[:, :2]
        self.region = read_dataset(self._file, "mesh/region").ravel()
        self.mesh_checksum = self._file.attrs.get("mesh_checksum", "")  # of the mesh file, where it is known
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

    def holds(self, name, frame=-1):
        return name in self._file[f"frames/{self._frames[frame]}"]

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
