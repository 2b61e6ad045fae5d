"""Two or more runs of slide side by side: numbers, and a picture if one is named.

    slipscale compare FOLDER FOLDER [FOLDER …] [--window FROM TO] [--point 0] [--picture compared.png]

All are measured over one window, by default the second half of the shortest run. Means have standard errors from blocks
of the window; a difference from the first run counts where it is more than three standard errors of it, which are never
taken for less than rounding. Distances of spectra and of phase portraits stand beside those of the halves of the first
run's window from each other, which is what scatter alone makes. Options in which the runs differ are listed.
"""

from slipscale.measuring.averages import with_error
from slipscale.measuring.comparing import UNITS, changed_options, differences, distances, read_all
from slipscale.measuring.window import MICRO
from slipscale.parser import Parser, Window


def aligned(rows):
    """Rows of texts in columns."""
    widths = [max(len(row[k]) for row in rows) for k in range(len(rows[0]))]
    return "\n".join("  ".join(cell.ljust(width) for cell, width in zip(row, widths)).rstrip() for row in rows)


def judged(found):
    """A Difference as text."""
    if found.differs is None:
        return f"{found.value:+.3g}"
    verdict = "differs" if found.differs else "the same"
    if not found.scatters:
        return f"{found.value:+.3g}, neither scatters: {verdict}{'' if found.differs else ' to rounding'}"
    return f"{found.value:+.3g}, {abs(found.value) / found.error:.2g} errors: {verdict}"


def numbers(runs):
    """The table of means, and of differences from the first run."""
    first, *others = runs
    rows = [["", *(run.name for run in runs), *(f"{run.name} less {first.name}" for run in others)]]
    found = [differences(run, first) for run in others]
    for name, unit in UNITS.items():
        if name in first.means:
            rows.append([f"{name} [{unit}]",
                         *(with_error(*run.means[name]) if name in run.means else "-" for run in runs),
                         *(judged(each[name]) if name in each else "-" for each in found)])
    rows.append(["amplitude [1]", *(f"{run.amplitude:.3g}" for run in runs), *("" for _ in others)])
    rows.append(["frequency [kHz]", *(f"{run.frequency * 1e-3:.4g}" if run.frequency else "none" for run in runs),
                 *(f"{(run.frequency - first.frequency) * 1e-3:+.3g}" if run.frequency and first.frequency else ""
                   for run in others)])
    rows.append(["regime", *(run.regime for run in runs), *("" for _ in others)])
    rows.append(["settled", *(f"{'yes' if run.settling.settled else 'NO'}, amplitude ratio "
                              f"{run.settling.amplitude_ratio:.3g}" for run in runs), *("" for _ in others)])
    return rows


def apart(runs):
    """Rows of distances from the first run."""
    first, *others = runs
    rows = [["distance of", *(run.name for run in others), f"scatter of {first.name}"]]
    found = [distances(run, first) for run in others]
    for name in ("spectrum", "portrait"):
        if known := [each[name] for each in found if name in each]:
            rows.append([name, *(f"{each[name][0]:.3g}" if name in each else "-" for each in found),
                         f"{known[0][1]:.3g}"])
    return rows


def text(runs):
    """What is said about the runs."""
    begin, end = (time * MICRO for time in runs[0].window)
    parts = [f"from {begin:.4g} to {end:.4g} µs; errors are standard errors from blocks of the window",
             *(f"note on {run.name}: {note}" for run in runs for note in run.notes),
             aligned(numbers(runs)), aligned(apart(runs))]
    if changes := changed_options(runs):
        rows = [["option", *(run.name for run in runs)],
                *([name, *("-" if value is None else str(value) for value in values)]
                  for name, values in changes.items())]
        parts.append(aligned(rows))
    else:
        parts.append("no option differs in run.yaml")
    return "\n\n".join(parts)


def main(arguments=None):
    parser = Parser("compare", __doc__)
    parser.add_argument("folders", nargs="+", metavar="folder",
                        help="output folders of slide; the first is held against")
    parser.add_argument("--window", action=Window, metavar=("FROM", "TO"), help="times of means and spectra, s")
    parser.add_argument("--point", type=int, default=0, help="probe point of the phase portraits (default 0)")
    parser.add_argument("--picture", help="image to write; the ending chooses the format")
    asked = parser.parse_args(arguments)
    runs = read_all(asked.folders, asked.window, asked.point)
    print(text(runs))
    if asked.picture:
        from slipscale.pictures import compared
        from slipscale.pictures.drawing import save
        save(parser, asked.picture, lambda: compared.draw(runs))
    return 0
