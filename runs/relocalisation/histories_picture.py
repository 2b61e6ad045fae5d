"""Local stress over time, with and without relocalisation: a column for each case, a row for each probe point.

    python3 -m relocalisation.histories_picture out.png [--component yy]
        --case stable REFERENCE RELOCALISED --case transient REFERENCE RELOCALISED ...

The folders are those of the heterogeneous `slide` run and of `relocalize`, which holds the homogeneous stress as well.
Exits with code 2 and one sentence when there is nothing to plot.
"""

import sys

from slipscale.parser import Parser
from slipscale.pictures.drawing import plt, write_picture
from slipscale.pictures.local_history import heterogeneous_history, history_panel, legend_below
from slipscale.pictures.panels import say
from slipscale.reading import Fields, UnreadableRun

COMPONENTS = ("xx", "yy", "xy")


def draw(cases, component="yy"):
    """The figure of `cases`, tuples of a name and the two folders. Raises UnreadableRun."""
    index, name = COMPONENTS.index(component), rf"$\sigma_{{{component}}}$"
    points = [points_of(relocalised) for _, _, relocalised in cases]
    rows = max(map(len, points))
    figure, axes = plt.subplots(rows, len(cases), figsize=(6.2 * len(cases), 3.3 * rows + 0.7), layout="constrained",
                                squeeze=False)
    for column, (case, reference, _) in enumerate(cases):
        with Fields(reference) as fields:
            for row in range(rows):
                panel = axes[row, column]
                if row < len(points[column]):
                    point = points[column][row]
                    history_panel(panel, f"{case}: ", point, heterogeneous_history(reference, fields, point.x), index,
                                  name, None)
                else:
                    say(panel, case, "There is no further probe point (option relocalize_points).")
    legend_below(figure, axes.flat)
    figure.suptitle(f"Local {name} over time", fontsize="large", fontweight="bold")
    return figure


def points_of(relocalised):
    """Probe points, those of a phase beside each other and nearest to the contact first."""
    with Fields(relocalised, "relocalized.h5", "relocalize") as file:
        points = file.local_points()
    if not points:
        raise UnreadableRun(f"{relocalised} has no probe points: give `relocalize` some with -relocalize_points.")
    return sorted(points, key=lambda point: (point.region, point.x[1]))


def main(arguments=None):
    parser = Parser("relocalisation.histories_picture", __doc__, "python3 -m")
    parser.add_argument("--case", nargs=3, action="append", required=True, metavar=("NAME", "REFERENCE", "RELOCALISED"))
    parser.add_argument("--component", choices=COMPONENTS, default="yy", help="of the stress (default yy)")
    return write_picture(parser, lambda options: draw(options.case, options.component), arguments)


if __name__ == "__main__":
    sys.exit(main())
