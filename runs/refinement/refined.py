"""The numbers of one run of a refinement study, for its table: averages with their scatter, distances to a reference.

    average_rows(...)     values, each with the scatter of the parts of the window
    distance_rows(...)    trajectories, spectra and portraits against the reference run
"""

import numpy as np

from refinement.orders import standard_error
from slipscale.measuring.distance import portrait_distance, relative_l2, spectrum_distance
from slipscale.measuring.regime import MEASURES, friction_spectrum, measures
from slipscale.measuring.window import rows_in
from slipscale.reading import History, Summary, UnreadableRun

SIGNALS = {  # of the probe point, and forces of the measured boundary: (unit, what it is)
    "displacement": ("m", "tangential displacement"),
    "velocity": ("m/s", "tangential velocity"),
    "normal_displacement": ("m", "displacement along y"),
    "normal_velocity": ("m/s", "velocity along y"),
    "normal_force": ("N/m", "normal force"),
    "tangential_force": ("N/m", "tangential force"),
}


def signal(history, boundary, name, point=0):
    """One of SIGNALS over all rows [n]. Raises UnreadableRun when it was not recorded."""
    if name not in SIGNALS:
        raise UnreadableRun(f"There is no signal {name}: known are {', '.join(SIGNALS)}.")
    if name in ("normal_force", "tangential_force"):
        return history.boundary[boundary][name]
    if not 0 <= point < len(history.points):
        raise UnreadableRun(f"The run recorded no probe point {point}: name one with history_points.")
    values = history.points[point].u if name.endswith("displacement") else history.points[point].v
    return values[:, 1 if name.startswith("normal") else 0]


def average_rows(folder, window, names, point=0, parts=4):
    """A row for each of `names`, of regime.MEASURES that are numbers with a meaning of their own: its value over the
    window; `parts`, its values in as many parts of the window, as text; and `scatter`, the standard error of their
    mean, zero for one part."""
    known = [name for name, (unit, _) in MEASURES.items() if unit and not name.endswith("_error")]
    if unknown := [name for name in names if name not in known]:
        raise UnreadableRun(f"There is no average {unknown[0]}: known are {', '.join(known)}.")
    if not names:
        return []
    whole = measures(folder, window, point)
    if missing := [name for name in names if name not in whole]:
        raise UnreadableRun(f"{folder} has no {missing[0]}: it recorded no probe point {point}.")
    times = np.linspace(*window, parts + 1)
    pieces = [measures(folder, part, point) for part in zip(times, times[1:])] if parts > 1 else [whole]
    return [{"kind": "average", "quantity": name, "unit": MEASURES[name][0], "value": whole[name],
             "scatter": standard_error([piece[name] for piece in pieces]),
             "parts": " ".join(f"{piece[name]:.9g}" for piece in pieces)} for name in names]


def samples_in(history, window):
    """Evenly spaced times in the window, as far apart as the rows."""
    rows = rows_in(history.time, window)
    if rows.stop - rows.start < 2 or history.time[-1] < window[1] - 2 * np.median(np.diff(history.time)):
        raise UnreadableRun(f"The run recorded nothing up to {window[1]:g} s: let it end later.")
    spacing = np.median(np.diff(history.time[rows]))
    return np.linspace(*window, max(2, round((window[1] - window[0]) / spacing) + 1))


def trajectory_error(folder, reference, window, name, point=0):
    """Relative L2 distance of a signal over the window, at the times of the reference's rows."""
    own, true = History(folder), History(reference)
    at = samples_in(true, window)
    samples_in(own, window)
    compared = [np.interp(at, history.time, signal(history, Summary(of).measured_boundary(history), name, point))
                for history, of in ((own, folder), (true, reference))]
    return relative_l2(*compared)


def portrait(folder, window, point):
    history = History(folder)
    rows = rows_in(history.time, window)
    return [signal(history, None, name, point)[rows] for name in ("displacement", "velocity")]


def distance_rows(folder, reference, window, trajectories=(), distances=(), point=0):
    """A row for each signal of `trajectories`, and for `spectrum` and `portrait` where `distances` names them."""
    found = [("trajectory", name, trajectory_error(folder, reference, window, name, point)) for name in trajectories]
    for name in distances:
        if name == "spectrum":
            error = spectrum_distance(friction_spectrum(folder, window), friction_spectrum(reference, window))
        elif name == "portrait":
            error = portrait_distance(portrait(folder, window, point), portrait(reference, window, point))
        else:
            raise UnreadableRun(f"There is no distance {name}: known are spectrum and portrait.")
        found.append(("distance", name, error))
    return [{"kind": kind, "quantity": name, "unit": "1", "error": error} for kind, name, error in found]


if __name__ == "__main__":
    raise SystemExit("refinement.refined is a library, no command: snakemake --snakefile runs/refinement/Snakefile "
                     "runs the study.")
