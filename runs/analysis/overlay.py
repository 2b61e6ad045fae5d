"""Several runs in one panel: phase portraits, spectra and friction, each run a colour.

A run is a pair: its name for the legend and its folder. Colours follow the order of the runs.
"""

import numpy as np

from analysis.panels import BLACK, BLUE, GREEN, MICRO, ORANGE, PURPLE, SKY, VERMILION, in_words, rows_in
from analysis.reading import History, Summary, UnreadableRun
from analysis.regime import friction_signal, friction_spectrum

COLOURS = (BLUE, ORANGE, GREEN, PURPLE, SKY, VERMILION)


def colour_of(k, name):
    """Of the k-th run; the homogeneous one is black in every panel."""
    return BLACK if "homogeneous" in name else COLOURS[k % len(COLOURS)]


def portraits(axes, runs, window, point=0, last=None):
    """Tangential velocity over tangential displacement of a probe point, over `window` (s) or its `last` seconds."""
    window = window if last is None else (max(window[0], window[1] - last), window[1])
    for k, (name, folder) in enumerate(runs):
        history = History(folder)
        if point >= len(history.points):
            raise UnreadableRun(f"{folder} recorded no probe point {point}: name one with -history_points.")
        rows = rows_in(history.time, window)
        u, v = history.points[point].u[rows, 0] * MICRO, history.points[point].v[rows, 0]
        axes.plot(u, v, color=colour_of(k, name), linewidth=0.7, alpha=0.8, label=name, rasterized=True)
    axes.grid(alpha=0.25)
    axes.legend(framealpha=0.9, fontsize="small")
    axes.set(title=f"Phase portrait of M, {in_words(window)}", xlabel="tangential displacement [µm]",
             ylabel="tangential velocity [m/s]")


def spectra(axes, runs, window, highest=2e6):
    """√density of the tangential over the mean normal force."""
    for k, (name, folder) in enumerate(runs):
        frequency, amplitude = friction_spectrum(folder, window, highest)
        axes.semilogy(frequency / 1e3, np.maximum(amplitude, 1e-12), color=colour_of(k, name), linewidth=1, alpha=0.85,
                      label=name)
    top = axes.get_ylim()[1]
    axes.set_ylim(top * 1e-4, top)
    axes.set_xlim(0, highest / 1e3)
    axes.grid(alpha=0.25)
    axes.legend(framealpha=0.9, fontsize="small")
    axes.set(title=f"Spectrum of T / mean N, {in_words(window)}", xlabel="frequency [kHz]", ylabel="√density [1/√Hz]")


def frictions(axes, runs, window):
    """Tangential over mean normal force over time."""
    for k, (name, folder) in enumerate(runs):
        history = History(folder)
        rows = rows_in(history.time, window)
        signal = friction_signal(history, Summary(folder).measured_boundary(history), rows)
        axes.plot(history.time[rows] * MICRO, signal, color=colour_of(k, name), linewidth=0.8, alpha=0.85, label=name,
                  rasterized=True)
    axes.grid(alpha=0.25)
    axes.legend(framealpha=0.9, fontsize="small")
    axes.set(title=f"Global friction, {in_words(window)}", xlabel="time [µs]", ylabel="T / mean N [1]")
