"""Runs side by side, as `slipscale compare` shows them: friction, spectra, portraits, fractions, means with errors."""

import numpy as np

from slipscale.measuring.regime import friction_signal
from slipscale.measuring.window import MICRO, in_words, rows_in
from slipscale.pictures import panels
from slipscale.pictures.colours import BLUE, GREEN, ORANGE, PURPLE, SKY, VERMILION
from slipscale.pictures.drawing import plt
from slipscale.reading import History, Summary

COLOURS = (BLUE, ORANGE, GREEN, PURPLE, SKY, VERMILION)
FRACTIONS = {"stick": BLUE, "slip": ORANGE, "open": "#F0E9DC"}
SMOOTH = 200  # points of the friction that is averaged over time


def colour(k):
    return COLOURS[k % len(COLOURS)]


def friction_over_time(axes, runs):
    """Means of short pieces of the run, which show whether it drifts where the vibration itself would hide it."""
    for k, run in enumerate(runs):
        history = History(run.folder)
        boundary = Summary(run.folder).measured_boundary(history)
        rows = rows_in(history.time, run.window)
        signal = friction_signal(history, boundary, slice(0, len(history.time)))
        scale = np.mean(history.boundary[boundary]["normal_force"]) or 1.0
        signal = signal * scale / (np.mean(history.boundary[boundary]["normal_force"][rows]) or 1.0)
        length = max(1, len(signal) // SMOOTH)
        pieces = len(signal) // length
        mean = signal[:pieces * length].reshape(pieces, length).mean(axis=1)
        time = history.time[:pieces * length].reshape(pieces, length).mean(axis=1)
        axes.plot(time * MICRO, mean, color=colour(k), linewidth=1.2, label=run.name)
    axes.axvspan(*(time * MICRO for time in runs[0].window), color="0.93", zorder=0)
    axes.grid(alpha=0.25)
    axes.set(title="(a) Friction, means of short pieces", xlabel="time [µs]", ylabel="T / mean N [1]")


def spectra(axes, runs):
    for k, run in enumerate(runs):
        frequency, density = run.spectrum
        axes.semilogy(frequency[1:] / 1e3, density[1:], color=colour(k), linewidth=1.1, label=run.name)
    highest = max((density[1:].max() for _, density in (run.spectrum for run in runs)), default=0)
    if highest > 0:
        axes.set_ylim(1e-6 * highest, 3 * highest)
    axes.grid(alpha=0.25)
    axes.set(title=f"(b) Spectra of friction, {in_words(runs[0].window)}", xlabel="frequency [kHz]",
             ylabel="√density [1/√Hz]")


def portraits(axes, runs):
    drawn = [(k, run) for k, run in enumerate(runs) if run.portrait]
    if not drawn:
        panels.say(axes, "(c) Phase portraits", "No run recorded this probe point (option history_points).")
        return
    for k, run in drawn:
        axes.plot(run.portrait[0] * MICRO, run.portrait[1], color=colour(k), linewidth=0.6, alpha=0.8, rasterized=True)
    axes.grid(alpha=0.25)
    axes.set(title=f"(c) Phase portraits, {in_words(runs[0].window)}", xlabel=r"tangential displacement $u_x$ [µm]",
             ylabel=r"tangential velocity $v_x$ [m/s]")


def fractions(axes, runs):
    """Shares of the contact, with the standard errors of their means."""
    left = np.zeros(len(runs))
    for state, shade in FRACTIONS.items():
        share = np.array([run.means.get(state, (0, 0))[0] for run in runs])
        axes.barh(range(len(runs)), share, left=left, color=shade, edgecolor="0.4", label=state)
        left += share
    axes.set_yticks(range(len(runs)), [run.name for run in runs])
    axes.invert_yaxis()
    axes.set_xlim(0, 1)
    axes.set_title("(d) State of the contact", pad=26)
    axes.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncol=3, frameon=False, fontsize="small")
    axes.set_xlabel("part of the contact's length, mean over time")


def means(axes, runs, name, letter, label):
    known = [(k, run) for k, run in enumerate(runs) if name in run.means]
    for k, run in known:
        value, error = run.means[name]
        axes.errorbar(k, value, yerr=3 * error if np.isfinite(error) else None, fmt="o", color=colour(k), capsize=5)
        if not run.settling.settled:
            axes.annotate("not settled", (k, value), (8, 0), textcoords="offset points", va="center", fontsize="small")
    axes.set_xticks(range(len(runs)), [run.name for run in runs], rotation=20 if len(runs) > 3 else 0)
    axes.set_xlim(-0.5, len(runs) - 0.2)
    axes.grid(alpha=0.25)
    axes.set(title=f"({letter}) {label} ± 3 standard errors")


def draw(runs):
    """The figure of a list of `comparing.Compared`."""
    figure, axes = plt.subplots(2, 3, figsize=(16, 9), layout="constrained")
    figure.get_layout_engine().set(w_pad=0.12, h_pad=0.1)
    friction_over_time(axes[0, 0], runs)
    spectra(axes[0, 1], runs)
    portraits(axes[0, 2], runs)
    fractions(axes[1, 0], runs)
    means(axes[1, 1], runs, "friction", "e", "Mean T / mean N")
    means(axes[1, 2], runs, "power_into_body", "f", "Power into body [W/m]")
    handles, labels = axes[0, 0].get_legend_handles_labels()
    figure.legend(handles, labels, loc="upper center", ncol=min(6, len(runs)), frameon=False)
    figure.suptitle(" ", fontsize="x-large")  # room for the legend
    return figure
