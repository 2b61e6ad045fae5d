"""Collects the study in one table: a row for each run, and for each level of an adaptation; run by the Snakefile."""

from pathlib import Path

from contrast.adapted import adapted_rows
from slipscale.measuring.distance import spectrum_distance
from slipscale.measuring.regime import costs, friction_spectrum, measures
from slipscale.reading.effective import SIX, read_effective
from slipscale.running.studies import started_by_snakemake
from slipscale.running.table import collect, write_csv

job = started_by_snakemake(globals())
window = [float(time) for time in job.params.window]


def result(folder):
    """Of a homogeneous run the stiffness too, and the distance of its spectrum from that of its heterogeneous run."""
    outcome = str(folder / "outcome.yaml")
    found = {**measures(folder, window), **costs(folder)}
    if effective := job.params.effective.get(outcome):
        stiffness = read_effective(effective)
        truth = Path(job.params.truth[outcome]).parent
        found.update({name: stiffness[name] for name in SIX})
        if (truth / "summary.yaml").is_file():
            found["spectrum_distance"] = spectrum_distance(friction_spectrum(folder, window),
                                                           friction_spectrum(truth, window))
    return found


write_csv(job.output[0], [*collect(job.input.runs, result),
                          *(row for path in job.input.adaptations for row in adapted_rows(path))])
