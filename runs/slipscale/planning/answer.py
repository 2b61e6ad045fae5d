"""The answer of a plan: the proposed mesh is drawn and tried for a moment, and everything is said as text, plan.yaml, a
scene that runs as it stands, and a picture."""

import math
from dataclasses import dataclass, replace

import yaml

from slipscale.adapting.adapt import plain
from slipscale.adapting.trials import SELDOM
from slipscale.mistakes import Mistake
from slipscale.planning import costs, pilots
from slipscale.planning.case import OUTPUTS
from slipscale.planning.picture import draw
from slipscale.planning.proposal import LONGEST
from slipscale.planning.said import DISK_SPREAD, MEMORY_SPREAD, command_of, end_of, percent, said_of, text_of
from slipscale.reading import History, Summary
from slipscale.running.attempt import write_whole
from slipscale.running.commands import word

TRIED = 0.01  # of the steps of the run, twice and four times that: what its seconds are told from
LEAST_TRIED = 0.3  # s
KNOWN_AS_WELL = 0.15  # relative: seconds of a run that was tried for a moment, on a machine with nothing else to do
WORTH_SINGLE = 0.9  # of the seconds: single storage that saves less is not proposed


@dataclass
class Proposal:
    """What is proposed, after its mesh was drawn and tried: steps, step s, seconds and their relative spread; memory,
    disk B; storage; single: seconds with single storage over those with double, or None."""

    best: object
    mesh: object
    step: float
    steps: int
    seconds: float
    spread: float
    memory: float
    disk: float
    storage: str
    single: float | None

    @property
    def node_steps(self):
        return self.mesh.nodes * self.steps


def scene_options(planning, best, mesh):
    """Options of slide of the proposed run."""
    found = dict(planning.case.scene_of(best.windows, planning.workshop.interval))
    found = pilots.with_stress(found, planning.workshop.regions, (planning.case.window[0], found["time_end"]),
                               planning.case.is_strip)
    found.update(time_step="auto", time_safety=best.safety, mesh_file=str(mesh.folder / "mesh.msh"))
    return found


def tried(planning, options, steps, storage, folder):
    """Seconds and outcome of so many steps of the proposed run."""
    kept = {name: value for name, value in options.items() if not name.startswith(OUTPUTS)}
    step = options["_step"]
    kept.update(time_end=float(f"{steps * step:.9g}"), contact_every=SELDOM, progress="none", stiffness_storage=storage,
                output_folder=folder, history_interval=max(float(kept["history_interval"]), 1.05 * step))
    kept.pop("_step")
    return pilots.started(kept, folder)


def per_step(planning, options, steps, storage):
    """(start s, s a step, the longer outcome and its folder): from two short runs, by the steps that they took, whose step
    is not quite the expected one."""
    folders = [planning.out / "pilots" / "tried" / f"{storage}-{count}" for count in (steps, 4 * steps)]
    outcomes = [tried(planning, options, count, storage, folder) for count, folder in zip((steps, 4 * steps), folders)]
    if failed := next((one for one in outcomes if one["status"] != "ok"), None):
        raise Mistake(f"the proposed run does not start: {failed['reason']}")
    few, many = (int(Summary(folder).headline["steps"]) for folder in folders)
    slope = max(1e-9, (outcomes[1]["cpu_seconds"] - outcomes[0]["cpu_seconds"]) / (many - few))
    return max(0.0, outcomes[0]["cpu_seconds"] - few * slope), slope, outcomes[1], folders[1]


def proposal_of(planning):
    """The Proposal: its mesh drawn, seconds and memory from a moment of the run itself where that is worth it."""
    best, case = planning.best, planning.case
    mesh = planning.workshop.mesh(best.cell, best.h, folder=planning.out / "mesh")
    if mesh.reason:
        raise Mistake(f"the proposed mesh cannot be drawn: {mesh.reason}")
    options = {**scene_options(planning, best, mesh), "_step": best.step}
    count = max(200, int(TRIED * best.steps), int(LEAST_TRIED / (best.seconds / best.steps)))
    count = min(count, max(200, int(best.steps / 20)))
    storage = str(case.scene.get("stiffness_storage", "double"))
    start, slope, outcome, folder = per_step(planning, options, count, storage)
    facts = Summary(folder).options["run"]
    step = float(facts["stable_step"]) * best.safety
    steps = math.ceil(options["time_end"] / step)
    seconds, spread = start + steps * slope, KNOWN_AS_WELL
    single = None
    if storage == "double" and seconds > 60:
        quick = per_step(planning, options, count, "single")
        single = (quick[0] + steps * quick[1]) / seconds
        if single < WORTH_SINGLE:
            storage, seconds = "single", seconds * single
    finest = min(planning.pilots, key=lambda pilot: pilot.h)
    rows = len(History(finest.folder).time)
    row = (finest.folder / "history.h5").stat().st_size / rows
    disk = costs.disk(options, mesh.nodes, float(case.recipe["block_width"]) / best.h + 1, options["time_end"], step, row)
    disk += (mesh.folder / "mesh.msh").stat().st_size
    return Proposal(best, replace(mesh, nodes=int(facts["nodes"])), step, steps, seconds, spread,
                    outcome.get("peak_memory", 0) + costs.ROW_IN_MEMORY * options["time_end"] /
                    options["history_interval"], disk, storage, single)


def rows_of_pilots(planning):
    return [{"role": pilot.role, "cell": pilot.cell, "size": pilot.h, "safety": pilot.safety, "seed": pilot.seed,
             "nodes": pilot.mesh.nodes, "step": pilot.step, "seconds": pilot.cost, "settled": bool(pilot.settled),
             "regime": pilot.regime, "frequency": pilot.frequency,
             "values": {name: {"value": float(value), "error": float(error)}
                        for name, (value, error) in pilot.values.items()}} for pilot in planning.pilots]


def dumped(found):
    return yaml.safe_dump(plain(found), sort_keys=False, allow_unicode=True, width=120)


def write_refusal(planning, reason):
    planning.out.mkdir(parents=True, exist_ok=True)
    write_whole(planning.out / "plan.yaml", dumped({
        "status": "refused", "reason": reason, "wishes": [str(wish) for wish in planning.wishes],
        "left_out": planning.left_out, "pilots": rows_of_pilots(planning)}))


def write(planning, seconds):
    """Writes plan.yaml, scene.yaml, plan.png; gives the text."""
    found, best = proposal_of(planning), planning.best
    scene = {name: value for name, value in scene_options(planning, best, found.mesh).items()}
    scene.update(stiffness_storage=found.storage, output_folder=str(planning.out / "run"))
    window = (planning.case.window[0], end_of(planning))
    head = (f"# Proposed by slipscale plan: {', '.join(map(str, planning.wishes))}. From where the plan was made:\n"
            f"#   {command_of(planning)}\n"
            f"# Averages belong to {window[0]:g} to {window[1]:g} s.\n")
    write_whole(planning.out / "scene.yaml", head + "".join(
        f"{name}: {value if isinstance(value, str) else number(value)}\n" for name, value in sorted(scene.items())))
    told = {wish.name: said_of(planning, wish)[1] for wish in planning.wishes}
    write_whole(planning.out / "plan.yaml", dumped({
        "status": "ok", "wishes": [str(wish) for wish in planning.wishes], "budget": planning.budget,
        "all_wishes_hold": bool(planning.kept_all or not planning.asked.want), "results": told,
        "proposal": {"cell": best.cell, "size": best.h, "safety": best.safety, "step": found.step, "steps": found.steps,
                     "nodes": found.mesh.nodes, "node_steps": found.node_steps, "storage": found.storage,
                     "window": list(window), "windows": best.windows, "seconds": found.seconds,
                     "seconds_spread": found.spread, "memory": found.memory, "memory_spread": MEMORY_SPREAD,
                     "disk": found.disk, "disk_spread": DISK_SPREAD, "single_over_double": found.single},
        "pilot_seconds": planning.spent, "pilot_seconds_announced": planning.announced, "left_out": planning.left_out,
        "pilots": rows_of_pilots(planning)}))
    draw(planning, found, planning.out / "plan.png")
    return text_of(planning, found, seconds)


def number(value):
    """For YAML that the programs read too: lists flat, numbers with a point."""
    if isinstance(value, float):
        text = f"{value:.9g}"
        return text if "e" not in text or "." in text else text.replace("e", ".0e")
    return word(value)


def out_of_reach(planning):
    """Why no candidate keeps the wishes, and what would help."""
    nearest = planning.search.best(planning.budget or LONGEST)
    if nearest is None:
        return (f"nothing runs in {planning.budget:g} s: the cheapest run takes "
                f"{planning.search.possible(math.inf)[0].seconds:.3g} s; a larger budget helps")
    name = max(planning.search.fits, key=lambda name: nearest.bounds[name] / planning.search.allowed[name])
    fit = planning.results[name].fit
    mesh = fit.bound(nearest.h, nearest.step, nearest.number, 1e9)
    scatter = 1.96 * fit.time_scatter(nearest.windows)
    return (f"no mesh keeps {name} within {percent(planning.search.allowed[name])} in {planning.budget or LONGEST:g} s: what "
            f"comes nearest, {nearest.cell} of {1e6 * nearest.h:.4g} µm with {nearest.windows:g} windows, is within "
            f"{percent(nearest.bounds[name])}, of which mesh and step may be off by {percent(mesh)} and the window by "
            f"{percent(scatter)}. " + ("A longer window helps, or a wider wish" if scatter > mesh else
                                       "More pilot time helps, --pilots, for the order is not known better, or a wider "
                                       "wish"))


if __name__ == "__main__":
    raise SystemExit("slipscale.planning.answer is a library, no command: slipscale -h lists the commands.")
