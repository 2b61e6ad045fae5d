"""Collects the study in one table: a row for each run, with its distances from that of the whole composite; run by the
Snakefile."""

from pathlib import Path

from slipscale.measuring.regime import costs, measures
from slipscale.reading.yaml_file import load
from slipscale.running.studies import started_by_snakemake
from slipscale.running.table import collect, write_csv
from strip.missed import distances

job = started_by_snakemake(globals())


def result(folder):
    outcome = str(folder / "outcome.yaml")
    whole = Path(job.params.whole[outcome]).parent
    window = [float(time) for time in job.params.windows[folder.name.split("_")[0]]]
    missed = distances(folder, whole, window, float(job.params.layer)) if (whole / "summary.yaml").is_file() else {}
    found = measures(folder, window)
    found["regime_seen"] = found.pop("regime")
    return {**found, **costs(folder), "seconds": load(folder / "outcome.yaml", written=True)["cpu_seconds"], **missed}


write_csv(job.output[0], collect(job.input.runs, result))
