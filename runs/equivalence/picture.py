"""Several morphologies of a composite and their homogenised blocks in one picture: portraits, spectra, shares, verdict.

    python3 -m equivalence.picture picture.png --composites FOLDER... --homogenised FOLDER...
        --window 250e-6 400e-6 [--point 0]

The k-th homogenised block is that of the k-th morphology, and is drawn with it. The last panel has every distance over
the largest that the scatter of the morphologies allows (`equivalence.verdict`): a homogenised block left of 1 is as
near to the morphologies as they are to each other.
"""

import sys

import numpy as np

from equivalence.verdict import SCALARS, judge, read_run, verdict
from slipscale.measuring.regime import HIGHEST
from slipscale.measuring.window import MICRO, in_words
from slipscale.parser import Parser, Window
from slipscale.pictures.colours import BLACK
from slipscale.pictures.drawing import plt, write_picture
from slipscale.pictures.overlay import COLOURS

SHOWN = 60e-6  # s, of a portrait: more would hide the paths
GREY = "0.55"
SHARES = {"stick": "stick", "open": "open", "friction": "friction", "power_ratio": "power into\nbody / drive"}
JUDGED = ("spectrum", "portrait", *SCALARS)


def portrait(axes, composite, homogenised, spacing, colour, name):
    """Of a morphology over that of its homogenised block; Runs, `spacing` of their rows in s."""
    for run, rows, shade in ((homogenised, spacing[1], GREY), (composite, spacing[0], colour)):
        if run is not None:
            u, v = run.portrait[:, -max(2, round(SHOWN / rows)):]
            axes.plot(u * MICRO, v, linewidth=0.8, alpha=0.9, rasterized=True, color=shade)
    axes.grid(alpha=0.25)
    axes.set_title(name, color=colour)
    axes.set_xlabel("displacement of M [µm]")


def spectra(axes, composites, homogenised, window):
    for runs, colours, width in ((composites, COLOURS, 1.3), (homogenised, [BLACK] * len(homogenised), 0.8)):
        for k, run in enumerate(runs):
            label = f"morphology {k + 1}" if runs is composites else None if k else "homogenised blocks"
            frequency, height = run.spectrum
            axes.semilogy(frequency / 1e3, np.maximum(height, 1e-12), color=colours[k % len(colours)], linewidth=width,
                          alpha=0.85, label=label)
    top = max(run.spectrum[1].max() for run in (*composites, *homogenised))
    axes.set(ylim=(top * 1e-3, top * 1.6), xlim=(0, HIGHEST / 1e3), xlabel="frequency [kHz]", ylabel="√density [1/√Hz]",
             title=f"Spectrum of T / mean N at the top, {in_words(window)}")
    axes.grid(alpha=0.25)
    axes.legend(fontsize="small", framealpha=0.9, loc="upper center", bbox_to_anchor=(0.5, -0.13), ncol=3)


def dots(axes, line, composites, homogenised):
    """Values of both kinds, a little above and below a line."""
    for k, value in enumerate(composites):
        axes.plot(value, line + 0.12, "o", color=COLOURS[k % len(COLOURS)], markersize=6)
    axes.plot(homogenised, np.full(len(homogenised), line - 0.16), "|", color=BLACK, markersize=11, markeredgewidth=1.6)


def shares(axes, composites, homogenised):
    for line, name in enumerate(SHARES):
        dots(axes, line, [run.values[name] for run in composites], [run.values[name] for run in homogenised])
    axes.set_yticks(range(len(SHARES)), SHARES.values())
    axes.set_ylim(len(SHARES) - 0.5, -0.5)
    axes.set_xlim(left=min(0, axes.get_xlim()[0]))
    axes.grid(alpha=0.25)
    axes.set(title="Fractions, friction, power [1]", xlabel="dots: morphologies,\nbars: homogenised")


def distances(axes, composites, homogenised):
    for line, measure in enumerate(JUDGED):
        judged = judge(measure, composites, homogenised)
        smallest = 0.02 * judged.limit
        dots(axes, line, *([max(each, smallest) / judged.limit for each in side]
                           for side in (judged.composites, judged.homogenised)))
    axes.axvline(1, color=BLACK, linestyle="--", linewidth=1)
    axes.set_xscale("log")
    axes.set_yticks(range(len(JUDGED)), [name.replace("_", " ") for name in JUDGED])
    axes.set_ylim(len(JUDGED) - 0.5, -0.5)
    axes.grid(alpha=0.25)
    axes.set(title="Distance over that allowed", xlabel="to the mean of the\n(other) morphologies")


def draw(options):
    """The figure. Raises UnreadableRun."""
    composites, homogenised = ([read_run(folder, options.window, options.point) for folder in folders]
                               for folders in (options.composites, options.homogenised))
    count = len(composites)
    figure = plt.figure(figsize=(max(13, 3.4 * count), 8.8), layout="constrained")
    figure.get_layout_engine().set(w_pad=0.08, h_pad=0.1)
    above, below = figure.subfigures(2, 1, height_ratios=[1, 1.15])
    panels = above.subplots(1, count, sharex=True, sharey=True, squeeze=False)[0]
    length = options.window[1] - options.window[0]
    for k, (axes, run) in enumerate(zip(panels, composites)):
        own = homogenised[k] if k < len(homogenised) else None
        spacing = [length / each.portrait.shape[1] if each else None for each in (run, own)]
        portrait(axes, run, own, spacing, COLOURS[k % len(COLOURS)], f"morphology {k + 1}")
    panels[0].set_ylabel("tangential velocity of M [m/s]")
    above.suptitle(f"Verdict: {verdict(composites, homogenised)}\nPhase portraits of M over {SHOWN * MICRO:.0f} µs; "
                   "grey: the homogenised block of that morphology", fontsize=12)
    left, middle, right = below.subplots(1, 3, width_ratios=[1.6, 1, 1.1])
    spectra(left, composites, homogenised, options.window)
    shares(middle, composites, homogenised)
    distances(right, composites, homogenised)
    return figure


def main(arguments=None):
    parser = Parser("equivalence.picture", __doc__, "python3 -m")
    parser.add_argument("--composites", nargs="+", required=True, help="output folders of `slide`, two at least")
    parser.add_argument("--homogenised", nargs="+", required=True, help="output folders of `slide`")
    parser.add_argument("--window", action=Window, required=True, metavar=("FROM", "TO"), help="s")
    parser.add_argument("--point", type=int, default=0, help="probe point (default: 0)")

    def figure(options):
        if len(options.composites) < 2:
            parser.error("--composites needs two morphologies")
        return draw(options)

    return write_picture(parser, figure, arguments)


if __name__ == "__main__":
    sys.exit(main())
