"""Relocalised against heterogeneous stress: four maps, and histories in matrix and inclusion.

    slipscale relocalized-picture REFERENCE RELOCALISED HOMOGENEOUS out.png
        [--component yy] [--time 4e-5 | --statistic mean]

The folders are those of the heterogeneous `slide` run, of `relocalize` and of the homogeneous `slide` run. Everything
is compared at the cells of the heterogeneous run. Exits with code 2 and one sentence when there is nothing to plot.
"""

from contextlib import ExitStack

import numpy as np

from slipscale.measuring.window import MICRO
from slipscale.parser import Parser
from slipscale.pictures import belonging
from slipscale.pictures.drawing import colours_for, draw_cells, length_unit, plt, write_picture
from slipscale.pictures.local_history import (MEGA, cells_in, heterogeneous_history, history_panel, in_digits,
                                              legend_below, relative_error)
from slipscale.pictures.panels import say
from slipscale.reading import Fields, Statistics, UnreadableRun
from slipscale.reading.mesh import centroids_and_areas

COMPONENTS = ("xx", "yy", "xy")
STATISTICS = ("mean", "deviation", "lowest", "highest", "quantile_low", "quantile_high")
PROBES = 2  # panels for histories
NAMES = ("heterogeneous", "relocalised", "homogeneous")


class Compared:
    """One component of the stress on the cells of the heterogeneous run's mesh.

    mesh, the opened file; area [nc] m2; stress[name] [nc] MPa for each of NAMES, nan where a run has no cell;
    error[name] the relative L2 errors; drawn[name], a mesh and its values [MPa], of what has a morphology of its own;
    `when` says what is shown.
    """

    def __init__(self, files, stresses, component, when):
        self.mesh, self.when, self.drawn = files[0], when, {}
        if not belonging.same_morphology(files[1], files[0]):
            self.drawn["relocalised"] = files[1], MEGA * stresses[1][:, component]
        self.centroid, self.area = centroids_and_areas(files[0].coordinates, files[0].triangles,
                                                       files[0].cell_of_triangle)
        self.stress = {name: MEGA * at_points(file, stress[:, component], self.centroid)
                       for name, file, stress in zip(NAMES, files, stresses)}
        self.error = {name: relative_error(self.stress[name], self.stress["heterogeneous"], self.area)
                      for name in NAMES[1:]}


NOTE = 0.4  # inches that a further line of the title takes


def at_points(file, values, points):
    """Values [nc] of the cells of a file at points [n, 2]; nan outside."""
    own, _ = centroids_and_areas(file.coordinates, file.triangles, file.cell_of_triangle)
    size = np.ptp(file.coordinates, axis=0).max()
    if own.shape == points.shape and np.allclose(own, points, rtol=0, atol=1e-9 * size):
        return values
    cells = cells_in(file, points)
    return np.where(cells >= 0, values[cells], np.nan)


def field_panels(figure, axes, compared, name, word):
    """Heterogeneous, relocalised and homogeneous stress in one colour scale, and the error of the relocalised, or
    difference where that is the `word` for it."""
    stress, seen = compared.stress, compared.mesh
    both = np.concatenate([stress[each][np.isfinite(stress[each])] for each in NAMES[:2]])
    colours = colours_for(both, 0.5)
    for panel, letter, each in zip(axes, "abc", NAMES):
        mesh, values = compared.drawn.get(each, (seen, stress[each]))
        image = draw_cells(panel, mesh, values, colours, linewidth=0.6)
        panel.set_title(f"({letter}) {each}" + (f": {word} {in_digits(compared.error[each])}" if letter > "a" else ""))
        figure.colorbar(image, ax=panel, label=f"{name} [MPa]", extend="both", pad=0.02)
    error = stress["relocalised"] - stress["heterogeneous"]
    reach = np.nanpercentile(np.abs(error), 99)
    image = draw_cells(axes[3], seen, error, ("RdBu_r", -reach, reach), linewidth=0.6)
    axes[3].set_title("(d) relocalised less heterogeneous")
    figure.colorbar(image, ax=axes[3], label=f"{word} of {name} [MPa]", extend="both", pad=0.02)


def chosen_points(points):
    """Numbers of the probe points to show: the first of each phase, then the others."""
    first = {point.region: k for k, point in reversed(list(enumerate(points)))}
    return sorted(range(len(points)), key=lambda k: (first[points[k].region] != k, k))[:PROBES]


def history_panels(axes, figure_fields, points, reference_folder, reference, component, name, shown, word):
    """Histories at up to two points, which the maps show as letters."""
    numbers = chosen_points(points)
    scale, _ = length_unit(reference.coordinates)
    for panel, letter, k in zip(axes, "ef", numbers):
        history_panel(panel, f"({letter}) ", points[k], heterogeneous_history(reference_folder, reference, points[k].x),
                      component, name, shown, word)
        for field in figure_fields:
            field.plot(*(points[k].x * scale), "o", color="white", markeredgecolor="black", markersize=5)
            field.annotate(letter, points[k].x * scale, (5, 5), textcoords="offset points", fontweight="bold",
                           bbox={"facecolor": "white", "alpha": 0.7, "pad": 1, "linewidth": 0})
    for panel, letter in list(zip(axes, "ef"))[len(numbers):]:
        say(panel, f"({letter}) Local stress over time", "There is no further probe point (option relocalize_points).")


def panels_for(coordinates):
    """The figure, four axes for maps and two for histories: two to a row for a wide block, else three."""
    width, height = np.ptp(coordinates, axis=0)
    if width > 1.4 * height:
        places, size = ["ab", "cd", "ef"], (16, 14 * height / width + 5.5)
    else:
        places, size = ["abc", "def"], (19, 10 * min(2.0, height / width) + 1)
    places = [list(row) for row in places]
    figure, axes = plt.subplot_mosaic(places, figsize=size, layout="constrained")
    figure.get_layout_engine().set(w_pad=0.08, h_pad=0.08)
    return figure, [axes[letter] for letter in "abcd"], [axes[letter] for letter in "ef"]


def compare(folders, opened, component, time, statistic):
    """What the maps show, its time or None for a statistic, and the `belonging.notes`. `opened` closes the files."""
    reference, relocalised, homogeneous = folders
    kind, name = (Statistics, "relocalized_statistics.h5") if statistic else (Fields, "relocalized.h5")
    sources = ((reference,), (relocalised, name, "relocalize"), (homogeneous,))
    files = [opened.enter_context(kind(*source)) for source in sources]
    said = belonging.notes(files, folders)
    if statistic:
        begin, end = (x * MICRO for x in files[0].window)
        return Compared(files, [file.read(statistic) for file in files], component,
                        f"{statistic.replace('_', ' ')} over {begin:.4g}–{end:.4g} µs"), None, said
    shown = files[1].time[files[1].nearest(time)]
    stresses = [file.read("stress", file.nearest(shown)) for file in files]
    return Compared(files, stresses, component, f"{shown * MICRO:.4g} µs"), shown, said


def draw(reference, relocalised, homogeneous, component="yy", time=None, statistic=None):
    """The figure of three folders; `time` in s, by default that of the last frame. Raises UnreadableRun."""
    index = COMPONENTS.index(component)
    name = rf"$\sigma_{{{component}}}$"
    with ExitStack() as opened:
        compared, shown, (notes, same) = compare((reference, relocalised, homogeneous), opened, index, time, statistic)
        figure, maps, histories = panels_for(compared.mesh.coordinates)
        word = "error" if same else "difference"
        field_panels(figure, maps, compared, name, word)
        try:
            points = opened.enter_context(Fields(relocalised, "relocalized.h5", "relocalize")).local_points()
            fields = opened.enter_context(Fields(reference))
            history_panels(histories, maps, points, reference, fields, index, name, shown, word)
        except UnreadableRun as error:
            for panel in histories:
                say(panel, "Local stress over time", str(error))
        legend_below(figure, histories)
        figure.set_figheight(figure.get_figheight() + NOTE * len(notes))
        before, after = compared.error["homogeneous"], compared.error["relocalised"]
        figure.suptitle("\n".join([f"Local stress {name}, {compared.when}: heterogeneous, relocalised, homogeneous",
                                   *notes, f"relative L2 {word}: homogeneous {in_digits(before)}   |   relocalised "
                                   f"{in_digits(after)}"]), fontsize="large", fontweight="bold")
    return figure


def main(arguments=None):
    parser = Parser("relocalized-picture", __doc__)
    parser.add_argument("reference", help="output folder of the heterogeneous slide run")
    parser.add_argument("relocalised", help="output folder of relocalize")
    parser.add_argument("homogeneous", help="output folder of the homogeneous slide run")
    parser.add_argument("--component", choices=COMPONENTS, default="yy", help="of the stress (default yy)")
    what = parser.add_mutually_exclusive_group()
    what.add_argument("--time", type=float, help="of the frame [s] (default: the last)")
    what.add_argument("--statistic", choices=STATISTICS, help="a statistic over time in place of a frame")
    return write_picture(parser, lambda options: draw(options.reference, options.relocalised, options.homogeneous,
                                                      options.component, options.time, options.statistic), arguments)
