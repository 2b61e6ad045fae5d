"""Collects the study in one table, a row for each wish; run by the Snakefile."""

from pathlib import Path

from plan.kept import judged
from slipscale.measuring.regime import costs
from slipscale.planning.wishes import wishes_of
from slipscale.reading.yaml_file import load
from slipscale.running.studies import started_by_snakemake
from slipscale.running.table import write_csv

job = started_by_snakemake(globals())


def before_of(scene):
    words = str(scene.get("words", "")).split()
    return tuple(map(float, words[words.index("--before") + 1:][:2])) if "--before" in words else None


def rows_of(outcome):
    folder = Path(outcome).parents[1]
    scene, plan = job.params.scenes[folder.name], load(folder / "plan" / "plan.yaml", written=True)
    row = {"scene": folder.name, "status": "ok", "reason": None, "wish": None}
    if plan["status"] != "ok":
        return [{**row, "status": plan["status"], "reason": plan["reason"]}]
    runs = {name: load(folder / name / "outcome.yaml", written=True) for name in ("proposed", "finer")}
    if failed := next((run for run in runs.values() if run["status"] != "ok"), None):
        return [{**row, "status": "failed", "reason": failed["reason"]}]
    proposal = plan["proposal"]
    spent = {"cell": proposal["cell"], "size": proposal["size"], "step": proposal["step"], "windows": proposal["windows"],
             "pilot_seconds_announced": plan["pilot_seconds_announced"], "pilot_seconds": plan["pilot_seconds"],
             "seconds_said": proposal["seconds"], "seconds": runs["proposed"]["cpu_seconds"],
             "seconds_finer": runs["finer"]["cpu_seconds"], "memory_said": proposal["memory"],
             "memory": runs["proposed"]["peak_memory"], "disk_said": proposal["disk"],
             "disk": sum(file.stat().st_size for file in [*(folder / "proposed").iterdir(),
                                                          folder / "plan" / "mesh" / "mesh.msh"]),
             "node_steps_said": proposal["node_steps"], "node_steps": costs(folder / "proposed")["node_steps"],
             "step_finer": costs(folder / "finer")["step"]}
    return [{**row, "wish": wish.name, "wished": plan["results"][wish.name]["wish"],
             "promised": plan["results"][wish.name]["promised"],
             **judged(wish.name, plan["results"][wish.name]["promised"], folder / "proposed", folder / "finer",
                      proposal["window"], before_of(scene)),
             "between_morphologies": plan["results"][wish.name].get("between_morphologies"), **spent}
            for wish in wishes_of(scene["want"])]


write_csv(job.output[0], [row for outcome in job.input.plans for row in rows_of(outcome)])
