"""What `modes` leaves in its output folder."""

from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np

from slipscale.reading.files import UnreadableRun, read_dataset
from slipscale.reading.on_mesh import OnMesh
from slipscale.reading.yaml_file import load


@dataclass(frozen=True)
class Mode:
    """frequency Hz; growth_rate 1/s, > 0 where it grows; residual, relative; near_contact, part of its strain energy next
    to the surface; friction_work, J/m over a period for an energy of 1 J/m, by region; of the time scheme, where it was
    asked for, scheme_frequency Hz and scheme_growth_rate 1/s, else None."""

    frequency: float
    growth_rate: float
    residual: float
    near_contact: float
    friction_work: dict
    scheme_frequency: float | None = None
    scheme_growth_rate: float | None = None

    @property
    def p(self):
        return complex(self.growth_rate, 2 * np.pi * self.frequency)

    @property
    def scheme_p(self):
        if self.scheme_frequency is None:
            return None
        return complex(self.scheme_growth_rate, 2 * np.pi * self.scheme_frequency)


def mode_of(entry):
    scheme = entry.get("scheme") or {}
    return Mode(float(entry["frequency"]), float(entry["growth_rate"]), float(entry.get("residual", np.nan)),
                float(entry.get("near_contact_energy", np.nan)),
                {name: float(value) for name, value in (entry.get("friction_work") or {}).items()},
                *(float(scheme[name]) if name in scheme else None for name in ("frequency", "growth_rate")))


class Shapes(OnMesh):
    """modes.h5: a mesh, and on it the shapes of the first `count` modes; a context manager as OnMesh. `shape(k)` is
    complex, [np, 2] m: mode k, from 0 on, moves as Re(shape exp(pt))."""

    def __init__(self, folder):
        super().__init__(Path(folder) / "modes.h5", "modes")
        self.count = len(self._file["shape"]) if "shape" in self._file else 0

    def shape(self, k):
        return self._complex(f"shape/mode_{k + 1}/")[:, :2]

    def tractions(self, k):
        """x [nx] m along the contact; normal (of the pressure) and tangential traction [nx], complex, Pa."""
        return (read_dataset(self._file, "contact/x"), self._complex("contact/normal_")[k],
                self._complex("contact/tangential_")[k])

    def _complex(self, name):
        return read_dataset(self._file, f"{name}real") + 1j * read_dataset(self._file, f"{name}imaginary")


@dataclass(frozen=True)
class Sweep:
    """name of what was swept: coefficient, time, …; values [n]; growth_rate 1/s and frequency Hz [paths, n], nan where a
    path was lost; limits, pairs of the value where a mode begins or ends to grow and its frequency."""

    name: str
    values: np.ndarray
    growth_rate: np.ndarray
    frequency: np.ndarray
    limits: list


def sweep_of(name, entry):
    paths = entry.get("paths") or []
    values = np.array(entry["values"], dtype=float)
    growth, frequency = (np.array([path[part] for path in paths], dtype=float).reshape(-1, len(values))
                         for part in ("growth_rate", "frequency"))
    return Sweep(name, values, growth, frequency, [(float(limit["value"]), float(limit["frequency"]))
                                                   for limit in entry.get("becomes_unstable") or []])


class Modes:
    """modes.yaml of a folder, and on demand `shapes`, the Shapes of modes.h5: `modes`, a list of Mode, that which grows fastest first; `state`, a dict of the steady
    state; `options`, those in effect; `yaml`, all of it. Raises UnreadableRun."""

    def __init__(self, folder):
        self.folder = Path(folder)
        file = self.folder / "modes.yaml"
        if not file.is_file():
            raise UnreadableRun(f"There is no modes.yaml in {folder}: give the output folder of a `modes` run.")
        self.yaml = load(file, written=True) or {}
        try:
            self.modes = [mode_of(entry) for entry in self.yaml["modes"] or []]
            self.state = dict(self.yaml["state"])
        except (KeyError, TypeError, ValueError) as error:
            raise UnreadableRun(f"{file} lacks modes or the state ({error}): run `modes` again.") from error

    @cached_property
    def options(self):
        return dict(self.yaml.get("options") or {})

    @cached_property
    def sweeps(self):
        """A Sweep for each option that was swept."""
        return [sweep_of(name, entry) for name, entry in (self.yaml.get("sweeps") or {}).items()]

    @property
    def shapes(self):
        return Shapes(self.folder)

    @property
    def growing(self):
        """Those that grow."""
        return [mode for mode in self.modes if mode.growth_rate > 0]


if __name__ == "__main__":
    raise SystemExit("slipscale.reading.modes is a library, no command: slipscale -h lists the commands.")
