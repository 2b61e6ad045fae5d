"""What a `slide` run did in a window of time, in numbers: friction, its frequency, how the contact behaves, power.

    measures(folder, window)    a dict, the columns of a study's table; see MEASURES
    friction_spectrum(...)      what compares two runs that are chaotic point by point

Averages over a limit cycle are reproducible where trajectories are not, and friction is the mean tangential over the
mean normal force, never the mean of the ratio: the normal force can come near zero.
"""

import numpy as np

from slipscale.measuring import spectrum
from slipscale.measuring.averages import ratio_of_means
from slipscale.measuring.window import FEWEST_ROWS, rows_in
from slipscale.reading import History, Summary, UnreadableRun

HIGHEST = 2e6  # Hz, up to which spectra are compared
STILL = 1e-9  # of the normal force: friction that varies by less is constant to rounding, and has no frequency
SHARE = 0.01  # of the contact's length and time: what sticks or opens less than this does not name the regime
STEADY = 0.01  # of friction, and of the drive power: what varies or feeds vibration by less slides steadily

MEASURES = {  # name: (unit, what it is)
    "friction": ("1", "mean tangential over mean normal force at the measured boundary"),
    "friction_error": ("1", "standard error of friction, from blocks of the window"),
    "normal_force": ("N/m", "mean normal force there"),
    "frequency": ("Hz", "strongest line of the spectrum of the tangential over the mean normal force; 0 if constant"),
    "amplitude": ("1", "standard deviation of the tangential over the mean normal force"),
    "stick": ("1", "part of the contact's length, on average over time"),
    "slip": ("1", "the same"),
    "open": ("1", "the same"),
    "displacement": ("m", "mean tangential displacement of the probe point M"),
    "displacement_deviation": ("m", "its standard deviation over time"),
    "velocity": ("m/s", "root of the mean square of the tangential velocity of M"),
    "power_into_body": ("W/m", "mean of τ du_x/dt along the surface"),
    "drive_power": ("W/m", "mean of τ V along the surface"),
    "power_ratio": ("1", "mean power into the body over mean drive power"),
    "settled": ("1", "amplitude in the second half of the window over that in the first"),
    "regime": ("", "open, steady, slip, stick-slip, slip-separated or stick-slip-separated"),
}


def rows_of(history, window):
    """The rows in the window (two times in s). Raises UnreadableRun when they are too few for a spectrum."""
    rows = rows_in(history.time, window)
    if rows.stop - rows.start < FEWEST_ROWS:
        raise UnreadableRun(f"Only {max(0, rows.stop - rows.start)} rows lie between {window[0]:g} and {window[1]:g} s, "
                            f"and averages need {FEWEST_ROWS}: let the run end later or lower history_every.")
    return rows


def friction_signal(history, boundary, rows):
    """Tangential over mean normal force [n]; zero where nothing presses."""
    forces = history.boundary[boundary]
    normal = np.mean(forces["normal_force"][rows])
    return forces["tangential_force"][rows] / normal if normal > 0 else np.zeros(rows.stop - rows.start)


def regime(stick, open_, amplitude=np.inf, friction=1.0, power_ratio=0.0):
    """The name that Peillex, Baillet, Berthier (IJTC2007-44438) give to what the contact does over time; steady where
    nothing vibrates, though an edge of the contact may be open for good. A wave that runs around a periodic strip hardly
    moves the mean friction, but it takes power. Open where the body does not touch at all."""
    if open_ >= 1 - 1e-9:
        return "open"
    if amplitude <= STEADY * abs(friction) and abs(power_ratio) <= STEADY:
        return "steady"
    name = "stick-slip" if stick > SHARE else "slip"
    return f"{name}-separated" if open_ > SHARE else name


def measures(folder, window, point=0):
    """MEASURES of the run in `folder` over `window` (s); those of the probe `point` only if it was recorded. Raises
    UnreadableRun."""
    history, summary = History(folder), Summary(folder)
    rows = rows_of(history, window)
    boundary = summary.measured_boundary(history)
    signal = friction_signal(history, boundary, rows)
    values, rate = spectrum.evenly_spaced(history.time[rows], signal)
    half = len(signal) // 2
    first = np.std(signal[:half])
    found = {
        "friction": history.mean_friction(boundary, rows),
        "friction_error": ratio_of_means(*(history.boundary[boundary][f"{force}_force"][rows]
                                           for force in ("tangential", "normal")))[1],
        "normal_force": np.mean(history.boundary[boundary]["normal_force"][rows]),
        "frequency": spectrum.dominant_frequency(*spectrum.welch(values, rate)) if np.ptp(values) > STILL else 0.0,
        "amplitude": np.std(signal),
        **{state: np.mean(history.contact[state][rows]) for state in ("stick", "slip", "open")},
        **point_measures(history.points, point, rows),
        **power_measures(history.surface, rows),
        "settled": np.std(signal[half:]) / first if first > 0 else 1.0,
    }
    name = regime(*(found[part] for part in ("stick", "open", "amplitude", "friction", "power_ratio")))
    return {**{name: float(value) for name, value in found.items()}, "regime": name}


def point_measures(points, point, rows):
    if not 0 <= point < len(points):
        return {}
    u, v = points[point].u[rows, 0], points[point].v[rows, 0]
    return {"displacement": np.mean(u), "displacement_deviation": np.std(u), "velocity": np.sqrt(np.mean(v**2))}


def power_measures(surface, rows):
    into, drive = np.mean(surface["power_into_body"][rows]), np.mean(surface["drive_power"][rows])
    return {"power_into_body": into, "drive_power": drive, "power_ratio": into / drive if drive != 0 else 0.0}


def costs(folder):
    """What a run took, without its output: `nodes`, `steps`, `step` (s) and `node_steps`; and the largest residual of
    its energy balance, `energy_residual`, of what flowed."""
    summary = Summary(folder)
    try:
        nodes, steps = int(summary.options["run"]["nodes"]), int(summary.headline["steps"])
        return {"nodes": nodes, "steps": steps, "step": float(summary.headline["step"]), "node_steps": nodes * steps,
                "energy_residual": float(summary.headline["energy"]["largest_relative_residual"])}
    except (KeyError, TypeError, ValueError) as error:
        raise UnreadableRun(f"{folder} lacks what this version of `slide` writes into run.yaml and summary.yaml "
                            f"({error!r}): run it again.") from error


def friction_spectrum(folder, window, highest=HIGHEST):
    """Frequency [n] in Hz up to `highest` and √density [n] in 1/√Hz of the tangential over the mean normal force, by
    Welch's method with three half-overlapping segments: runs that share a window share the frequencies to rounding."""
    history = History(folder)
    rows = rows_of(history, window)
    signal = friction_signal(history, Summary(folder).measured_boundary(history), rows)
    frequency, density = spectrum.welch(*spectrum.evenly_spaced(history.time[rows], signal))
    kept = frequency <= highest
    return frequency[kept], np.sqrt(density[kept])
