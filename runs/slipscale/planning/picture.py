"""Error over cost: what the pilots gave, what any price buys, what is proposed, the wish and the budget."""

import numpy as np
from matplotlib.ticker import FuncFormatter, LogLocator, NullFormatter

from slipscale.pictures.colours import BLACK, BLUE, GREEN, ORANGE, VERMILION
from slipscale.pictures.drawing import plt

COLOURS = {"grid": BLUE, "triangle": ORANGE, "quadrilateral": GREEN}
MARKERS = {"grid": "s", "triangle": "^", "quadrilateral": "D"}
LEAST = 1e-5  # relative: what lies below is drawn there
LEGEND = 0.7  # inches above the panels


def deviations(planning, name):
    """Pilots by kind of cells: (seconds, |value - limit| over the size, error over the size), arrays."""
    result, found = planning.results[name], {}
    if not result.fit.limit.any():
        return found
    for cell in planning.case.cells:
        of = [pilot for pilot in planning.pilots if pilot.cell == cell and pilot.seed is None and name in pilot.values]
        if of:
            limit = result.fit.limit.mean()
            found[cell] = (np.array([pilot.cost for pilot in of]),
                           np.array([max(LEAST, abs(pilot.values[name][0] - limit) / result.size) for pilot in of]),
                           np.array([pilot.values[name][1] / result.size for pilot in of]))
    return found


def panel(axes, planning, proposal, wish):
    result, best = planning.results[wish.name], planning.best
    for cell, (seconds, apart, error) in deviations(planning, wish.name).items():
        axes.errorbar(seconds, 100 * apart, yerr=100 * np.minimum(error, 0.9 * apart), fmt=MARKERS.get(cell, "o"),
                      color=COLOURS.get(cell, BLACK), label=f"pilots, {cell}", capsize=2)
    most = max(10 * proposal.seconds, planning.budget or 0)
    axes.plot(*(part * scale for part, scale in zip(planning.search.front(wish.name, most), (1, 100))), color=GREEN,
              label="best of each price for this result alone: bound")
    mean, deviation = result.fit.expected(best.h, best.step, best.number)
    axes.plot(proposal.seconds, 100 * best.bounds[wish.name], "*", color=VERMILION, markersize=15, label="proposed: bound")
    axes.plot(proposal.seconds, max(100 * LEAST, 100 * abs(mean)), "_", color=VERMILION, markersize=14,
              label="its mesh and step alone")
    axes.axhline(100 * wish.allowed(result.size), color=BLACK, linestyle="--", linewidth=1, label="wished for")
    if planning.budget:
        axes.axvline(planning.budget, color=BLACK, linestyle=":", linewidth=1, label="budget")
    axes.set(xscale="log", yscale="log", xlabel="seconds of one core", ylabel="error [%]",
             title=f"{wish.name.replace('_', ' ')}\nits mesh and step: {100 * mean:+.2g} ± {100 * deviation:.2g} %")
    for axis in (axes.xaxis, axes.yaxis):
        axis.set_major_locator(LogLocator(subs=(1, 2, 5)))
        axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}"))
        axis.set_minor_formatter(NullFormatter())
    axes.grid(True, which="major", alpha=0.3)


def draw(planning, proposal, path):
    """Writes the picture, a panel for each wish."""
    wishes = planning.wishes
    rows = -(-len(wishes) // 3)
    count = min(3, len(wishes))
    height = 4.8 * rows + LEGEND
    figure, axes = plt.subplots(rows, count, figsize=(6.2 * count, height), squeeze=False, layout="constrained")
    figure.get_layout_engine().set(rect=(0, 0, 1, 1 - LEGEND / height))
    for wish, one in zip(wishes, axes.ravel()):
        panel(one, planning, proposal, wish)
    for one in axes.ravel()[len(wishes):]:
        one.set_axis_off()
    named = {label: handle for one in axes.flat for handle, label in zip(*one.get_legend_handles_labels())}
    figure.legend(named.values(), named.keys(), loc="upper center", ncols=min(len(named), 3 * count), frameon=False)
    figure.savefig(path, dpi=110)
    plt.close(figure)


if __name__ == "__main__":
    raise SystemExit("slipscale.planning.picture is a library, no command: slipscale -h lists the commands.")
