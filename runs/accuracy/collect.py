"""Collects the runs of the study in one table; run by the Snakefile."""

from slipscale.reading.effective import read_effective, relative_errors, square_symmetric
from slipscale.running.table import collect, write_csv


def result(folder, reference):
    found = read_effective(folder)
    moduli = square_symmetric(found)
    return {**{name: value for name, value in found.items() if not name.startswith("C")}, **moduli,
            **relative_errors(moduli, reference)}


write_csv(snakemake.output[0],  # noqa: F821
          collect(snakemake.input.outcomes, lambda folder: result(folder, snakemake.params.reference)))  # noqa: F821
