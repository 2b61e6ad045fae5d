"""The modes of steady sliding at a glance: spectrum in the complex plane, shapes, tractions along the contact.

    slipscale modes-picture out/modes modes.png [--shapes 3]

The folder is one of `modes`. (a) every mode that was reported, growth over frequency, those that grow above zero; then
the shapes that grow fastest, the deformed block where the motion is largest and a quarter of a period later, colour the
length of u; last, amplitude and phase of normal and tangential traction of the fastest along the contact. Of each
sweep the paths of growth stand below. Exits with code 2 and one sentence when there is nothing to plot.
"""

import numpy as np
from matplotlib.collections import LineCollection

from slipscale.parser import Parser
from slipscale.pictures.colours import BLACK, BLUE, ORANGE, VERMILION
from slipscale.pictures.drawing import length_unit, plt, shown, write_picture
from slipscale.pictures.modes_sweep import sweep_panel
from slipscale.reading import UnreadableRun
from slipscale.reading.modes import Modes

REACH = 0.06  # of the block's longer side: how far the largest displacement of a shape is drawn
KILO = 1e3


def spectrum_panel(axes, modes):
    """Growth over frequency; numbers as in the table of the program."""
    for k, mode in enumerate(modes, 1):
        grows = mode.growth_rate > 0
        axes.plot(mode.frequency / KILO, mode.growth_rate / KILO, "o", color=VERMILION if grows else BLUE)
        axes.annotate(str(k), (mode.frequency / KILO, mode.growth_rate / KILO), (4, 4), textcoords="offset points",
                      fontsize="small")
    axes.axhline(0, color=BLACK, linewidth=0.8)
    axes.grid(alpha=0.25)
    axes.margins(0.08)
    axes.set(title=f"(a) {sum(mode.growth_rate > 0 for mode in modes)} of {len(modes)} modes grow",
             xlabel="frequency [kHz]", ylabel="growth rate [1/ms]")


def shape_panel(axes, figure, shapes, k, mode, letter):
    """Where the motion is largest, in colour, and outlines of the block a quarter of a period later."""
    scale, unit = length_unit(shapes.coordinates)
    shape = in_phase(shapes.shape(k))
    reach = REACH * np.ptp(shapes.coordinates, axis=0).max() / np.abs(shape).max()
    size = np.sqrt((np.abs(shape)**2).sum(axis=1))
    places = (shapes.coordinates + reach * shape.real) * scale
    image = axes.tripcolor(*places.T, shapes.triangles, size / size.max(), shading="gouraud", cmap="cividis", vmin=0,
                           vmax=1, rasterized=True)
    later = (shapes.coordinates + reach * (1j * shape).real) * scale
    axes.add_collection(LineCollection(later[rim(shapes.triangles)], colors="0.5", linewidths=0.7))
    edges = shapes.outlines()
    if len(edges):
        axes.add_collection(LineCollection(edges * scale, colors="white", linewidths=0.3))
    axes.axhline(shapes.coordinates[:, 1].min() * scale, color=BLACK, linewidth=0.8)
    axes.set_aspect("equal")
    axes.margins(0.03)
    figure.colorbar(image, ax=axes, label="|u| over its largest", pad=0.02)
    axes.set(title=f"({letter}) Mode {k + 1}: {mode.frequency / KILO:.1f} kHz, {mode.growth_rate / KILO:+.2f}/ms",
             xlabel=f"x [{unit}]", ylabel=f"y [{unit}]")


def in_phase(shape):
    """The same mode, turned such that Re is as large as it can be."""
    square = (shape**2).sum()
    return shape * np.exp(-0.5j * np.angle(square))


def rim(triangles):
    """Edges [n, 2] that one triangle alone has."""
    edges = np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    found, count = np.unique(edges, axis=0, return_counts=True)
    return found[count == 1]


def traction_panel(axes, shapes, k, letter):
    """Amplitude of both tractions over the largest pressure, and their phase."""
    x, normal, tangential = shapes.tractions(k)
    scale, unit = length_unit(shapes.coordinates)
    largest = np.abs(normal).max()
    if not largest > 0:
        raise UnreadableRun("the mode has no traction at the contact")
    phase = axes.twinx()
    for values, colour, name in ((normal, BLUE, "normal"), (tangential, ORANGE, "tangential")):
        axes.plot(x * scale, np.abs(values) / largest, color=colour, label=name)
        turned = np.where(np.abs(values) > 0.02 * largest, np.degrees(np.angle(values)), np.nan)
        phase.plot(x * scale, turned, ".", color=colour, markersize=5)
    phase.set(ylabel="phase [degree] (dots)", ylim=(-180, 180), yticks=range(-180, 181, 90))
    axes.legend(loc="upper center")
    axes.grid(alpha=0.25)
    axes.set(title=f"({letter}) Tractions of mode {k + 1} along the contact", xlabel=f"x [{unit}]",
             ylabel="amplitude over the largest pressure")


def headline(folder, modes):
    state = modes.state
    return (f"{shown(folder)}: steady sliding, {state['nodes_in_contact']} nodes touch, {state['nodes_open']} are open, "
            f"N = {float(state['normal_force']):.4g} N/m")


def draw(folder, most):
    """The figure. Raises UnreadableRun."""
    modes = Modes(folder)
    if not modes.modes:
        raise UnreadableRun(f"{modes.folder / 'modes.yaml'} has no mode: give a higher -modes_to.")
    with modes.shapes as shapes:
        count = min(most, shapes.count)
        panels = 1 + count + bool(count) + len(modes.sweeps)
        columns = min(3, panels)
        rows = -(-panels // columns)
        figure, axes = plt.subplots(rows, columns, figsize=(6 * columns, 5.2 * rows), squeeze=False,
                                    layout="constrained")
        places = iter(axes.flat)
        letters = iter("bcdefghijkl")
        spectrum_panel(next(places), modes.modes)
        for k in range(count):
            shape_panel(next(places), figure, shapes, k, modes.modes[k], next(letters))
        if count:
            traction_panel(next(places), shapes, 0, next(letters))
        for sweep in modes.sweeps:
            sweep_panel(next(places), sweep, next(letters))
        for left in places:
            left.set_axis_off()
    figure.suptitle(headline(folder, modes), fontsize="large", fontweight="bold")
    return figure


def main(arguments=None):
    parser = Parser("modes-picture", __doc__)
    parser.add_argument("folder", help="output folder of a modes run")
    parser.add_argument("--shapes", type=int, default=3, help="how many shapes are drawn, those that grow fastest")
    return write_picture(parser, lambda options: draw(options.folder, options.shapes), arguments)
