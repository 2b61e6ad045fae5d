"""Which mesh, step and window keep what is wished for, how long that takes, or what a budget buys.

    slipscale plan SCENE.yaml --recipe BLOCK.yaml --want friction:1%,frequency:0.5% [--output out/plan]
    slipscale plan SCENE.yaml --recipe BLOCK.yaml --budget 10min [--want …] [-any_option value …]

A few coarse runs of the scene, their price said before, give for each result its error over size of the cells, step and
kind of cells (a grid fitted to the inclusions, triangles), its scatter over time (blocks of the window) and between
morphologies. From these the cheapest run follows that keeps all wishes in nineteen of twenty cases, or the best that the
budget buys. Left in the output folder: plan.yaml, scene.yaml with its mesh, ready for `slide`, and plan.png.

Results, `name:percent` or `name:value` in their unit: friction, frequency, amplitude, stick, slip, open, displacement,
displacement_deviation, velocity, normal_force, power_into_body, drive_power, power_ratio: averages over --window, by
default the second half of the run. stress_<region>: .99 quantile of the von Mises stress there. spectrum, portrait:
distances. trajectory_displacement, trajectory_velocity, trajectory_normal_force, trajectory_tangential_force: over --before,
while squeal grows.

Errors are those of mesh, step and finite window for the drawing of the recipe; what other drawings do is told beside.
Exit code 0: a proposal; 1: a refusal, with the reason and what would help; 2: what is asked for cannot be read.
"""

import sys
import time
from pathlib import Path

from slipscale.mistakes import Mistake
from slipscale.planning import answer, demands, pilots, refusals, results
from slipscale.planning.asked import parsed, with_changes
from slipscale.planning.case import case_of, options_of
from slipscale.planning.costs import fitted_price, undamped
from slipscale.planning.proposal import LONGEST, Search, scaling_of
from slipscale.planning.wishes import Wish, seconds_of, wishes_of
from slipscale.running import programs
from slipscale.running.sweep_plan import manuals_of

FIRST = 6.0  # s: what the first pilots take, a tenth of a minute
MINUTE = 60.0  # s: a proposed run below it may have pilots of up to as much
TENTH = 0.1
MOST_TIERS = 4
FAR = 2.0  # a proposal that is so many times finer than the finest pilot asks for another
DEFAULT = (Wish("friction", 0.01), Wish("frequency", 0.01))  # of a budget without wishes: equally important


class Refused(Exception):
    """Why nothing is proposed, and what would help; `finer`, whether a finer pilot may do away with it."""

    def __init__(self, reason, finer=False):
        super().__init__(reason)
        self.finer = finer


class Planning:
    def __init__(self, case, wishes, budget, out, asked):
        self.case, self.wishes, self.budget, self.out, self.asked = case, wishes, budget, Path(out), asked
        regions = [wish.name for wish in wishes if wish.kind == "stress"]
        self.workshop = pilots.Workshop(case, out, regions, asked.jobs)
        self.pilots, self.left_out, self.announced = [], [], 0.0
        self.results, self.search, self.best = {}, None, None

    def say(self, text):
        if not self.asked.quiet:
            print(text, flush=True)

    # --- pilots

    def prepare(self):
        """The first pilots, not yet run."""
        case, most = self.case, self.asked.pilots
        if reason := refusals.of_law(case):
            raise Refused(reason)
        top, demanded = case.longest_size()
        if (gap := case.gap()) and "size" not in case.recipe:
            self.say(f"the recipe leaves gap or clearance open, and gives no size that they follow: {gap:.3g} m at all "
                     "sizes")
        if self.workshop.regions:
            _, drawn = pilots.coarsest_drawn(self.workshop, self.asked.sizes or top)
            demands.of_regions(self.wishes, demands.regions_of(next(iter(drawn.values())).folder))
        if given := self.asked.sizes:
            if reason := refusals.of_memory(case, 0, most, top, given):
                raise Refused(reason)
            coarsest = given
        else:
            coarsest, price = pilots.coarsest_for(self.workshop, min(FIRST, most), top, most)
            if reason := refusals.of_memory(case, price, most, top):
                raise Refused(reason)
            if price > most:
                raise Refused(f"the pilot runs alone take about {price:.3g} s of one core, more than {most:.3g}: "
                              f"{demanded} ask for cells of {1e6 * coarsest:.3g} µm. More time for them helps, --pilots "
                              f"{1.2 * price / 60:.3g}min, or a shorter run, -time_end")
        found, self.left_out = pilots.first_pilots(self.workshop, coarsest)
        if not found:
            raise Mistake(f"none of the pilot meshes can be drawn: {self.left_out[0]}")
        if reason := refusals.of_drawing([pilot for pilot in found if (pilot.cell, pilot.role) == (case.cells[0], "size")],
                                         case.cells[0], self.left_out):
            raise Refused(reason)
        return found

    def run(self, wanted):
        """Runs pilots and keeps them with what they gave."""
        self.announced += sum(pilot.cost for pilot in wanted)
        self.workshop.longest_step = self.workshop.longest_step or max(pilot.step for pilot in wanted)
        self.say(announcement(wanted))
        for pilot in self.workshop.run_all(wanted, self.say):
            if pilot.ok:
                self.pilots.append(results.measured(pilot, self.wishes, self.case))
            else:
                self.left_out.append(f"{pilot.name}: {pilot.outcome['reason']}")
        if not self.pilots:
            raise Mistake(f"no pilot run came to its end: {self.left_out[-1]}")
        self.workshop.price = fitted_price([pilot.mesh.nodes for pilot in self.pilots],
                                           [self.case.end / pilot.step for pilot in self.pilots],
                                           [pilot.cost for pilot in self.pilots])

    @property
    def spent(self):
        return sum(pilot.cost for pilot in self.pilots)

    def of(self, cell, role="size"):
        return sorted((pilot for pilot in self.pilots if (pilot.cell, pilot.role) == (cell, role)),
                      key=lambda pilot: (-pilot.h, -pilot.safety))

    # --- what they say

    def judge(self):
        """Fits, and the search over what could be run. Raises Refused."""
        main = self.case.cells[0]
        sizes = self.of(main)
        if reason := refusals.of_drawing(sizes, main, self.left_out):
            raise Refused(reason)
        of_cycle = any(wish.kind != "trajectory" for wish in self.wishes)
        usable = refusals.usable(sizes) if of_cycle else sizes
        if reason := refusals.of_regime(usable, sizes):
            raise Refused(reason, finer=True)
        if of_cycle and (reason := refusals.of_window([pilot for pilot in self.pilots if pilot.role != "morphology"],
                                                      self.case)):
            raise Refused(reason)
        self.passed_over = [pilot for pilot in sizes if pilot not in usable]
        kept, cells = list(usable), [main]
        for cell in self.case.cells[1:]:
            others = [pilot for pilot in self.of(cell) if not of_cycle or refusals.alike(pilot, sizes[-1])]
            if len(others) >= refusals.FEWEST_SIZES:
                kept, cells = kept + others, [*cells, cell]
        if usable[0] is sizes[0]:
            kept += [pilot for pilot in self.of(main, "step") if not of_cycle or refusals.alike(pilot, sizes[-1])]
        self.kept, self.cells = kept, cells
        self.results = results.results(self.wishes, kept, self.of(main, "morphology"), cells, self.case)
        self.search = self.searching()

    def searching(self):
        scalings = {}
        for cell in self.cells:
            of = [pilot for pilot in self.kept if pilot.cell == cell]
            steps = [undamped(pilot.step / pilot.safety, self.case.damping) for pilot in of]
            scalings[cell] = scaling_of([pilot.h for pilot in of], [pilot.mesh.nodes for pilot in of], steps)
        allowed = {wish.name: wish.allowed(self.results[wish.name].size) for wish in self.wishes}
        return Search({name: found.fit for name, found in self.results.items()}, allowed, scalings, self.case,
                      self.workshop.price, max(pilot.h for pilot in self.kept), (self.case.safety,
                      0.5 * self.case.safety))

    def choose(self):
        """The candidate that is proposed, or None: the cheapest that keeps all wishes, within the budget if there is
        one, else what the budget buys."""
        cheapest = self.search.cheapest(self.budget or LONGEST) if self.asked.want else None
        self.kept_all = cheapest is not None
        return cheapest or (self.search.best(self.budget) if self.budget else None)

    def next_tier(self):
        """One mesh more of the first kind, finer than all, or None where it is not worth its price or none is there."""
        main = self.case.cells[0]
        h = self.of(main)[-1].h * pilots.RATIO
        try:
            pilot = self.workshop.pilot("size", main, h, self.case.safety)
        except Mistake:
            return None
        if pilot.mesh.drawn != self.of(main)[0].mesh.drawn:
            return None
        proposed = self.best.seconds if self.best else LONGEST
        after = self.spent + pilot.cost
        allowed = after <= TENTH * proposed or (proposed <= MINUTE and after <= self.asked.pilots)
        if not self.best:
            allowed = after <= self.asked.pilots
        wanted = self.best is None or self.best.h * FAR < self.of(main)[-1].h or pilot.cost < TENTH * proposed
        return pilot if allowed and wanted else None

    def work(self):
        """All of it, or with --dry-run what the pilots take. Raises Refused."""
        first = self.prepare()
        if self.asked.dry_run:
            print("\n".join([announcement(first), *(f"left out: {what}" for what in self.left_out)]))
            return
        self.run(first)
        for _ in range(MOST_TIERS):
            try:
                self.judge()
                self.best, refused = self.choose(), None
            except Refused as reason:
                self.best, refused = None, reason
            more = None if refused and not refused.finer else self.next_tier()
            if more is None:
                break
            self.run([more])
        else:
            self.judge()
            self.best, refused = self.choose(), None
        if refused:
            raise refused
        if not self.best:
            raise Refused(answer.out_of_reach(self))


def announcement(wanted):
    """How many pilots there are, of which sizes, and what they will take."""
    price = sum(pilot.cost for pilot in wanted)
    sizes = ", ".join(f"{pilot.cell} {1e6 * pilot.h:.0f} µm" for pilot in wanted if pilot.role == "size")
    others = [f"{count} {what}" for what, role in (("with shorter steps", "step"), ("of other morphologies", "morphology"))
              if (count := sum(pilot.role == role for pilot in wanted))]
    return f"{len(wanted)} pilot runs, about {price:.2g} s of one core: {'; '.join([sizes, *others])}"


def planning_of(asked, changes):
    """The Planning of a command line. Raises Mistake."""
    manuals = {name: manual for name, manual in manuals_of(programs.folder()).items() if name != "homogenize"}
    scene, recipe = with_changes(options_of(asked.scene), options_of(asked.recipe), changes, manuals)
    wishes = wishes_of(asked.want) if asked.want else list(DEFAULT)
    demands.of_scene(wishes, scene, asked.before)
    case = case_of(scene, recipe, asked.window, asked.before, asked.cells)
    return Planning(case, wishes, seconds_of(asked.budget) if asked.budget else None, asked.output, asked)


def main(arguments=None):
    asked, changes = parsed(sys.argv[1:] if arguments is None else arguments, __doc__)
    planning, begun = planning_of(asked, changes), time.monotonic()
    try:
        planning.work()
    except Refused as reason:
        answer.write_refusal(planning, str(reason))
        print(f"refused: {reason}.")
        return 1
    if not asked.dry_run:
        print(answer.write(planning, time.monotonic() - begun))
    return 0
