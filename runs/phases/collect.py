"""Collects the study in one table: a row for each run, with its distances from the composite that it stands for; run by
the Snakefile."""

from pathlib import Path

from phases.coefficient import coefficient_of_run
from slipscale.measuring.distance import spectrum_distance
from slipscale.measuring.regime import costs, friction_spectrum, measures
from slipscale.running.studies import started_by_snakemake
from slipscale.running.table import collect, write_csv

STILL = 0.01  # amplitude (1) of friction below which nothing vibrates

job = started_by_snakemake(globals())


def result(folder):
    outcome = str(folder / "outcome.yaml")
    window = [float(time) for time in job.params.windows[outcome]]
    found = measures(folder, window)
    found["regime_seen"] = found.pop("regime")
    row = {**found, **costs(folder), "coefficient": coefficient_of_run(folder)}
    composite = Path(job.params.composite[outcome]).parent
    if not (composite / "summary.yaml").is_file():
        return row
    there = measures(composite, window)
    row["friction_off"] = found["friction"] - there["friction"]
    row["frequency_off"] = found["frequency"] / there["frequency"] - 1 if there["frequency"] else None
    if min(found["amplitude"], there["amplitude"]) > STILL:
        row["spectrum_distance"] = spectrum_distance(friction_spectrum(folder, window), friction_spectrum(composite, window))
    return row


write_csv(job.output[0], collect(job.input.runs, result))
