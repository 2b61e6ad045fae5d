"""The stability map of a sweep of `modes`: what grows over one or two swept options."""

import numpy as np
from matplotlib.colors import TwoSlopeNorm

from slipscale.pictures.colours import BLACK, BLUE, VERMILION

AXES = {"coefficient": ("coefficient of friction", 1), "time": ("relaxation time T [µs]", 1e6),
        "load_speed": ("speed at which the load is given [m/s]", 1)}
KILO = 1e3


def growth_of(point):
    return max((mode.growth_rate for mode in point.modes), default=np.nan)


def lines(axes, points, name):
    """Growth of every mode over one option; those that grow stand out."""
    label, factor = AXES.get(name, (name, 1))
    for point in points:
        for mode in point.modes:
            axes.plot(point.options[name] * factor, mode.growth_rate / KILO, ".",
                      color=VERMILION if mode.growth_rate > 0 else BLUE, markersize=4)
    axes.axhline(0, color=BLACK, linewidth=0.8)
    axes.grid(alpha=0.25)
    axes.set(xlabel=label, ylabel="growth rate [1/ms]")


def map_of_two(axes, figure, points, names):
    """Growth of the fastest mode in colour, its frequency in kHz in words."""
    values = [sorted({point.options[name] for point in points}) for name in names]
    growth = np.full((len(values[1]), len(values[0])), np.nan)
    for point in points:
        at = [each.index(point.options[name]) for each, name in zip(values, names)]
        growth[at[1], at[0]] = growth_of(point) / KILO
        fastest = max(point.modes, key=lambda mode: mode.growth_rate, default=None)
        if fastest and len(points) <= 150:
            axes.annotate(f"{fastest.frequency / KILO:.0f}", at, ha="center", va="center", fontsize="x-small")
    largest = max(np.nanmax(np.abs(growth)), 1e-12)
    image = axes.imshow(growth, origin="lower", aspect="auto", cmap="RdBu_r", norm=TwoSlopeNorm(0, -largest, largest))
    figure.colorbar(image, ax=axes, label="growth rate of the fastest mode [1/ms]", pad=0.02)
    for axis, each, name in zip((axes.xaxis, axes.yaxis), values, names):
        label, factor = AXES.get(name, (name, 1))
        kept = np.unique(np.linspace(0, len(each) - 1, min(len(each), 9)).astype(int))
        axis.set_ticks(kept, [f"{each[k] * factor:.3g}" for k in kept])
        axis.set_label_text(label)


def map_panel(axes, figure, points, letter):
    """`points`: those of slipscale.reading.modes.Modes.sweep."""
    names = [name for name in points[0].options if len({point.options[name] for point in points}) > 1]
    names = names or list(points[0].options)[:1]
    if len(names) > 1:
        map_of_two(axes, figure, points, names[:2])
    else:
        lines(axes, points, names[0])
    axes.set_title(f"({letter}) Sweep: {sum(growth_of(point) > 0 for point in points)} of {len(points)} points have a mode "
                   "that grows")


if __name__ == "__main__":
    raise SystemExit("slipscale.pictures.modes_map is a library, no command: slipscale -h lists the commands.")
