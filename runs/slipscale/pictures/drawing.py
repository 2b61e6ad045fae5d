"""What several pictures share: cells in colour, units of length, and the way from the command line to the image."""

import os
import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.backend_bases import FigureCanvasBase
from matplotlib.collections import LineCollection
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter
from PIL import Image

from slipscale.mistakes import Mistake

PREFIXES = ((1.0, "m"), (1e-3, "mm"), (1e-6, "µm"), (1e-9, "nm"))


def length_unit(coordinates):
    """A factor from metres and the name of the unit that suits the extent of coordinates [n, 2] m."""
    size = np.ptp(coordinates, axis=0).max()
    for metres, name in PREFIXES:
        if size >= 0.999 * metres:
            return 1 / metres, name
    return 1 / PREFIXES[-1][0], PREFIXES[-1][1]


def shown(folder, most=60):
    """The path of a folder as a title says it: its last parts, where all of it would not fit."""
    parts = Path(folder).parts
    kept = [part for k, part in enumerate(parts) if len(str(Path(*parts[k:]))) <= most] or [parts[-1][-most:]]
    return str(Path(*kept)) if len(kept) == len(parts) else "…/" + str(Path(*kept))


def limits_of(values, cut):
    """Limits of a colour scale; the lowest and the highest `cut` % of the values may lie outside."""
    low, high = np.percentile(values, [cut, 100 - cut])
    if not high - low > 1e-6 * abs(high):  # a homogeneous field
        low, high = low - 0.05 * abs(low), high + 0.05 * abs(high)
    return low, high


def colours_for(values, cut=1.0):
    """Name of a colour map and its limits as of `limits_of`. Where both signs matter zero is white."""
    low, high = limits_of(values, cut)
    if low < 0 < high and min(-low, high) > 0.2 * max(-low, high):
        high = max(-low, high)
        return "RdBu_r", -high, high
    return "cividis", low, high


def draw_cells(axes, mesh, values, colours, linewidth=0.8):
    """Values [nc] on the cells of `mesh` (a `reading.OnMesh`) and the outlines of its regions; gives the image.

    `colours` are a map and its limits, as of `colours_for`.
    """
    scale, unit = length_unit(mesh.coordinates)
    name, low, high = colours
    image = axes.tripcolor(*(mesh.coordinates.T * scale), mesh.triangles, facecolors=values[mesh.cell_of_triangle],
                           cmap=name, vmin=low, vmax=high, rasterized=True)
    axes.add_collection(LineCollection(mesh.outlines() * scale, colors="black", linewidths=linewidth))
    axes.margins(0)
    axes.set_aspect("equal")
    axes.set(xlabel=f"x [{unit}]", ylabel=f"y [{unit}]")
    return image


def few_ticks(axis):
    """On a logarithmic axis that spans a decade or so the labels of 1, 2 and 5 do not run into each other."""
    low, high = sorted(axis.get_view_interval())
    if low > 0 and high < 30 * low:
        axis.set_major_locator(LogLocator(subs=(1, 2, 5)))
        axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:.3g}"))
        axis.set_minor_formatter(NullFormatter())


def keep_small(picture, copy):
    """A copy to stand in a README: without transparency, in all of its colours, as fields would show steps in fewer. It
    is there whole or not at all."""
    unfinished = Path(copy).with_name(f"unfinished-{Path(copy).name}")
    with Image.open(picture) as image:
        image.convert("RGB").save(unfinished, optimize=True)
    os.replace(unfinished, copy)


def write_picture(parser, draw, arguments=None):
    """Adds the argument `picture`, parses, and saves `draw(options)`: 0, or 2 after one sentence on stderr."""
    parser.add_argument("picture", help="image to write; the ending chooses the format")
    options = parser.parse_args(arguments)
    try:
        save(parser, options.picture, lambda: draw(options))
    except (Mistake, OSError) as error:
        print(f"{parser.prog}: {error}", file=sys.stderr)
        return 2
    return 0


def save(parser, path, draw):
    """Saves the figure that `draw()` gives; the ending of the path is looked at first, mistakes end the command."""
    endings = FigureCanvasBase.get_supported_filetypes()
    if Path(path).suffix.lstrip(".") not in endings:
        parser.error(f"{path} should end in one of: {', '.join(endings)}")
    plt.rcParams.update({"font.size": 11, "axes.titlesize": 11.5})
    draw().savefig(path, dpi=120)
