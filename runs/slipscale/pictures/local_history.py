"""The stress at a point over time: of the heterogeneous run, of the homogeneous one, and relocalised."""

import numpy as np

from slipscale.measuring.window import MICRO
from slipscale.pictures.colours import BLUE, VERMILION
from slipscale.reading import History, UnreadableRun
from slipscale.reading.mesh import cells_at

MEGA = 1e-6


def cells_in(file, points):
    try:
        return cells_at(file.coordinates, file.triangles, file.cell_of_triangle, points)
    except RuntimeError as error:
        raise UnreadableRun(f"The mesh of {file.path} has cells that overlap: write it again.") from error


def relative_error(values, reference, area):
    """Relative L2 error where both have values; nan when they share no cell or the reference is zero."""
    known = np.isfinite(values)
    size = np.sum(area[known] * reference[known]**2)
    return np.sqrt(np.sum(area[known] * (values[known] - reference[known])**2) / size) if size > 0 else np.nan


def in_digits(error):
    return f"{error:.0e}" if 0 < error < 1e-3 else f"{error:.3f}"


def heterogeneous_history(folder, fields, x):
    """Times [n] s and stress [n, 3] Pa at a point: of a probe of history.h5 there, else of the cell in all frames."""
    same = 1e-6 * np.ptp(fields.coordinates, axis=0).max()
    try:
        history = History(folder)
        for point in history.points:
            if point.stress is not None and np.abs(point.x - x).max() <= same:
                return history.time, point.stress
    except UnreadableRun:
        pass
    cell = cells_in(fields, [x])[0]
    if cell < 0:
        raise UnreadableRun(f"The point ({x[0]:g}, {x[1]:g}) m lies outside the mesh of {fields.path}.")
    return fields.time, fields.cell_history("stress", cell)


def half_a_row(*times):
    """Half of the shortest spacing of rows, s: what lies no further outside is not beyond the end of a record."""
    return 0.5 * min((np.median(np.diff(time)) for time in times if len(time) > 1), default=0.0)


def history_panel(axes, before, point, reference, component, name, shown, word="difference"):
    """One component of the local stress over time, called `name`; `before` is put before the title.

    `reference` are the times and the stress of the heterogeneous run, `shown` is a time to mark, s, or None; `word` is
    for how far the others are from it.
    """
    time, expected = reference[0], reference[1][:, component] * MEGA
    near = half_a_row(time, point.time)
    inside = (time >= point.time[0] - near) & (time <= point.time[-1] + near)
    lines = (("heterogeneous", time[inside], expected[inside], "0.6", 4.5),  # seen below a curve that lies on it
             ("homogeneous", point.time, point.homogeneous_stress[:, component] * MEGA, BLUE, 1.2),
             ("relocalised", point.time, point.stress[:, component] * MEGA, VERMILION, 1.2))
    errors = []
    for label, t, values, colour, width in lines:
        if label != "heterogeneous" and inside.any():
            there = np.interp(time[inside], t, values)
            errors.append(f"{label} {in_digits(relative_error(there, expected[inside], np.ones(len(there))))}")
        axes.plot(t * MICRO, values, color=colour, linewidth=width, label=label,
                  marker="." if len(t) < 60 and width < 2 else None, rasterized=True)
    if shown is not None:
        axes.axvline(shown * MICRO, color="0.7", linewidth=1, zorder=0)
    where = ", ".join(f"{x * 1e3:.4g}" for x in point.x)
    axes.grid(alpha=0.25)
    differ = f"\nrelative L2 {word}: {', '.join(errors)}" if errors else ""
    axes.set(title=f"{before}in {point.region} at ({where}) mm{differ}", xlabel="time [µs]", ylabel=f"{name} [MPa]")


def legend_below(figure, axes):
    """One legend for all of the panels that `history_panel` drew, below them."""
    handles, labels = next((panel.get_legend_handles_labels() for panel in axes if panel.lines), ([], []))
    if handles:
        figure.supxlabel(" \n ", fontsize="medium")  # room for it
        figure.legend(handles, labels, loc="lower center", ncol=len(labels), frameon=False)
