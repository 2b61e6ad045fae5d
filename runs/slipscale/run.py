"""One run of `slide` as Python sees it: `run = slipscale.Run("out/first")`. SI units throughout."""

import sys
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path

import numpy as np

from slipscale.measuring import spectrum as welch
from slipscale.measuring.averages import settling
from slipscale.measuring.regime import STILL, friction_signal, measures
from slipscale.measuring.window import choose_window, default_window, rows_in
from slipscale.mistakes import Mistake
from slipscale.reading import ContactHistory, Fields, History, Summary, UnreadableRun


@dataclass(frozen=True)
class Spectrum:
    """One-sided power spectral density of the tangential over the mean normal force, by Welch's method.

    frequency [n] Hz; density [n] 1/Hz, whose sum times the frequency step is the variance; dominant Hz, the
    strongest line, interpolated between bins; 0 where friction is constant to rounding.
    """

    frequency: np.ndarray
    density: np.ndarray
    dominant: float


@dataclass(frozen=True)
class Contact:
    """The contact nodes, sorted along x, at the times of contact.h5.

    time [m] s; x [nc] m; u [m, nc, 2] m; slip_rate [m, nc] m/s; normal_traction [m, nc] Pa, >= 0 in compression;
    tangential_traction [m, nc] Pa; status [m, nc]: slipscale.OPEN, STICK or SLIP. y [nc] m, gap [m, nc] m, v_y [m, nc]
    m/s and strength [m, nc] Pa, what the friction law remembers; tributary_length [nc] m; region_share {name: [nc]},
    part of that length by region; None in files of earlier versions. sums {name: [m, nc]}: over every step since t = 0,
    empty where the run kept none: friction_work and impact_loss J/m², slip_distance m, pressure_slip Pa m, time_closed
    s, impulse Pa s, closures.
    """

    time: np.ndarray
    x: np.ndarray
    u: np.ndarray
    slip_rate: np.ndarray
    normal_traction: np.ndarray
    tangential_traction: np.ndarray
    status: np.ndarray
    y: np.ndarray | None = None
    gap: np.ndarray | None = None
    v_y: np.ndarray | None = None
    strength: np.ndarray | None = None
    tributary_length: np.ndarray | None = None
    region_share: dict | None = None
    sums: dict = field(default_factory=dict)


@dataclass(frozen=True)
class Frame:
    """Fields on the mesh at one time; what was not saved is None. damping_work [nc] J/m³ is what bulk damping took.

    time s; coordinates [np, 2] m; triangles [nt, 3] point numbers, a quadrilateral gives two; cell_of_triangle [nt];
    region [nc] index into region_names; u [np, 2] m; v [np, 2] m/s; stress [nc, 3] Pa and strain [nc, 3]
    (xx, yy, xy; engineering shear); stress_zz, von_mises, principal_high and principal_low [nc] Pa.
    `axes.tripcolor(*frame.coordinates.T, frame.triangles, facecolors=frame.stress[frame.cell_of_triangle, 1])` draws
    σ_yy.
    """

    time: float
    coordinates: np.ndarray
    triangles: np.ndarray
    cell_of_triangle: np.ndarray
    region: np.ndarray
    region_names: list
    u: np.ndarray | None
    v: np.ndarray | None
    stress: np.ndarray | None
    strain: np.ndarray | None
    stress_zz: np.ndarray | None = None
    von_mises: np.ndarray | None = None
    principal_high: np.ndarray | None = None
    principal_low: np.ndarray | None = None
    damping_work: np.ndarray | None = None


class Run:
    """What a run of `slide` left in its folder, read when it is first asked for; a run that is still going, too.

    folder            the path
    time [n] s, friction [n]: tangential over normal force at the measured boundary; one entry a recorded row
    boundary[name]    {"normal_force": [n], "tangential_force": [n]} N/m
    surface[name]     normal_force, tangential_force N/m; drive_power, power_into_body, friction_heat W/m; [n]
    energy[term]      [n] J/m
    states[state]     part of the contact that is "stick", "slip", "open"; [n]
    points[k]         .x [2] m, .u [n, 2] m, .v [n, 2] m/s, .stress [n, 3] Pa (xx, yy, xy)
    contact           a Contact: every contact node at the times of contact.h5
    summary, options  what summary.yaml says, and every option in effect (run.yaml), as dicts
    facts             what run.yaml tells about the run: nodes, stable step, wave speeds, mesh checksum, ranks

    Raises UnreadableRun, one sentence, when something is missing.
    """

    def __init__(self, folder):
        self.folder = Path(folder)
        if not self.folder.is_dir():
            raise UnreadableRun(f"There is no folder {folder}: give the output folder of a `slide` run.")

    def __repr__(self):
        return f"slipscale.Run({str(self.folder)!r})"

    @cached_property
    def _history(self):
        return History(self.folder)

    @cached_property
    def _summary(self):
        return Summary(self.folder)

    @property
    def time(self):
        return self._history.time

    @property
    def friction(self):
        return self._history.friction

    @property
    def boundary(self):
        return self._history.boundary

    @property
    def surface(self):
        return self._history.surface

    @property
    def energy(self):
        return self._history.energy

    @property
    def states(self):
        return self._history.contact

    @property
    def points(self):
        return self._history.points

    @cached_property
    def contact(self):
        with ContactHistory(self.folder) as file:
            names = ("u", "slip_rate", "normal_traction", "tangential_traction", "status")
            later = [name for name in ("gap", "v_y", "strength") if file.holds(name)]
            shares = None if file.region_share is None else dict(zip(file.region_names, file.region_share.T, strict=True))
            return Contact(file.time, file.x, **{name: file.read(name) for name in (*names, *later)}, y=file.y,
                           tributary_length=file.tributary_length, region_share=shares,
                           sums={name.removeprefix("sums/"): file.read(name) for name in file.sums})

    @property
    def summary(self):
        return self._summary.headline

    @property
    def options(self):
        return {name: value for name, value in self._summary.options.items() if name != "run"}

    @property
    def facts(self):
        return self._summary.options.get("run", {})

    @property
    def frame_times(self):
        """Times of the frames in fields.h5, [m] s."""
        with Fields(self.folder) as fields:
            return fields.time

    def fields(self, time=None):
        """The Frame at a time (s), by default the last. Raises UnreadableRun when none is near."""
        with Fields(self.folder) as file:
            k = file.nearest(time)
            read = {name: file.read(name, k) if file.holds(name, k) else None
                    for name in ("u", "v", "stress", "strain", "stress_zz", "von_mises", "principal_high",
                                 "principal_low", "damping_work")}
            for name in ("u", "v"):
                read[name] = None if read[name] is None else read[name][:, :2]
            return Frame(float(file.time[k]), file.coordinates, file.triangles, file.cell_of_triangle, file.region,
                         file.region_names, **read)

    def window(self, from_=None, to=None):
        """Two times in s: those given, or the second half of what was recorded. Raises UnreadableRun when fewer than
        32 rows lie between them, too few for a spectrum."""
        begin, end = default_window(self.time)
        return choose_window(self.time, (begin if from_ is None else from_, end if to is None else to))

    def spectrum(self, from_=None, to=None):
        """The Spectrum of friction over the window (s), three half-overlapping segments."""
        rows = rows_in(self.time, self.window(from_, to))
        signal = friction_signal(self._history, self._summary.measured_boundary(self._history), rows)
        values, rate = welch.evenly_spaced(self.time[rows], signal)
        frequency, density = welch.welch(values, rate)
        dominant = float(welch.dominant_frequency(frequency, density)) if np.ptp(signal) > STILL else 0.0
        return Spectrum(frequency, density, dominant)

    def settling(self, from_=None, to=None):
        """Whether friction goes on in the second half of the window (s) as in the first: an averages.Settling."""
        rows = rows_in(self.time, self.window(from_, to))
        return settling(friction_signal(self._history, self._summary.measured_boundary(self._history), rows))

    def measures(self, from_=None, to=None):
        """What the run did over the window (s), as a dict: friction, frequency, amplitude, stick, slip, open, regime,
        settled, amplitude_ratio … `slipscale.MEASURES` has each with unit and meaning."""
        return measures(self.folder, self.window(from_, to))

    def table(self):
        """Every column of history.h5 that has one number a row, as a pandas.DataFrame indexed by time (s). Raises
        Mistake where there is no pandas."""
        try:
            import pandas
        except ModuleNotFoundError as missing:
            raise Mistake(f"run.table() needs pandas, which {sys.executable} has not: install python3-pandas, or take "
                          "run.time, run.friction, run.surface, run.energy … as they are.") from missing

        columns = {"friction": self.friction}
        for group, found in (("surface", self.surface), ("energy", self.energy), ("contact", self.states)):
            columns.update({f"{group}/{name}": values for name, values in found.items()})
        for boundary, forces in self.boundary.items():
            columns.update({f"boundary/{boundary}/{name}": values for name, values in forces.items()})
        return pandas.DataFrame(columns, index=pandas.Index(self.time, name="time"))
