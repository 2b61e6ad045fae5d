"""A sequence of refinements in one picture: portraits, errors over size and over price, averages over size.

    python3 -m refinement.picture out/refinement/table.csv before picture.png
        [--variants coulomb T30 --size 0.25e-3 0.1e-3 --window 0 40e-6]

The options draw phase portraits of the probe point: a panel for each variant, the runs with these sizes or steps above
each other. The runs lie beside the table, in the folder `run`.
"""

import sys
from pathlib import Path

import numpy as np
from matplotlib.ticker import FixedLocator, FuncFormatter, NullFormatter

from refinement.orders import CONVERGES, found_in
from refinement.sequences import SAME
from slipscale.measuring.window import in_words
from slipscale.parser import Parser, Window
from slipscale.pictures import overlay
from slipscale.pictures.colours import BLACK, BLUE, GREEN, ORANGE, PURPLE, SKY, VERMILION
from slipscale.pictures.drawing import PREFIXES, few_ticks, plt, write_picture
from slipscale.reading import UnreadableRun
from slipscale.running.table import read_csv

COLOURS = (VERMILION, ORANGE, BLUE, GREEN, PURPLE, SKY, BLACK)
MARKERS = "oDs^vP*"
COLUMNS = 4
LIMIT = 0.5  # where limits stand, over the finest size
TIMES = ((1.0, "s"), (1e-3, "ms"), (1e-6, "µs"), (1e-9, "ns"), (1e-12, "ps"))
UNRELATED = np.sqrt(2)


def unit_of(h, along):
    """A factor from SI and the name of the unit that suits sizes (m) or steps (s): the largest is .1 or more."""
    for factor, name in PREFIXES if along == "size" else TIMES:
        if np.max(h) >= 0.0999 * factor:
            return 1 / factor, name
    return 1.0, "m" if along == "size" else "s"


def axis_name(along, unit):
    return f"element size [{unit}]" if along == "size" else f"time step [{unit}]"


class Look:
    """Colour and marker of each variant, the same in every panel."""

    def __init__(self, variants):
        self.variants = list(dict.fromkeys(variants))

    def of(self, variant):
        k = self.variants.index(variant)
        return {"color": COLOURS[k % len(COLOURS)], "marker": MARKERS[k % len(MARKERS)], "markersize": 5}


def ticks_at(axes, values, limit=None):
    """Ticks at the sizes themselves, which are few, and at the place of the limit."""
    places = sorted(set(values))
    near = [next_ for place, next_ in zip(places, places[1:]) if next_ < 1.3 * place]  # their labels would touch
    axes.xaxis.set_major_locator(FixedLocator([*places, *([limit] if limit else [])]))
    axes.xaxis.set_minor_formatter(NullFormatter())
    axes.xaxis.set_major_formatter(FuncFormatter(
        lambda x, _: "limit" if x == limit else "" if x in near else f"{x:.4g}"))
    axes.minorticks_off()


def room_for_legend(axes, entries):
    """Widens a logarithmic axis so that a legend below hides nothing, nor the frame the line of unrelated runs."""
    bottom, top = axes.get_ylim()
    top = max(top, 2.5 * UNRELATED)
    axes.set_ylim(top * (bottom / top) ** (1 / (1 - 0.06 * entries)), top)
    axes.legend(fontsize="small", framealpha=0.9, loc="lower right")


def error_panel(axes, found, look):
    """Distances to the reference over size or step, with the observed order."""
    scale, unit = unit_of(found[0].h, found[0].along)
    for each in found:
        known = np.isfinite(each.errors) & (each.errors > 0)
        order = f"order {each.order:.1f}" if each.verdict == CONVERGES else each.verdict
        axes.loglog(each.h[known] * scale, each.errors[known], "-", **look.of(each.variant),
                    label=f"{each.variant}: {order}")
    if found[0].quantity != "portrait":
        axes.axhline(UNRELATED, color="0.6", linestyle=":", linewidth=1)
        axes.annotate("unrelated", (0.02, UNRELATED), (0, 3), color="0.45", xycoords=("axes fraction", "data"),
                      textcoords="offset points", fontsize="small")
    guide(axes, found, scale)
    ticks_at(axes, np.concatenate([each.h[np.isfinite(each.errors)] for each in found]) * scale)
    axes.grid(alpha=0.25)
    room_for_legend(axes, len(found) + 1)
    axes.set(title=f"{in_title(found[0])}, distance to the reference", xlabel=axis_name(found[0].along, unit),
             ylabel="relative L2 distance" if found[0].quantity != "portrait" else "distance [deviations]")


def guide(axes, found, scale):
    """A line of order 2 below everything."""
    ends = [(each.h[np.isfinite(each.errors)], each.errors[np.isfinite(each.errors)]) for each in found]
    ends = [(h, errors) for h, errors in ends if len(h) > 1 and np.all(errors > 0)]
    if not ends:
        return
    h, errors = min(ends, key=lambda end: end[1][-1])
    x = np.array([h[0], h[-1]])
    axes.loglog(x * scale, 0.5 * errors[-1] * (x / h[-1]) ** 2, color="0.7", linewidth=1, label="order 2")


def price_panel(axes, found, look, name, label):
    """Errors over what they cost."""
    for each in found:
        known = np.isfinite(each.errors) & (each.errors > 0)
        axes.loglog(getattr(each, name)[known], each.errors[known], "-", **look.of(each.variant))
    few_ticks(axes.xaxis)
    low, high = axes.get_xlim()
    if high > 20 * low:
        axes.xaxis.set_minor_formatter(NullFormatter())
    axes.grid(alpha=0.25)
    axes.set(title=f"{in_title(found[0])}, error over {label}", xlabel=label,
             ylabel="distance to the reference")


def average_panel(axes, found, look):
    """Values with their scatter in time over size or step, and limits with their error bars at the left."""
    scale, unit = unit_of(found[0].h, found[0].along)
    sizes = np.unique(np.concatenate([each.h for each in found])) * scale
    factor = 1e-3 if found[0].unit == "Hz" else 1.0
    for k, each in enumerate(found):
        style = look.of(each.variant)
        axes.errorbar(each.h * scale, each.values * factor, each.scatter * factor, linewidth=1, capsize=2,
                      **style)
        if np.isfinite(each.limit):
            axes.errorbar(sizes[0] * LIMIT * 0.93**k, each.limit * factor, each.bar * factor, capsize=3,
                          linewidth=1.5, **{**style, "markerfacecolor": "none"})
    axes.set_xscale("log")
    ticks_at(axes, sizes, sizes[0] * LIMIT if any(np.isfinite(each.limit) for each in found) else None)
    axes.grid(alpha=0.25)
    said = "kHz" if found[0].unit == "Hz" else found[0].unit
    axes.set(title=f"{in_title(found[0])}, average", xlabel=axis_name(found[0].along, unit),
             ylabel=f"{in_title(found[0])} [{said}]")


def in_title(found):
    return found.quantity.replace("_", " ").capitalize()


def chosen(rows, variant, options):
    """Pairs for `overlay`: what tells the runs of a variant apart, and the name of the run."""
    along = "size" if options.size else "step"
    for value in options.size or options.step or []:
        for row in rows:
            if row["variant"] == variant and abs(row[along] / value - 1) < SAME:
                scale, unit = unit_of([row["size"]], "size")
                time, second = unit_of([row["step"]], "step")
                yield f"{row['size'] * scale:.3g} {unit}, {row['step'] * time:.3g} {second}", row["run"]
                break


def portrait_panels(axes, rows, options):
    """One panel for each variant asked for."""
    for panel, variant in zip(axes, options.variants):
        runs = [(name, options.table.parent / "run" / run) for name, run in chosen(rows, variant, options)]
        if not runs:
            raise UnreadableRun(f"There is no run of {variant} with these sizes or steps.")
        overlay.portraits(panel, runs, options.window)
        panel.set_title(f"{variant}: phase portrait of M, {in_words(options.window)}")


def panels_of(found):
    """What is drawn of the quantities: functions of axes and look."""
    quantities = {}
    for each in found:
        quantities.setdefault((each.kind, each.quantity), []).append(each)
    distances = [group for (kind, _), group in quantities.items() if kind != "average"]
    averages = [group for (kind, _), group in quantities.items() if kind == "average"]
    for k, group in enumerate(distances):
        yield lambda axes, look, group=group: error_panel(axes, group, look)
        if k == 0:
            yield lambda axes, look, group=group: price_panel(axes, group, look, "node_steps", "node-steps")
            yield lambda axes, look, group=group: price_panel(axes, group, look, "seconds", "seconds computed")
    for group in averages:
        yield lambda axes, look, group=group: average_panel(axes, group, look)


def legend_panel(axes, look, averages):
    """What colours, markers and bars mean."""
    handles = [plt.Line2D([], [], **look.of(variant), label=variant) for variant in look.variants]
    if averages:
        handles += [plt.Line2D([], [], color=BLACK, marker="|", markersize=12, linestyle="", label="scatter in time"),
                    plt.Line2D([], [], color=BLACK, marker="o", markerfacecolor="none", linestyle="",
                               label="limit for ever finer runs ± error bar")]
    axes.legend(handles=handles, loc="center", frameon=False)
    axes.axis("off")


def draw(options):
    """The figure of one sequence of the table. Raises UnreadableRun."""
    rows = [row for row in read_csv(options.table) if row["sequence"] == options.sequence and row["status"] == "ok"]
    found = found_in(rows)
    drawn = list(panels_of(found))
    if not drawn:
        raise UnreadableRun(f"{options.table} holds nothing that was found for the sequence {options.sequence}.")
    portraits = len(options.variants)
    columns = max(COLUMNS, portraits + 1)
    first = 1 if portraits else 0
    height = first + -(-(len(drawn) + (not portraits)) // columns)
    figure, axes = plt.subplots(height, columns, figsize=(4.7 * columns, 4.2 * height), layout="constrained",
                                squeeze=False)
    figure.get_layout_engine().set(w_pad=0.1, h_pad=0.1)
    look = Look(each.variant for each in found)
    if portraits:
        portrait_panels(axes[0][:portraits], rows, options)
    rest = [*axes[0][portraits:], *axes[1:].ravel()] if portraits else [*axes.ravel()]
    if portraits:
        legend_panel(rest.pop(0), look, any(each.is_average() for each in found))
        while len(rest) > (height - 1) * columns:
            rest.pop(0).axis("off")
    for paint in drawn:
        paint(rest.pop(0), look)
    if not portraits:
        legend_panel(rest.pop(0), look, any(each.is_average() for each in found))
    for panel in rest:
        panel.axis("off")
    return figure


def main(arguments=None):
    parser = Parser("refinement.picture", __doc__, "python3 -m")
    parser.add_argument("table", type=Path, help="table.csv of the study")
    parser.add_argument("sequence", help="its name")
    parser.add_argument("--variants", nargs="*", default=[], help="whose portraits are drawn")
    parser.add_argument("--size", nargs="*", type=float, help="element sizes of the runs, m")
    parser.add_argument("--step", nargs="*", type=float, help="or their time steps, s")
    parser.add_argument("--window", action=Window, default=(0, 1e9), help="times in s")
    return write_picture(parser, draw, arguments)


if __name__ == "__main__":
    sys.exit(main())
