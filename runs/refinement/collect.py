"""Collects the runs of the study in one table, a row for each number of each run; run by the Snakefile."""

from pathlib import Path

from refinement.orders import found_in, summary_rows
from refinement.refined import average_rows, distance_rows
from refinement.sequences import chains
from slipscale.measuring.regime import costs
from slipscale.reading import UnreadableRun, read_yaml
from slipscale.running.studies import started_by_snakemake
from slipscale.running.table import run_name, write_csv

DRAWN = ("inclusions", "moved", "redrawn", "dropped")  # of morphology's report


def drawing(mesh):
    """What `morphology` drew, to see whether all sizes have the same drawing; empty for other meshes."""
    report = read_yaml(mesh / "morphology.yaml").get("run", {})
    parts = report.get("fraction", {})
    return {**{name: report[name] for name in DRAWN if name in report},
            **({"inclusion_fraction": 1 - parts["matrix"]} if len(parts) > 1 and "matrix" in parts else {})}


class Runs:
    """Folders and outcomes of the runs below `out`; `meshes` names the mesh of each."""

    def __init__(self, out, meshes):
        self.out, self.meshes = Path(out), meshes

    def folder(self, run):
        return self.out / "run" / run_name(run)

    def outcome(self, run):
        return read_yaml(self.folder(run) / "outcome.yaml")

    def costs(self, run):
        found = costs(self.folder(run))
        return {**{name: found[name] for name in ("nodes", "steps", "node_steps", "energy_residual")},
                "step": found["step"] if run["step"] == "auto" else run["step"],
                "seconds": self.outcome(run)["cpu_seconds"]}


def reference_of(chain):
    """Size or step of the reference, and whether it belongs to the same refinement (1) or to another (0)."""
    same = {**chain.reference, "size": None, "step": None} == {**chain.runs[-1], "size": None, "step": None}
    h = chain.reference[chain.along]
    return {"reference_h": None if h == "auto" else h, "reference_own": int(same)}


def rows_of(chain, run, runs):
    """A failed run has one row with its reason, and so has one that cannot be compared."""
    entries, point = chain.entries, int(chain.entries.get("point", 0))
    row = {"sequence": chain.name, "variant": chain.variant, "along": chain.along, "scene": run["scene"],
           "family": run["family"], "size": run["size"], "step": run["step"], "status": "ok", "reason": None,
           "quantity": None, "run": run_name(run)}
    outcome = runs.outcome(run)
    if outcome["status"] != "ok":
        return [{**row, "status": "failed", "reason": outcome["reason"]}]
    try:
        row.update(runs.costs(run), **drawing(runs.out / "mesh" / runs.meshes[run_name(run)]))
        known = {name: float(value) for name, value in (entries.get("known") or {}).items()}
        found = [{**row, **each, "known": known.get(each["quantity"])} for each in average_rows(
            runs.folder(run), entries["window"], entries["averages"], point, int(entries.get("parts", 4)))]
    except UnreadableRun as error:
        return [{**row, "status": "failed", "reason": str(error)}]
    if run == chain.reference or not (entries["trajectories"] or entries["distances"]):
        return found or [row]
    reference = runs.outcome(chain.reference)
    try:
        if reference["status"] != "ok":
            raise UnreadableRun(f"the reference run failed: {reference['reason']}")
        distances = distance_rows(runs.folder(run), runs.folder(chain.reference), entries["window"],
                                  entries["trajectories"], entries["distances"], point)
    except UnreadableRun as error:
        return [*found, {**row, "status": "failed", "reason": str(error)}]
    return [*found, *({**row, **each, **reference_of(chain)} for each in distances)]


job = started_by_snakemake(globals())
runs = Runs(job.params.out, job.params.meshes)
table = [row for chain in chains(job.params.sequences) for run in chain.runs for row in rows_of(chain, run, runs)]
write_csv(job.output.table, table)
write_csv(job.output.orders, summary_rows(found_in(table)))
