"""Says in Markdown what the table of the study holds, for the README; run by the Snakefile."""

from refinement.findings import report
from slipscale.reports.publish import publish
from slipscale.running.studies import started_by_snakemake
from slipscale.running.table import read_csv

job = started_by_snakemake(globals())
publish(report(read_csv(job.input.table), job.params.unfolded), job.output[0], job.params.readme, job.params.shown,
        others=job.input.pictures)
