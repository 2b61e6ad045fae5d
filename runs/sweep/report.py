"""Says in Markdown what the table of the sweep holds; run by the Snakefile."""

from analysis.report import publish
from analysis.sweep_report import report
from analysis.table import read_csv

job = snakemake  # noqa: F821
publish(report(read_csv(job.input.table), job.params.compared), job.output[0], job.params.readme, [job.input.picture])
