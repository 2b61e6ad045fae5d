"""Collects the runs of the study, a row for each, and the points at which composites and homogenised blocks were both
run, a row with the verdict for each; run by the Snakefile."""

from pathlib import Path

from equivalence.verdict import points
from slipscale.measuring.regime import costs, measures
from slipscale.reading.yaml_file import load
from slipscale.running.studies import started_by_snakemake
from slipscale.running.table import collect, write_csv

job = started_by_snakemake(globals())
windows = {name: [float(end) for end in window] for name, window in job.params.windows.items()}


def window_of(folder):
    return windows[load(folder / "outcome.yaml", written=True)["options"]["window"]]


rows = collect(job.input.outcomes, lambda folder: {**measures(folder, window_of(folder)), **costs(folder)})
write_csv(job.output.runs, rows)
write_csv(job.output.points, points(rows, [Path(outcome).parent for outcome in job.input.outcomes], windows))
