"""Pilot runs: which, what they will cost, and running them. Each in a folder of its own, once: what was run before with the
same command is kept."""

import os
import shlex
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass, field, replace
from pathlib import Path

from slipscale.adapting.trials import SELDOM, Trials
from slipscale.mistakes import Mistake
from slipscale.planning.case import OUTPUTS, with_stress
from slipscale.planning.costs import Price
from slipscale.reading import Summary, read_yaml
from slipscale.running import programs
from slipscale.running.attempt import attempt
from slipscale.running.commands import words

RATIO = 2.0**-0.5  # of successive sizes
DRAWN = ("inclusions", "moved", "redrawn", "dropped")
RUNS = Path(__file__).resolve().parents[2]
SIZES, OTHER_SIZES, OTHER_SEEDS = 4, 3, 3
FEW_STEPS = 50
MOST_HALVINGS = 7  # of the area of a cell, until a mesh shows what is drawn
STEPS = (0.5, 0.25)  # parts of the scene's own safety, on the coarsest mesh


@dataclass
class Mesh:
    """What morphology reported: nodes, step_length m, what was drawn; reason why there is none."""

    folder: Path
    nodes: int = 0
    step_length: float = 0.0
    drawn: tuple = ()
    reason: str | None = None


@dataclass
class Pilot:
    """role: size, step or morphology. step: expected, s, and what it was once it has run. cost: expected, s."""

    role: str
    cell: str
    h: float
    safety: float
    seed: int | None
    mesh: Mesh
    step: float
    cost: float
    folder: Path = None
    outcome: dict = field(default_factory=dict)
    values: dict = field(default_factory=dict)
    settled: bool = True
    regime: str = ""
    frequency: float = 0.0

    @property
    def ok(self):
        return self.outcome.get("status") == "ok"

    @property
    def name(self):
        seed = "" if self.seed is None else f"_seed{self.seed}"
        return f"{self.cell}_{1e6 * self.h:.4g}um_{self.safety:.4g}{seed}"


class Workshop:
    """Draws meshes and runs pilots of a Case below the folder `out`; `jobs` at a time. wishes decide what is written."""

    def __init__(self, case, out, regions=(), jobs=1):
        self.case, self.out, self.regions, self.jobs = case, Path(out), regions, jobs
        self.price, self.meshes, self.longest_step = Price(), {}, 0.0
        self.longer = {}  # by kind of cells: the stable step over the one that the largest element allows

    # --- meshes

    def mesh(self, cell, size, seed=None, folder=None):
        """The Mesh, drawn or kept from before."""
        recipe = self.case.recipe_of(cell, size, seed)
        name = f"{cell}_{1e6 * size:.4g}um" + ("" if seed is None else f"_seed{seed}")
        folder = Path(folder or self.out / "pilots" / "mesh" / name)
        if folder in self.meshes:
            return self.meshes[folder]
        command = [str(programs.program("morphology")), *shlex.split(words({**recipe, "output_folder": folder}))]
        outcome = kept(folder, command) or attempt(folder / "outcome.yaml", command)
        if outcome["status"] != "ok":
            self.meshes[folder] = Mesh(folder, reason=outcome["reason"])
            return self.meshes[folder]
        report = read_yaml(folder / "morphology.yaml")["run"]
        self.meshes[folder] = Mesh(folder, int(report["nodes"]), float(report["step_length"]),
                                   tuple(report.get(name, 0) for name in DRAWN))
        return self.meshes[folder]

    # --- what a run costs

    def calibrate(self, cell, mesh):
        """From a few steps on a coarse mesh: the stable step is longer than that of the largest element, the more the
        fewer cells are small or stiff."""
        expected = self.case.step_of(mesh.step_length, self.case.safety)
        end = float(f"{FEW_STEPS * expected:.6g}")
        folder = self.out / "pilots" / "step" / cell
        kept = {name: value for name, value in self.case.scene_of().items() if not name.startswith(OUTPUTS)}
        kept.update(time_end=end, time_safety=self.case.safety, history_interval=end, contact_every=SELDOM, progress="none",
                    mesh_file=mesh.folder / "mesh.msh", output_folder=folder)
        outcome = started(kept, folder)
        if outcome["status"] != "ok":
            raise Mistake(f"the scene does not run on a mesh that the recipe gives: {outcome['reason']}")
        stable = float(Summary(folder).options["run"]["stable_step"])
        self.longer[cell] = stable * self.case.safety / expected

    def step(self, cell, step_length, safety):
        """Expected, s."""
        return self.case.step_of(step_length, safety) * self.longer.get(cell, 1.0)

    def expected(self, cell, mesh, safety, windows=1.0):
        """(step s, steps, seconds) before it is run."""
        step = self.step(cell, mesh.step_length, safety)
        steps = self.case.scene_of(windows)["time_end"] / step
        return step, steps, self.price(mesh.nodes, steps)

    def pilot(self, role, cell, h, safety, seed=None):
        """The Pilot, its mesh drawn; raises Mistake where there is none."""
        mesh = self.mesh(cell, h, seed)
        if mesh.reason:
            raise Mistake(mesh.reason)
        step, _, cost = self.expected(cell, mesh, safety)
        return Pilot(role, cell, h, safety, seed, mesh, step, cost, self.out / "pilots" / "run")

    # --- running

    def options(self, pilot):
        kept = {name: value for name, value in self.case.scene_of(interval=self.interval).items()
                if not name.startswith(OUTPUTS)}
        kept.update(time_safety=pilot.safety, contact_every=SELDOM, progress="none",
                    mesh_file=pilot.mesh.folder / "mesh.msh", output_folder=pilot.folder)
        return with_stress(kept, self.regions, self.case.window, self.case.is_strip)

    @property
    def interval(self):
        return self.case.interval(self.longest_step)

    def run(self, pilot):
        """The pilot with its outcome, step and cost as they were."""
        pilot = replace(pilot, folder=self.out / "pilots" / "run" / pilot.name)
        outcome = started(self.options(pilot), pilot.folder)
        if outcome["status"] == "ok":
            summary = Summary(pilot.folder)
            pilot.step = float(summary.options["run"]["step"])
            pilot.mesh = replace(pilot.mesh, nodes=int(summary.options["run"]["nodes"]))
            pilot.cost = outcome["cpu_seconds"]
        pilot.outcome = outcome
        return pilot

    def run_all(self, pilots, said=lambda text: None):
        """All of them, in their order."""
        with ThreadPoolExecutor(self.jobs) as pool:
            found = []
            for pilot in pool.map(self.run, pilots):
                said(f"  {pilot.name}: {pilot.outcome['cpu_seconds']:.1f} s" +
                     ("" if pilot.ok else f", failed: {pilot.outcome['reason']}"))
                found.append(pilot)
        return found


def kept(folder, command):
    """The outcome of the same command before, if it was a good one: what failed may have done so for a cause that is
    gone."""
    known = Trials.outcome(folder, command)
    return known if known and known["status"] == "ok" else None


def newer(mesh, outcome):
    """Whether a mesh was drawn after a run ended: the run was that of another one."""
    drawn = Path(mesh).parent / "outcome.yaml"
    return drawn.is_file() and drawn.stat().st_mtime_ns > outcome.stat().st_mtime_ns


def started(options, folder):
    """The outcome of `slide` with these options: of the same command on the same mesh before, or by a process that
    measures it alone."""
    command = [str(programs.program("slide")), *shlex.split(words(options))]
    known = kept(folder, command)
    if known and not newer(options["mesh_file"], folder / "outcome.yaml"):
        return known
    folder.mkdir(parents=True, exist_ok=True)
    subprocess.run([sys.executable, "-m", "slipscale.running.attempt", str(folder / "outcome.yaml"), "--", *command],
                   stderr=subprocess.DEVNULL, check=True,
                   env={**os.environ, "PYTHONPATH": str(RUNS), "OMP_NUM_THREADS": "1"})
    return Trials.outcome(folder, command)


def sizes_from(coarsest, count):
    return [coarsest * RATIO**k for k in range(count)]


def plain(mesh):
    """Whether the mesh is there and shows what was drawn, nothing moved or left out."""
    return not mesh.reason and not any(mesh.drawn[1:])


def coarsest_drawn(workshop, top):
    """(size m, meshes by kind of cells): the coarsest size up to `top` at which the first kind shows the drawing as it
    is; the other kinds as they come."""
    case = workshop.case
    for k in range(MOST_HALVINGS):
        size = top * RATIO**k
        if plain(workshop.mesh(case.cells[0], size)):
            break
    drawn = {cell: mesh for cell in case.cells if not (mesh := workshop.mesh(cell, size)).reason}
    if not drawn:
        raise Mistake(f"no mesh of {1e6 * size:.4g} µm can be drawn: {workshop.mesh(case.cells[0], size).reason}")
    return size, drawn


def coarsest_for(workshop, most, top, most_at_all):
    """The coarsest of the sizes so that all first pilots cost at most `most` s: `top`, m, or finer. A pair with their
    price. Meshes of the largest size are drawn: nodes grow as 1/h², steps as 1/h. Where that is more than `most_at_all`,
    only the first kind of cells stays in the case."""
    case = workshop.case
    top, drawn = coarsest_drawn(workshop, top)
    for kind, mesh in drawn.items():
        workshop.calibrate(kind, mesh)
    cell, mesh = next(iter(drawn.items()))

    def price(coarsest):
        total = 0.0
        for k, parts in enumerate(parts_of(case)):
            part = coarsest * RATIO**k / top
            nodes, length = mesh.nodes / part**2, mesh.step_length * part
            steps = case.end / workshop.step(cell, length, case.safety)
            total += parts * workshop.price(nodes, steps)
        return total

    if price(top) > most_at_all and len(case.cells) > 1:
        case.cells = case.cells[:1]
    chosen = top
    while price(chosen * RATIO) <= most:
        chosen *= RATIO
    return chosen, price(chosen)


def parts_of(case):
    """How many runs of the price of the k-th size the first pilots are."""
    first = [1.0] * SIZES
    for k in range(OTHER_SIZES):
        first[k] += 1.3 * (len(case.cells) - 1)
    first[0] += sum(1 / part for part in STEPS) + (OTHER_SEEDS if case.is_random else 0)
    return first


def first_pilots(workshop, coarsest):
    """The pilots, meshes drawn, and sentences about those that are left out."""
    case, found, left_out = workshop.case, [], []
    base = case.safety

    def add(role, cell, h, safety, seed=None):
        try:
            found.append(workshop.pilot(role, cell, h, safety, seed))
        except Mistake as mistake:
            left_out.append(f"{cell} of {1e6 * h:.4g} µm" + (f", seed {seed}" if seed is not None else "") +
                            f": {mistake}")

    for number, cell in enumerate(case.cells):
        for h in sizes_from(coarsest, OTHER_SIZES if number else SIZES):
            add("size", cell, h, base)
    for part in STEPS:
        add("step", case.cells[0], coarsest, base * part)
    if case.is_random:
        own = int(case.recipe.get("seed", 1))
        for k in range(OTHER_SEEDS):
            add("morphology", case.cells[0], coarsest, base, own + 1 + k)
    return same_drawing(found, left_out)


def same_drawing(pilots, left_out):
    """Those whose mesh shows the drawing that most of them show; other seeds have their own."""
    drawn = [pilot.mesh.drawn for pilot in pilots if pilot.seed is None]
    usual = max(set(drawn), key=drawn.count, default=())
    kept = [pilot for pilot in pilots if pilot.seed is not None or pilot.mesh.drawn == usual]
    left_out += [f"{pilot.name}: its mesh shows another drawing ({pilot.mesh.drawn[0]} inclusions, "
                 f"{sum(pilot.mesh.drawn[1:])} of them moved or dropped)" for pilot in pilots if pilot not in kept]
    return kept, left_out


if __name__ == "__main__":
    raise SystemExit("slipscale.planning.pilots is a library, no command: slipscale -h lists the commands.")
