"""Collects the runs of the study in one table; run by the Snakefile."""

from slipscale.reading.effective import read_effective, relative_errors, square_symmetric
from slipscale.running.studies import started_by_snakemake
from slipscale.running.table import collect, write_csv


def result(folder, reference):
    found = read_effective(folder)
    moduli = square_symmetric(found)
    return {**{name: value for name, value in found.items() if not name.startswith("C")}, **moduli,
            **relative_errors(moduli, reference)}


job = started_by_snakemake(globals())
write_csv(job.output[0],
          collect(job.input.outcomes, lambda folder: result(folder, job.params.reference)))
