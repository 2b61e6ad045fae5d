"""What several pictures share: cells in colour, units of length, and the way from the command line to the image."""

import sys
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection
from PIL import Image

from slipscale.reading import UnreadableRun

PREFIXES = ((1.0, "m"), (1e-3, "mm"), (1e-6, "µm"), (1e-9, "nm"))


def length_unit(coordinates):
    """A factor from metres and the name of the unit that suits the extent of coordinates [n, 2] m."""
    size = np.ptp(coordinates, axis=0).max()
    for metres, name in PREFIXES:
        if size >= 0.999 * metres:
            return 1 / metres, name
    return 1 / PREFIXES[-1][0], PREFIXES[-1][1]


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


def keep_small(picture, copy):
    """A copy with 256 colours, a third of the size, to stand in a README."""
    with Image.open(picture) as image:
        image.convert("RGB").quantize(256).save(copy, optimize=True)


def write_picture(parser, draw, arguments=None):
    """Adds the argument `picture`, parses, and saves `draw(options)`: 0, or 2 after one sentence on stderr."""
    parser.add_argument("picture", help="image to write; the ending chooses the format")
    options = parser.parse_args(arguments)
    endings = plt.figure().canvas.get_supported_filetypes()
    if Path(options.picture).suffix.lstrip(".") not in endings:
        parser.error(f"{options.picture} should end in one of: {', '.join(endings)}")
    plt.rcParams.update({"font.size": 11, "axes.titlesize": 11.5})
    try:
        draw(options).savefig(options.picture, dpi=120)
    except (UnreadableRun, OSError) as error:
        print(error, file=sys.stderr)
        return 2
    return 0
