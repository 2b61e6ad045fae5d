"""What a `slide` run did in a window of time, in numbers: friction, its frequency, how the contact behaves, power.

    measures(folder, window)    a dict, the columns of a study's table; see MEASURES
    friction_spectrum(...)      what compares two runs that are chaotic point by point

Averages over a limit cycle are reproducible where trajectories are not, and friction is the mean tangential over the
mean normal force, never the mean of the ratio: the normal force can come near zero.
"""

import numpy as np

from slipscale.measuring import spectrum
from slipscale.measuring.averages import mean_of, ratio_of_means, settling
from slipscale.measuring.window import FEWEST_ROWS, backwards, rows_in, too_few
from slipscale.reading import History, Summary, UnreadableRun

HIGHEST = 2e6  # Hz, up to which spectra are compared
STILL = 1e-9  # of the normal force: friction that varies by less is constant to rounding, and has no frequency
SHARE = 0.01  # of the contact's length and time: what sticks or opens less than this does not name the regime
STEADY = 0.01  # of friction, and of the drive power: what varies or feeds vibration by less slides steadily

MEASURES = {  # name: (unit, what it is)
    "friction": ("1", "mean tangential over mean normal force at the measured boundary"),
    "friction_error": ("1", "standard error of friction, from blocks of the window"),
    "normal_force": ("N/m", "mean normal force there"),
    "normal_force_error": ("N/m", "its standard error"),
    "frequency": ("Hz", "strongest line of the spectrum of the tangential over the mean normal force; 0 if constant, "
                        "or if what varies most is slower than the window can tell"),
    "amplitude": ("1", "standard deviation of the tangential over the mean normal force"),
    "stick": ("1", "part of the contact's length, on average over time"),
    "stick_error": ("1", "its standard error"),
    "slip": ("1", "the same of what slips"),
    "slip_error": ("1", "its standard error"),
    "open": ("1", "the same of what is open"),
    "open_error": ("1", "its standard error"),
    "displacement": ("m", "mean tangential displacement of the probe point M"),
    "displacement_deviation": ("m", "its standard deviation over time"),
    "velocity": ("m/s", "root of the mean square of the tangential velocity of M"),
    "power_into_body": ("W/m", "mean of τ du_x/dt along the surface"),
    "power_into_body_error": ("W/m", "its standard error"),
    "drive_power": ("W/m", "mean of τ V along the surface"),
    "drive_power_error": ("W/m", "its standard error"),
    "power_ratio": ("1", "mean power into the body over mean drive power"),
    "power_ratio_error": ("1", "its standard error"),
    "settled": ("", "whether the second half of the window is like the first, by the rule of summary.yaml"),
    "amplitude_ratio": ("1", "amplitude in the second half of the window over that in the first"),
    "regime": ("", "open, steady, slip, stick-slip, slip-separated or stick-slip-separated"),
}


def rows_of(history, window, fewest=FEWEST_ROWS):
    """The rows in the window (two times in s). Raises UnreadableRun when they are fewer than `fewest`, by default too
    few for a spectrum."""
    if wrong := backwards(window):
        raise UnreadableRun(f"The window {wrong}.")
    rows = rows_in(history.time, window)
    if rows.stop - rows.start < fewest:
        raise UnreadableRun(too_few(history.time, window, fewest))
    return rows


def friction_signal(history, boundary, rows):
    """Tangential over mean normal force [n]; zero where nothing presses."""
    forces = history.boundary[boundary]
    normal = np.mean(forces["normal_force"][rows])
    return forces["tangential_force"][rows] / normal if normal > 0 else np.zeros(rows.stop - rows.start)


def regime(stick, open_, amplitude=np.inf, friction=1.0, power_ratio=0.0):
    """The name that Peillex, Baillet, Berthier (IJTC2007-44438) give to what the contact does over time; steady where
    nothing vibrates, though an edge of the contact may be open for good. A wave that runs around a periodic strip
    hardly moves the mean friction, but it takes power. Open where the body does not touch at all."""
    if open_ >= 1 - 1e-9:
        return "open"
    if amplitude <= STEADY * abs(friction) and abs(power_ratio) <= STEADY:
        return "steady"
    name = "stick-slip" if stick > SHARE else "slip"
    return f"{name}-separated" if open_ > SHARE else name


def measures(folder, window, point=0, fewest=FEWEST_ROWS):
    """MEASURES of the run in `folder` over `window` (s); those of the probe `point` only if it was recorded. What so
    many rows do not tell is None: errors of fewer than 10, and where `fewest` is below FEWEST_ROWS, the frequency.
    Raises UnreadableRun."""
    history, summary = History(folder), Summary(folder)
    rows = rows_of(history, window, fewest)
    boundary = summary.measured_boundary(history)
    forces = {force: history.boundary[boundary][f"{force}_force"][rows] for force in ("tangential", "normal")}
    signal = friction_signal(history, boundary, rows)
    settled = settling(signal)
    found = {
        "friction": history.mean_friction(boundary, rows),
        "friction_error": ratio_of_means(forces["tangential"], forces["normal"])[1],
        **with_its_error("normal_force", forces["normal"]),
        "frequency": frequency(history.time[rows], signal),
        "amplitude": np.std(signal),
        **{name: value for state in ("stick", "slip", "open")
           for name, value in with_its_error(state, history.contact[state][rows]).items()},
        **point_measures(history.points, point, rows),
        **power_measures(history.surface, rows),
        "amplitude_ratio": settled.amplitude_ratio,
    }
    found = {**{name: float(value) if np.isfinite(value) else None for name, value in found.items()},
             "settled": settled.settled,
             "regime": regime(*(found[part] for part in ("stick", "open", "amplitude", "friction", "power_ratio")))}
    return {name: found[name] for name in MEASURES if name in found}


def with_its_error(name, rows):
    return dict(zip((name, f"{name}_error"), mean_of(rows)))


def frequency(time, signal):
    """The strongest line of a signal, Hz: 0 if it is constant to rounding, nan from too few rows."""
    if len(signal) < FEWEST_ROWS:
        return np.nan
    values, rate = spectrum.evenly_spaced(time, signal)
    return spectrum.dominant_frequency(*spectrum.welch(values, rate)) if np.ptp(values) > STILL else 0.0


def point_measures(points, point, rows):
    if not 0 <= point < len(points):
        return {}
    u, v = points[point].u[rows, 0], points[point].v[rows, 0]
    return {"displacement": np.mean(u), "displacement_deviation": np.std(u), "velocity": np.sqrt(np.mean(v**2))}


def power_measures(surface, rows):
    into, drive = (surface[power][rows] for power in ("power_into_body", "drive_power"))
    ratio, error = ratio_of_means(into, drive) if np.mean(drive) != 0 else (0.0, np.nan)
    return {**with_its_error("power_into_body", into), **with_its_error("drive_power", drive), "power_ratio": ratio,
            "power_ratio_error": error}


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
