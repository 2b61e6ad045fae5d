"""Phase portraits of several runs in one panel, each run a colour.

A run is a pair: its name for the legend and its folder. Colours follow the order of the runs.
"""

from slipscale.measuring.window import MICRO, in_words, rows_in
from slipscale.pictures.colours import BLACK, BLUE, GREEN, ORANGE, PURPLE, SKY, VERMILION
from slipscale.reading import History, UnreadableRun

COLOURS = (BLUE, ORANGE, GREEN, PURPLE, SKY, VERMILION)


def colour_of(k, name):
    """Of the k-th run; the homogeneous one is black in every panel."""
    return BLACK if "homogeneous" in name else COLOURS[k % len(COLOURS)]


def portraits(axes, runs, window, point=0, last=None):
    """Tangential velocity over tangential displacement of a probe point, over `window` (s) or its `last` seconds."""
    window = window if last is None else (max(window[0], window[1] - last), window[1])
    for k, (name, folder) in enumerate(runs):
        history = History(folder)
        if point >= len(history.points):
            raise UnreadableRun(f"{folder} recorded no probe point {point}: name one with -history_points.")
        rows = rows_in(history.time, window)
        u, v = history.points[point].u[rows, 0] * MICRO, history.points[point].v[rows, 0]
        axes.plot(u, v, color=colour_of(k, name), linewidth=0.7, alpha=0.8, label=name, rasterized=True)
    axes.grid(alpha=0.25)
    axes.legend(frameon=False, fontsize="small", loc="upper center", bbox_to_anchor=(0.5, -0.17), ncol=2)
    axes.set(title=f"Phase portrait of M, {in_words(window)}", xlabel="tangential displacement [µm]",
             ylabel="tangential velocity [m/s]")
