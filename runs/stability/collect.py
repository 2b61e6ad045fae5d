"""Collects the study in tables: what slide shows beside what modes predict, the points of the other studies with what was
expected there, and the pairs of modes of composites and homogenised blocks; run by the Snakefile."""

from pathlib import Path

import numpy as np

from slipscale.measuring.growth import seen
from slipscale.measuring.pairing import pairs_of
from slipscale.measuring.regime import costs
from slipscale.mistakes import Mistake
from slipscale.reading.modes import Modes
from slipscale.reading.yaml_file import load
from slipscale.run import Run
from slipscale.running.studies import started_by_snakemake
from slipscale.running.table import collect, run_name, write_csv
from stability.predicted import cycle_takes, expected, growing, rival

MOST, FEWEST = 600, 200  # rows in which growth is looked for: five periods of the slowest squeal at the least
MARGIN = 30  # rows, a period, before a node is seen to open

job = started_by_snakemake(globals())
out = Path(job.params.out)


def modes_of(options):
    """The Modes of a point, or None where the program failed."""
    folder = out / "modes" / run_name(options)
    if load(folder / "outcome.yaml", written=True)["status"] != "ok":
        return None
    return Modes(folder)


def shown(folder):
    """Of a run of slide: the strongest vibration of its longest linear stretch beside the mode that is nearest."""
    row = dict(costs(folder))
    modes = modes_of(load(folder / "outcome.yaml", written=True)["options"])
    if modes is None or not modes.modes:
        return {**row, "status": "failed", "reason": "its modes were not found"}
    grow = growing(modes.modes)
    row.update(closed=int(modes.state["nodes_in_contact"]), opened=int(modes.state["nodes_open"]), growing=len(grow))
    run = Run(folder)
    contact = run.contact
    found = seen(contact, float(run.options["parameters_rise"]), MOST, fewest=FEWEST, margin=MARGIN)
    if found is None:
        return {**row, "reason": f"no {FEWEST} rows on end in which the same nodes touch and all of them slip"}
    exponents, rows = found
    strongest = exponents.p[0]
    mode = min(modes.modes, key=lambda mode: abs(mode.scheme_p - strongest))
    return {**row, "from": float(contact.time[rows.start]), "to": float(contact.time[rows.stop - 1]),
            "fastest": modes.modes.index(mode) + 1,
            "growth_seen": strongest.real, "frequency_seen": strongest.imag / (2 * np.pi),
            "growth_modes": mode.growth_rate, "frequency_modes": mode.frequency,
            "growth_scheme": mode.scheme_growth_rate, "frequency_scheme": mode.scheme_frequency,
            "closed_seen": int((contact.status[rows.start] > 0).sum())}


def in_map(point):
    """A point of the sweep: what was seen, the modes that grow, and which of them the limit cycle takes."""
    row = {name: value for name, value in point.items() if name != "options"}
    row.update(time=point["options"]["time"], status="ok", reason=None)
    modes = modes_of(point["options"])
    if modes is None:
        return {**row, "status": "failed", "reason": "its modes were not found"}
    grow = growing(modes.modes)
    row.update(growing=len(grow), fastest=grow[0][0] if grow else None, growth=grow[0][1] if grow else None,
               rival=rival(grow) if grow else None,
               least_damped=None if grow or not modes.modes else modes.modes[0].growth_rate,
               takes=cycle_takes(row["frequency"], grow) if grow and row["frequency"] else None)
    return row


def in_words(grow):
    return " + ".join(f"{frequency / 1e3:.0f} ({rate / 1e3:.0f})" for frequency, rate in grow[:3]) or "-"


def judged(point):
    """A point of the study of equivalence: what was expected beside the verdict."""
    row = {name: value for name, value in point.items() if name not in ("composites", "homogenised")}
    row.update(time=point["composites"][0]["time"], status="ok", reason=None)
    bodies = [[modes_of(options) for options in point[kind]] for kind in ("composites", "homogenised")]
    if any(modes is None for side in bodies for modes in side):
        return {**row, "status": "failed", "reason": "its modes were not found"}
    grown = [[growing(modes.modes) for modes in side] for side in bodies]
    row.update(expected=expected(*grown), composite_modes="; ".join(map(in_words, grown[0])),
               homogenised_modes="; ".join(map(in_words, grown[1])),
               rival=max((rival(grow) for side in grown for grow in side if grow), default=0.0))
    return row


def paired(point):
    """Rows of the modes of each composite that grow and their partners in the homogenised block."""
    block = modes_of(point["homogenised"][0])
    for options in point["composites"]:
        modes = modes_of(options)
        if modes is None or block is None:
            continue
        for pair in pairs_of(modes, block):
            if pair.one.growth_rate > 0:
                yield {"block": options["block"], "seed": options["seed"], "coefficient": options["coefficient"],
                       "time": options["time"], "frequency": pair.one.frequency, "growth": pair.one.growth_rate,
                       "likeness": pair.likeness,
                       "frequency_homogenised": pair.other.frequency if pair.other else None,
                       "growth_homogenised": pair.other.growth_rate if pair.other else None}


def distinct(points):
    """One of the points of each block, coefficient and time: the load does not change the modes."""
    return {tuple(point["composites"][0].values()): point for point in points}.values()


write_csv(job.output.growth, collect(job.input.runs, shown))
write_csv(job.output.swept, [in_map(point) for point in job.params.swept])
write_csv(job.output.judged, [judged(point) for point in job.params.judged])
pairs = []
for point in distinct(job.params.judged):
    try:
        pairs += paired(point)
    except Mistake as mistake:
        pairs.append({"reason": str(mistake)})
write_csv(job.output.pairs, pairs or [{"reason": "no points"}])
