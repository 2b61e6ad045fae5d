"""Spectra of recorded signals: Welch's method with a Hann window, and the dominant frequency.

P. D. Welch, IEEE Trans. Audio Electroacoust. 15 (1967) 70; interpolation of the peak for a Hann window:
T. Grandke, IEEE Trans. Instrum. Meas. 32 (1983) 350.
"""

import numpy as np


def evenly_spaced(time, values):
    """Signal [n] at evenly spaced times, and the sampling rate in Hz.

    A recorded run is even except perhaps for its last row; such a signal is interpolated linearly.
    """
    spacing = np.median(np.diff(time))
    even = time[0] + spacing * np.arange(int((time[-1] - time[0]) / spacing * (1 + 1e-9)) + 1)
    if len(even) == len(time) and np.allclose(even, time, rtol=0, atol=1e-6 * spacing):
        return values, 1 / spacing
    return np.interp(even, time, values), 1 / spacing


def welch(values, rate, segment=None):
    """One-sided power spectral density of a signal [n] sampled at `rate` Hz.

    The mean of each of the half-overlapping segments is removed. `segment` is their length in samples, by default
    half the signal (three segments). Returns frequency [segment//2 + 1] in Hz and density in unit²/Hz, whose
    sum times the frequency step is the variance.
    """
    segment = segment or len(values) // 2
    if segment < 8 or segment > len(values):
        raise ValueError(f"a segment of {segment} samples does not suit a signal of {len(values)}")
    window = 0.5 * (1 - np.cos(2 * np.pi * np.arange(segment) / segment))
    starts = range(0, len(values) - segment + 1, segment // 2)
    pieces = np.array([values[start:start + segment] for start in starts])
    pieces = (pieces - pieces.mean(axis=1, keepdims=True)) * window
    density = np.mean(np.abs(np.fft.rfft(pieces, axis=1))**2, axis=0) / (rate * np.sum(window**2))
    density[1:-1 if segment % 2 == 0 else None] *= 2  # the negative frequencies, which 0 and Nyquist have not
    return np.fft.rfftfreq(segment, 1 / rate), density


FIRST_RESOLVED_BIN = 3  # what is slower varies less than three times in a segment and cannot be told from drift


def dominant_frequency(frequency, density):
    """`strongest_line`, but 0 where the density is higher below the first resolved bin: what dominates is then slower
    than the window can tell. The rule of summary.yaml."""
    slower, line = density[1:FIRST_RESOLVED_BIN], density[FIRST_RESOLVED_BIN:]
    return 0.0 if len(line) and np.max(slower) > np.max(line) else strongest_line(frequency, density)


def strongest_line(frequency, density):
    """Frequency in Hz of the highest peak at or above the first resolved bin.

    Interpolated between bins; exact for one sinusoid seen through a Hann window, up to its mirror image.
    """
    step = frequency[1]
    first = min(FIRST_RESOLVED_BIN, len(density) - 1)
    peak = first + int(np.argmax(density[first:]))
    if peak == len(density) - 1 or density[peak] == 0:
        return frequency[peak]
    side = 1 if density[peak + 1] >= density[peak - 1] else -1
    ratio = np.sqrt(density[peak + side] / density[peak])
    return frequency[peak] + side * step * max(0.0, (2 * ratio - 1) / (ratio + 1))


if __name__ == "__main__":
    raise SystemExit("slipscale.measuring.spectrum is a library, no command: slipscale -h lists the commands.")
