"""A column of a study's table over the options that were varied: a map over two of them, a line over one.

    slipscale maps out/sweep/table.csv picture.png [--value friction frequency open regime]
        [--over friction_coefficient surface_speed] [--where seed=1 measure=error] [--unit surface_speed=m/s]

Without --over the two options with the most values span the map, and there is a panel for every combination of the
others. A run that failed is hatched. Exits with code 2 and one sentence when there is nothing to draw.
"""

import numpy as np
from matplotlib.patches import Patch

from slipscale.parser import Parser
from slipscale.pictures.colours import BLUE
from slipscale.pictures.drawing import plt, write_picture
from slipscale.pictures.scales import UNITS, Scale, Shades, in_words, options_of, values_of, varied
from slipscale.reading import UnreadableRun
from slipscale.running.attempt import number_or_text
from slipscale.running.table import read_csv

NO_COLOUR = "0.85"
FAILED = {"facecolor": "white", "edgecolor": "0.35", "hatch": "////"}
MOST_LABELLED = 100  # cells whose value is also written
MOST_PANELS = 24
SHOWN = ("friction", "frequency", "amplitude", "regime")


def sorted_by_place(rows, options):
    """Rows by the tuple of the values of `options`. ValueError where two rows stand at the same place."""
    found = {}
    for row in rows:
        place = tuple(row.get(name) for name in options)
        if None in place:
            continue
        if place in found:
            where = ", ".join(f"{name} {value}" for name, value in zip(options, place))
            others = [name for name in row if name not in options and row[name] != found[place].get(name)]
            raise ValueError(f"Several rows have {where}: they differ in {', '.join(others[:3]) or 'nothing'}.")
        found[place] = row
    return found


def map_panel(figure, axes, rows, x, y, value, shades=None, units=UNITS):
    """The column `value` of `rows` (dicts with `status`) on a map over the options `x` and `y`: a cell around each
    value, a logarithmic axis where values are geometric, failed runs hatched, names with a legend, numbers with a
    colour bar. `shades`, a `Shades`, serves several panels; `units` gives units by column. Gives the values drawn,
    [ny, nx], nan where there is none. Raises ValueError where two rows stand at the same place."""
    shades = shades or Shades(rows, value, units)
    across, up = Scale(rows, x, units), Scale(rows, y, units)
    cells = sorted_by_place(rows, (x, y))
    values = np.full((len(up.values), len(across.values)), np.nan)
    failed, empty = [], []
    for (a, b), row in cells.items():
        column, line = across.values.index(a), up.values.index(b)
        box = ((across.edges[column], up.edges[line]), np.diff(across.edges)[column], np.diff(up.edges)[line])
        if row["status"] == "ok" or value == "status":
            values[line, column] = shades.number(row.get(value))
        if row["status"] != "ok" and value != "status":
            failed.append(box)
        elif np.isnan(values[line, column]):
            empty.append(box)
    image = axes.pcolormesh(across.edges, up.edges, np.ma.masked_invalid(values), edgecolors="white", linewidth=0.5,
                            **shades.look())
    for boxes, look in ((failed, FAILED), (empty, {"facecolor": NO_COLOUR, "edgecolor": "white"})):
        for corner, width, height in boxes:
            axes.add_patch(plt.Rectangle(corner, width, height, **look))
    write_numbers(axes, image, values, across, up, shades)
    legend = [Patch(facecolor=colour, label=name) for name, colour in shades.colours.items()]
    legend += [Patch(**FAILED, label="failed")] * bool(failed)
    legend += [Patch(facecolor=NO_COLOUR, label="no value")] * bool(empty)
    if not shades.names:
        figure.colorbar(image, ax=axes, label=shades.label, pad=0.02)
    if legend:
        axes.legend(handles=legend, loc="upper center", bbox_to_anchor=(0.5, -0.15), frameon=False, ncols=2,
                    fontsize="small")
    across.label_axis(axes.xaxis, axes.set_xscale, axes.set_xlim)
    up.label_axis(axes.yaxis, axes.set_yscale, axes.set_ylim)
    return values


def write_numbers(axes, image, values, across, up, shades):
    if shades.names or values.size > MOST_LABELLED:
        return
    for line, b in enumerate(up.at.values()):
        for column, a in enumerate(across.at.values()):
            if np.isfinite(values[line, column]):
                light = np.dot(image.cmap(image.norm(values[line, column]))[:3], (0.3, 0.59, 0.11)) > 0.5
                axes.annotate(short(values[line, column]), (a, b), ha="center", va="center", fontsize="x-small",
                              color="black" if light else "white")


def short(number):
    """In no more than five letters, mostly."""
    return f"{number:.3g}" if number == 0 or abs(number) >= 0.01 else f"{number:.0e}"


def line_panel(axes, rows, x, value, label=None, colour=BLUE, shades=None, units=UNITS):
    """The column `value` over one option: points joined by a line, names on a scale of names; failed runs are hatched
    over their share of the axis. Gives the values drawn, [n], nan where there is none. Raises ValueError where two
    rows stand at the same place."""
    shades, across = shades or Shades(rows, value, units), Scale(rows, x, units)
    cells = sorted_by_place(rows, (x,))
    values = np.full(len(across.values), np.nan)
    for (a,), row in cells.items():
        k = across.values.index(a)
        if row["status"] == "ok" or value == "status":
            values[k] = shades.number(row.get(value))
        else:
            axes.axvspan(across.edges[k], across.edges[k + 1], zorder=0, **FAILED)
            axes.annotate("failed", (across.at[a], 0.5), xycoords=("data", "axes fraction"), rotation=90, ha="center",
                          va="center", backgroundcolor="white", fontsize="small")
    axes.plot(list(across.at.values()), values, "o" if shades.names else "o-", color=colour, label=label, zorder=3)
    if shades.names:
        axes.set_yticks(range(len(shades.names)), shades.names)
        axes.set_ylim(-0.5, len(shades.names) - 0.5)
    axes.set_ylabel("" if shades.names else shades.label)
    axes.grid(alpha=0.25)
    across.label_axis(axes.xaxis, axes.set_xscale, axes.set_xlim)
    return values


def chosen_axes(rows, over):
    """The options of the axes, one or two, and the others that vary. Raises UnreadableRun."""
    options = options_of(rows)
    if over:
        if unknown := [name for name in over if not any(name in row for row in rows)]:
            raise UnreadableRun(f"The table has no column {unknown[0]}: its options are {', '.join(options)}.")
        axes = list(over)
        rest = varied(rows, [*axes, *(name for name in options if name not in axes)])
    else:
        rest = varied(rows, options)
        if not rest:
            raise UnreadableRun("No option was varied: the rows differ in none of the columns before `status`.")
        most = sorted(rest, key=lambda name: -len(values_of(rows, name)))[:2]  # stable: the first of equals
        axes = [name for name in rest if name in most]
    return axes, [name for name in rest if name not in axes]


def selected(rows, where):
    """The rows whose columns have the values of the dict `where`; of failed ones only options are asked, as they have
    nothing else. Raises UnreadableRun."""
    options = options_of(rows)
    for name, value in where.items():
        if not any(name in row for row in rows):
            raise UnreadableRun(f"The table has no column {name}: it has {', '.join(rows[0])}.")
        rows = [row for row in rows if row[name] == value
                or (row["status"] != "ok" and name not in options and row[name] is None)]
        if not rows:
            raise UnreadableRun(f"No row has {name} {value}.")
    return rows


def draw(rows, values=None, over=None, where=None, units=None):
    """The figure: a row of panels, one for each of `values`, for every combination of the options that are not on the
    axes. Raises UnreadableRun."""
    if not rows or "status" not in rows[0]:
        raise UnreadableRun("This is no table of a study: it has no rows, or no column `status`.")
    rows, units = selected(rows, where or {}), {**UNITS, **(units or {})}
    values = values or [name for name in SHOWN if name in rows[0]] or ["status"]
    if unknown := [name for name in values if name not in rows[0]]:
        raise UnreadableRun(f"The table has no column {unknown[0]}: it has {', '.join(rows[0])}.")
    axes, others = chosen_axes(rows, over)
    groups = {}
    for row in rows:
        groups.setdefault(tuple(row.get(name) for name in others), []).append(row)
    count = len(groups) * len(values)
    if count > MOST_PANELS:
        raise UnreadableRun(f"{len(groups)} combinations of {', '.join(others)} make {count} panels and {MOST_PANELS} "
                            "is the most: choose with --where and --value.")
    beside = 1 < len(groups) <= 3  # a column for each group, a row for each value
    if len(groups) == 1:
        columns = len(values) if len(values) < 4 else -(-len(values) // 2)
    else:
        columns = len(groups) if beside else len(values)
    lines = -(-count // columns)
    figure, panels = plt.subplots(lines, columns, figsize=(5.2 * columns, 4.2 * lines), squeeze=False,
                                  layout="constrained")
    figure.get_layout_engine().set(w_pad=0.1, h_pad=0.1)
    shades = {value: Shades(rows, value, units) for value in values}
    wanted = [(group, value) for group in groups for value in values]
    wanted = sorted(wanted, key=lambda pair: values.index(pair[1])) if beside else wanted
    for (group, value), panel in zip(wanted, panels.flat):
        said = ", ".join(in_words(name, option, units) for name, option in zip(others, group))
        draw_panel(figure, panel, groups[group], axes, value, shades[value], units)
        panel.set_title("\n".join(filter(None, (value if len(axes) > 1 else "", said))))
    for panel in panels.flat[count:]:
        panel.set_axis_off()
    return figure


def draw_panel(figure, panel, rows, axes, value, shades, units):
    try:
        if len(axes) > 1:
            map_panel(figure, panel, rows, *axes, value, shades, units)
        else:
            line_panel(panel, rows, *axes, value, shades=shades, units=units)
    except ValueError as error:
        raise UnreadableRun(f"{error} Choose with --where, or put one of these on an axis with --over.") from error


def pairs(words):
    """A dict of words of the form name=value; numbers as numbers."""
    return {name: number_or_text(value) for name, _, value in (word.partition("=") for word in words)}


def main(arguments=None):
    parser = Parser("maps", __doc__)
    parser.add_argument("table", help="table.csv of a study")
    parser.add_argument("--value", nargs="+", help=f"columns to draw (default: {', '.join(SHOWN)}, where they exist)")
    parser.add_argument("--over", nargs="+", metavar="OPTION", help="one or two options for the axes")
    parser.add_argument("--where", nargs="+", default=[], metavar="NAME=VALUE", help="only these rows")
    parser.add_argument("--unit", nargs="+", default=[], metavar="NAME=UNIT", help="units of columns")

    def figure(options):
        if options.over and len(options.over) > 2:
            parser.error("--over takes one or two options")
        return draw(read_csv(options.table), options.value, options.over, pairs(options.where), pairs(options.unit))

    return write_picture(parser, figure, arguments)
