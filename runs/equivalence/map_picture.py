"""Where a homogenised block is equivalent to the composite and where not: verdicts of a table on maps over two options.

    python3 -m equivalence.map_picture out/equivalence/verdicts.csv picture.png --over friction load
        [--where memory=T0.6 speed=2] [--panel block] [--unit load=MPa]

Colour is the verdict of `equivalence.verdict`, with the strongest frequency of composite / homogenised block in kHz
and below it how far the homogenised block's spectrum is from the morphologies' / how far that may be; * where a run
had not settled.
"""

import sys

from equivalence.verdict import VERDICTS
from slipscale.parser import Parser
from slipscale.pictures.colours import BLACK, BLUE, GREEN, ORANGE, PURPLE, SKY, VERMILION
from slipscale.pictures.drawing import plt, write_picture
from slipscale.pictures.maps import FAILED, map_panel, pairs, selected
from slipscale.pictures.scales import UNITS, Scale, Shades
from slipscale.reading import UnreadableRun
from slipscale.running.table import is_true, read_csv

COLOURS = dict(zip(VERDICTS, (GREEN, "#B9E3D3", "0.8", SKY, PURPLE, VERMILION, ORANGE, BLUE)))
LIGHT = (VERMILION, BLUE)  # behind white words


def said(row):
    """What stands in a cell."""
    frequencies = "/".join(f"{row[f'frequency_{kind}'] / 1e3:.0f}" for kind in ("composites", "homogenised"))
    still_changing = "" if is_true(row["settled"]) else "*"
    return f"{frequencies}{still_changing}\n{row['spectrum_apart']:.2f}/{row['spectrum_limit']:.2f}"


def write_cells(axes, rows, x, y, units):
    across, up = Scale(rows, x, units), Scale(rows, y, units)
    for row in rows:
        if row["status"] == "ok":
            colour = "white" if COLOURS[row["verdict"]] in LIGHT else BLACK
            axes.annotate(said(row), (across.at[row[x]], up.at[row[y]]), ha="center", va="center", color=colour,
                          fontsize="x-small")


def shades_of(rows):
    """The same colours in every picture."""
    shades = Shades(rows, "verdict")
    shades.names = [name for name in VERDICTS if name in shades.names]
    shades.colours = {name: COLOURS[name] for name in shades.names}
    return shades


def draw(options):
    """The figure: a panel for each value of the option `panel`. Raises UnreadableRun."""
    rows = selected(read_csv(options.table), pairs(options.where))
    x, y = options.over
    units = {**UNITS, **pairs(options.unit)}
    values = list(dict.fromkeys(row[options.panel] for row in rows)) if options.panel else [None]
    figure, panels = plt.subplots(1, len(values), figsize=(5.6 * len(values) + 1, 6), squeeze=False,
                                  layout="constrained")
    figure.get_layout_engine().set(w_pad=0.1, rect=(0, 0.13, 1, 0.87))
    shades = shades_of(rows)
    for axes, value in zip(panels[0], values):
        members = [row for row in rows if not options.panel or row[options.panel] == value]
        try:
            map_panel(figure, axes, members, x, y, "verdict", shades, units)
        except ValueError as error:
            raise UnreadableRun(f"{error} Choose with --where, or give them panels with --panel.") from error
        write_cells(axes, members, x, y, units)
        axes.set_title(f"{options.panel} {value}" if options.panel else "")
        axes.get_legend().remove()
    figure.legend(handles=handles(shades, rows), loc="lower center", frameon=False, ncols=3, fontsize="small")
    figure.suptitle("Strongest frequency, composites/homogenised [kHz] (* not settled)\n"
                    "and distance of their spectra, found/allowed", fontsize=11)
    return figure


def handles(shades, rows):
    names = [plt.Rectangle((0, 0), 1, 1, facecolor=colour, label=name) for name, colour in shades.colours.items()]
    failed = any(row["status"] != "ok" for row in rows)
    return names + [plt.Rectangle((0, 0), 1, 1, label="failed", **FAILED)] * failed


def main(arguments=None):
    parser = Parser("equivalence.map_picture", __doc__, "python3 -m")
    parser.add_argument("table", help="verdicts.csv of the study")
    parser.add_argument("--over", nargs=2, required=True, metavar=("X", "Y"), help="options of the axes")
    parser.add_argument("--panel", help="option that has a panel for each of its values")
    parser.add_argument("--where", nargs="+", default=[], metavar="NAME=VALUE", help="only these rows")
    parser.add_argument("--unit", nargs="+", default=[], metavar="NAME=UNIT", help="units of options")
    return write_picture(parser, draw, arguments)


if __name__ == "__main__":
    sys.exit(main())
