"""Says in Markdown what the table of the sweep holds; run by the Snakefile."""

from slipscale.reports.publish import publish
from slipscale.reports.sweep_report import report
from slipscale.running.studies import started_by_snakemake
from slipscale.running.table import read_csv

job = started_by_snakemake(globals())
publish(report(read_csv(job.input.table), job.params.compared), job.output[0], job.params.readme, [job.input.picture])
