"""What pressure, friction and motion along the contact have in common at one frequency, from contact.h5.

Cross-spectra are averages along the length and over segments of time: whatever waves run along the surface, their sum
over the frequencies is the mean power τ v per length that passes into the body.
"""

from dataclasses import dataclass

import numpy as np

from slipscale.measuring import spectrum
from slipscale.measuring.window import rows_in
from slipscale.reading import ContactHistory, Summary, UnreadableRun

ROWS_OF_A_PERIOD = 6  # fewer alias what friction does within a period
LINE = 2  # bins on either side of a spectral line that belong to it, seen through a Hann window
PASSED_OVER = 3  # bins at zero frequency: drift


@dataclass
class SurfaceMotion:
    """frequency of the line through which most passes, Hz; at this line pressure_velocity and power_at_line, W/m²:
    the mean of p v as a complex number, p1 v1/2 exp(-iφ), φ the phase of the velocity before the pressure, and of
    τ v; power, W/m², the mean of τ v over all frequencies."""

    frequency: float
    pressure_velocity: complex
    power_at_line: float
    power: float

    @property
    def omega(self):
        return 2 * np.pi * self.frequency

    @property
    def phase(self):
        return float(-np.angle(self.pressure_velocity))

    def strength(self, coefficient):
        """A = μ p1 v1/2 in W/m²."""
        return coefficient * abs(self.pressure_velocity)


def tributary_shares(x, width=None):
    """Part of the contact's length that belongs to each node [nc]; `width`, the period in m, closes a periodic one."""
    gaps = np.diff(x)
    seam = width - (x[-1] - x[0]) if width else 0
    length = 0.5 * (np.concatenate([[seam], gaps]) + np.concatenate([gaps, [seam]]))
    return length / length.sum()


def cross_spectrum(a, b, rate, shares):
    """One-sided cross-spectrum of a and b [n, nc] averaged with `shares` [nc], as in `spectrum.welch`: frequency in Hz
    and the complex sum a conj(b) of each bin; its real parts add up to the mean of a b without their means."""
    segment = len(a) // 2
    window = 0.5 * (1 - np.cos(2 * np.pi * np.arange(segment) / segment))[:, None]
    total = 0
    starts = range(0, len(a) - segment + 1, segment // 2)
    for start in starts:
        first, second = (np.fft.rfft((x - x.mean(axis=0)) * window, axis=0)
                         for x in (a[start:start + segment], b[start:start + segment]))
        total = total + (first * second.conj()) @ shares
    total = total / (len(starts) * segment * np.sum(window**2))
    total[1:-1 if segment % 2 == 0 else None] *= 2
    return np.fft.rfftfreq(segment, 1 / rate), total


def motion_of(time, pressure, traction, velocity, shares):
    """SurfaceMotion of histories [n, nc] in Pa and m/s at evenly spaced times [n] in s."""
    rate = (len(time) - 1) / (time[-1] - time[0])
    frequency, driven = cross_spectrum(pressure, velocity, rate, shares)
    _, power = cross_spectrum(traction, velocity, rate, shares)
    peak = PASSED_OVER + int(np.argmax(np.abs(driven[PASSED_OVER:])))
    line = slice(max(1, peak - LINE), peak + LINE + 1)
    return SurfaceMotion(spectrum.strongest_line(frequency, np.abs(driven)), complex(driven[line].sum()),
                         float(power[line].real.sum()), float(np.mean((traction * velocity) @ shares)))


def surface_motion(folder, window):
    """SurfaceMotion of the run in `folder` over `window` (s). Raises UnreadableRun."""
    summary = Summary(folder)
    speed, step = summary.number("surface_speed"), summary.options.get("run", {}).get("step")
    width = float(summary.options.get("run", {}).get("block_width", 0))
    with ContactHistory(folder) as contact:
        rows = rows_in(contact.time, window)
        if speed is None or step is None or rows.stop - rows.start < 32:
            raise UnreadableRun(f"{folder} has too few rows of contact.h5 between {window[0]:g} and {window[1]:g} s: "
                                "run it again with a smaller contact_every.")
        pressure, traction, rate = (contact.read(name, rows)
                                    for name in ("normal_traction", "tangential_traction", "slip_rate"))
        time, x = contact.time[rows], contact.x
    periodic = bool(summary.options.get("mesh_periodic", True)) and width > (x[-1] - x[0]) * (1 + 1e-3)
    found = motion_of(time, pressure, traction, speed - rate, tributary_shares(x, width if periodic else None))
    if found.frequency * np.median(np.diff(time)) * ROWS_OF_A_PERIOD > 1:
        raise UnreadableRun(f"contact.h5 of {folder} has a row every {np.median(np.diff(time)):.2g} s, too few for its "
                            f"motion at {found.frequency:.4g} Hz: run it again with a smaller contact_every.")
    return found
