"""Writes scene.yaml and block.yaml of a scene; run by the Snakefile."""

from pathlib import Path

import yaml

from slipscale.running.attempt import write_whole
from slipscale.running.studies import started_by_snakemake

job = started_by_snakemake(globals())
for path, options in ((job.output.scene, job.params.scene), (job.output.recipe, job.params.recipe)):
    write_whole(Path(path), yaml.safe_dump(dict(options), sort_keys=False))
