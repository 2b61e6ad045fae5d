"""The page of one run of `slide`."""

import shlex
from pathlib import Path

import numpy as np

from slipscale.measuring.averages import with_error
from slipscale.measuring.regime import measures
from slipscale.measuring.window import FEWEST_FOR_MEANS, choose_window
from slipscale.mistakes import Mistake
from slipscale.pictures.picture import draw
from slipscale.reports import html
from slipscale.reports.commented_yaml import group_of, rows_of
from slipscale.run import Run

SOUND_RESIDUAL = 1e-9  # of the energy that flowed: rounding stays far below


def run_page(folder):
    run = Run(folder)
    body = [f"<h1>{html.text(Path(folder).resolve().name)}</h1>", f'<p class="lead">{html.text(lead(run))}</p>',
            html.warnings(warnings(run)), html.cards(headline(run)), picture(folder),
            html.section("To repeat it, from the folder in which the run was started",
                         f"<pre>{html.text(command(run))}</pre>"),
            html.section("Numbers", html.table(rows_of(run.folder / "summary.yaml"))),
            html.section("Energy ledger at the end, J per metre of depth", html.table(ledger(run))),
            html.section("Mesh and step", html.table(group_of(run.folder / "run.yaml", "run"))),
            html.section("Every option in effect", '<div class="columns">' + html.table(
                rows_of(run.folder / "run.yaml", without=("run",))) + "</div>")]
    return html.document(f"slipscale: {Path(folder).resolve().name}", "\n".join(part for part in body if part),
                         f"slide {run.facts.get('version', '')}; all quantities in SI units")


def lead(run):
    reached, planned = run.time[-1], number(run.options.get("time_end"))
    text = f"{reached * 1e6:.4g} µs of sliding contact"
    if run.facts:
        ranks = run.facts.get("ranks")
        text += f", {run.facts.get('nodes')} nodes, {ranks} rank{'' if ranks == 1 else 's'}"
    if not run.summary:
        text += f"; the run has not ended (planned: {planned * 1e6:.4g} µs)" if planned else "; the run has not ended"
    return text


def number(value):
    try:
        return float(value)
    except (TypeError, ValueError):
        return None


def headline(run):
    """Cards of number and meaning: what the rows of the window tell."""
    try:
        begin, end = choose_window(run.time, None, FEWEST_FOR_MEANS)
        found = measures(run.folder, (begin, end), fewest=FEWEST_FOR_MEANS)
    except Mistake:
        return []

    def mean(name, factor=1):
        error = found[f"{name}_error"]
        return with_error(factor * found[name], np.nan if error is None else factor * error)

    frequency = {None: "not known", 0.0: "none"}.get(found["frequency"]) or f"{found['frequency'] / 1e3:.4g} kHz"
    return [(mean("friction"), "mean tangential over mean normal force"),
            ("yes" if found["settled"] else "NO", f"settled; amplitude ratio {found['amplitude_ratio']:.3g}, second "
                                                  "half of the window over first"),
            (found["regime"], "regime"), (frequency, "strongest frequency of friction"),
            *((f"{mean(state, 100)} %", f"of the contact {says}")
              for state, says in (("stick", "sticks"), ("slip", "slips"), ("open", "is open"))),
            (f"{mean('normal_force', 1e-3)} kN/m", "mean normal force"),
            (f"{begin * 1e6:.4g} to {end * 1e6:.4g} µs", "window of these numbers; ± are standard errors")]


def warnings(run):
    said = [str(note) for note in listed(run.summary.get("notes")) + listed(run.summary.get("aliases"))]
    residual = number((run.summary.get("energy") or {}).get("largest_relative_residual"))
    if residual is not None and not abs(residual) <= SOUND_RESIDUAL:
        said.append(f"The energy balance misses {residual:.1e} of what flowed: more than rounding.")
    try:
        found = run.settling()
        if not found.settled:
            said.append("The run had not settled: from the first half of the window to the second the amplitude of "
                        "friction "
                        f"changes by the factor {found.amplitude_ratio:.3g} and its mean by {100 * found.drift:+.2g} "
                        "%, so its averages belong to this window only.")
    except Mistake:
        pass  # too few rows, as stands in the place of the picture
    return said


def listed(value):
    if isinstance(value, dict):  # note_1, note_2, …
        return list(value.values())
    return value if isinstance(value, list) else [value] if value else []


def picture(folder):
    try:
        return html.figure(draw(folder), "the run at a glance")
    except Mistake as reason:
        return html.warnings([str(reason)])


def command(run):
    ranks = run.facts.get("ranks", 1)
    folder = run.folder.resolve()
    words = ["slide", "-options_file_yaml", str(folder / "run.yaml"), "-output_folder", f"{folder}-again"]
    return shlex.join((["mpirun", "-n", str(ranks)] if ranks and int(ranks) > 1 else []) + words)


def ledger(run):
    return [(name.replace("_", " "), f"{values[-1]:.6g}", f"largest magnitude {np.max(np.abs(values)):.3g}")
            for name, values in run.energy.items()]
