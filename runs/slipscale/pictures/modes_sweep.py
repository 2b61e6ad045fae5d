"""Paths of eigenvalues over what a run of `modes` swept: growth, and where one becomes unstable."""

import numpy as np

from slipscale.pictures.colours import BLACK, BLUE, VERMILION

AXES = {"coefficient": ("coefficient of friction", 1), "time": ("relaxation time T [µs]", 1e6),
        "load_speed": ("speed of the surface [m/s]", 1), "speed": ("speed of the surface [m/s]", 1)}
KILO = 1e3
BELOW = 0.6  # of the largest growth: how far below zero paths are shown


def sweep_panel(axes, sweep, letter):
    """Growth of each path of a slipscale.reading.modes.Sweep; what grows stands out, circles where it begins or ends."""
    label, factor = AXES.get(sweep.name, (sweep.name, 1))
    x = sweep.values * factor
    for growth in sweep.growth_rate:
        axes.plot(x, growth / KILO, color=BLUE, linewidth=1)
        axes.plot(x, np.where(growth > 0, growth, np.nan) / KILO, color=VERMILION, linewidth=1.6)
    for value, frequency in sweep.limits:
        axes.plot(value * factor, 0, "o", color=BLACK, fillstyle="none")
        axes.annotate(f"{frequency / KILO:.0f} kHz", (value * factor, 0), (3, 4), textcoords="offset points", fontsize="x-small")
    axes.axhline(0, color=BLACK, linewidth=0.8)
    highest = np.nanmax(sweep.growth_rate, initial=0.0) / KILO
    if highest > 0:
        axes.set_ylim(-BELOW * highest, 1.08 * highest)
    axes.grid(alpha=0.25)
    axes.set(title=f"({letter}) {int((sweep.growth_rate > 0).any(axis=1).sum())} of {len(sweep.growth_rate)} paths grow "
                   "somewhere", xlabel=label, ylabel="growth rate [1/ms]")


if __name__ == "__main__":
    raise SystemExit("slipscale.pictures.modes_sweep is a library, no command: slipscale -h lists the commands.")
