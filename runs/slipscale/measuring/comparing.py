"""Two or more runs side by side over one window: means with their errors, differences against scatter, distances."""

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from slipscale.measuring import distance, spectrum
from slipscale.measuring.averages import ROUNDING_OF_SUMS, Settling, mean_of, ratio_of_means, settling
from slipscale.measuring.regime import HIGHEST, STILL, friction_signal, regime
from slipscale.measuring.window import choose_window, cut_away, default_window, rows_in, unfinished
from slipscale.reading import History, Summary, UnreadableRun

DOUBT = 3  # standard errors of the difference, from which on two means differ
KINDS = {"normal_force": "force", "tangential_force": "force", "power_into_body": "power", "drive_power": "power"}
UNITS = {"friction": "1", "normal_force": "N/m", "tangential_force": "N/m", "stick": "1", "slip": "1", "open": "1",
         "power_into_body": "W/m", "drive_power": "W/m"}


@dataclass
class Compared:
    """A run over `window` (s). means[name] are pairs of value and standard error, names and units those of UNITS, of
    what was recorded; spectrum, frequency [n] Hz and √density [n] 1/√Hz of friction; portrait, u [n] m and v [n] m/s of
    the probe point, or None; options as run.yaml has them; notes: sentences on the window and on the run's end."""

    name: str
    folder: Path
    window: tuple
    means: dict
    frequency: float
    amplitude: float
    settling: Settling
    regime: str
    spectrum: tuple
    own_spectra: list  # of the halves of the window
    portrait: tuple
    own_portraits: list
    reached: float
    options: dict = field(default_factory=dict)
    notes: tuple = ()


def spectrum_of(time, signal):
    """Frequency and √density, up to HIGHEST."""
    frequency, density = spectrum.welch(*spectrum.evenly_spaced(time, signal))
    kept = frequency <= HIGHEST
    return frequency[kept], np.sqrt(density[kept])


def common_window(folders):
    """The second half of the shortest run: s."""
    return default_window(min((History(folder).time for folder in folders), key=lambda time: time[-1]))


def halves(rows):
    middle = (rows.start + rows.stop) // 2
    return slice(rows.start, middle), slice(middle, rows.stop)


def read_compared(folder, window, point=0, name=None):
    """The Compared of a folder of `slide`. Raises UnreadableRun."""
    history, summary = History(folder), Summary(folder)
    notes = (cut_away(history.time, window) if window else "", unfinished(summary, history.time[-1]))
    window = choose_window(history.time, window)
    rows = rows_in(history.time, window)
    boundary = summary.measured_boundary(history)
    forces = history.boundary[boundary]
    means = {"normal_force": mean_of(forces["normal_force"][rows]),
             "tangential_force": mean_of(forces["tangential_force"][rows])}
    if means["normal_force"][0] > 0:
        means["friction"] = ratio_of_means(forces["tangential_force"][rows], forces["normal_force"][rows])
    means.update({state: mean_of(history.contact[state][rows]) for state in ("stick", "slip", "open")
                  if state in history.contact})
    means.update({power: mean_of(history.surface[power][rows]) for power in ("power_into_body", "drive_power")
                  if power in history.surface})
    signal = friction_signal(history, boundary, rows)
    whole = spectrum_of(history.time[rows], signal)
    u, v = (history.points[point].u, history.points[point].v) if 0 <= point < len(history.points) else (None, None)
    drive = means.get("drive_power", (0, 0))[0]
    return Compared(
        name or Path(folder).name, Path(folder), window, {name: means[name] for name in UNITS if name in means},
        spectrum.dominant_frequency(whole[0], whole[1]**2) if np.ptp(signal) > STILL else 0.0, float(np.std(signal)),
        settling(signal),
        regime(means["stick"][0], means["open"][0], np.std(signal), means.get("friction", (0, 0))[0],
               means["power_into_body"][0] / drive if drive else 0.0) if "stick" in means else "no contact",
        whole, [spectrum_of(history.time[half], friction_signal(history, boundary, half)) for half in halves(rows)],
        None if u is None else (u[rows, 0], v[rows, 0]),
        [] if u is None else [(u[half, 0], v[half, 0]) for half in halves(rows)], float(history.time[-1]),
        {option: value for option, value in summary.options.items() if option not in ("run", "output_folder")},
        tuple(filter(None, notes)))


@dataclass
class Difference:
    """Of a mean of a run from that of the first: `value`, its standard error `error`, no less than rounding makes it,
    whether it is beyond DOUBT of them; None where there is no error to hold it against. `scatters`: whether the
    error is more than rounding."""

    value: float
    error: float
    differs: bool
    scatters: bool = True


def difference(own, first, size=0.0):
    """Of two pairs of value and standard error; `size` is that of what both are sums or parts of, if it is larger than
    they are: to its rounding they are known."""
    value, error = own[0] - first[0], float(np.hypot(own[1], first[1]))
    if not np.isfinite(error):
        return Difference(value, error, None)
    rounding = ROUNDING_OF_SUMS * max(abs(own[0]), abs(first[0]), size)
    return Difference(value, max(error, rounding), bool(abs(value) > DOUBT * max(error, rounding)), error > rounding)


def differences(run, first):
    """The Difference of each mean that both have, by name."""
    sizes = {kind: max((abs(mean.means[name][0]) for mean in (run, first) for name, of in KINDS.items()
                        if of == kind and name in mean.means), default=0.0) for kind in set(KINDS.values())}
    return {name: difference(run.means[name], first.means[name], sizes[KINDS[name]] if name in KINDS else 1.0)
            for name in UNITS if name in run.means and name in first.means}


def distances(run, first):
    """spectrum and portrait: pairs, of the run from the first, and of the halves of the first's window from each other,
    which is what scatter alone makes; what was not recorded is left out."""
    found = {"spectrum": (distance.spectrum_distance(run.spectrum, first.spectrum),
                          distance.spectrum_distance(*first.own_spectra))}
    if run.portrait and first.portrait:
        found["portrait"] = (distance.portrait_distance(run.portrait, first.portrait),
                             distance.portrait_distance(*first.own_portraits))
    return found


def changed_options(runs):
    """Options in which the runs are not equal: a dict of lists, a value or None for each run."""
    names = dict.fromkeys(name for run in runs for name in run.options)
    found = {name: [run.options.get(name) for run in runs] for name in names}
    return {name: values for name, values in found.items() if any(value != values[0] for value in values)}


def read_all(folders, window=None, point=0):
    """The Compared of two or more folders, over one window, with names that tell them apart. Raises UnreadableRun."""
    if len(folders) < 2:
        raise UnreadableRun("There is nothing to compare: give two folders of `slide` or more.")
    names = [Path(folder).name or str(folder) for folder in folders]
    names = names if len(set(names)) == len(names) else [str(folder) for folder in folders]
    window = window or common_window(folders)
    return [read_compared(folder, window, point, name) for folder, name in zip(folders, names)]
