"""Collects the study in one table, a row for each run of each knob with its errors and its costs; run by the Snakefile."""

from pathlib import Path

from slipscale.reading.yaml_file import load
from slipscale.running.studies import started_by_snakemake
from slipscale.running.table import run_name, write_csv
from tradeoff.errors import costs_of, errors_of, measured
from tradeoff.knobs import groups_of, reference_of

job = started_by_snakemake(globals())
config = job.params.config
folders, relocalised = ({Path(outcome).parent.name: Path(outcome).parent for outcome in outcomes}
                        for outcomes in (job.input.runs, job.input.relocalised))


def ended(folder):
    return load(folder / "outcome.yaml", written=True)


def row_of(case, knob, run):
    """A failed run keeps its reason; one whose reference failed has no errors."""
    name = run_name(run)
    put_back = relocalised.get(name)
    last = ended(put_back or folders[name])
    row = {**run, "knob": knob, "run": name, **{entry: last[entry] for entry in ("status", "reason")}}
    if last["status"] != "ok":
        return row
    window = tuple(float(time) for time in config["cases"][case]["window"])
    row.update(measured(folders[name], window, put_back),
               **costs_of(folders[name], ended(folders[name]), [(put_back, last)] if put_back else []))
    reference = reference_of(config, run) if knob in config["knobs"] else {**run, "model": "whole"}
    other = folders.get(run_name(reference))
    if other is not None and ended(other)["status"] == "ok":
        row.update(errors_of(folders[name], other, window, put_back), reference=other.name)
    return row


write_csv(job.output[0], [row_of(case, knob, run) for (case, knob), runs in groups_of(config).items() for run in runs])
