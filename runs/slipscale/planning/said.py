"""The answer of a plan in words: of each result, of the proposed run, and how it is started."""

import math
import shlex
from pathlib import Path

from slipscale.planning import refusals
from slipscale.planning.errors import LEVEL
from slipscale.running import programs

DISK_SPREAD, MEMORY_SPREAD = 0.3, 0.15


def percent(value):
    return f"{100 * value:.2g} %"


def said_of(planning, wish):
    """A line, and a dict for plan.yaml."""
    best, found = planning.best, planning.results[wish.name]
    fit, number = found.fit, best.number
    mean, deviation = fit.expected(best.h, best.step, number)
    order, constant = fit.order_of(number), fit.constant_of(number)
    told = {"wish": wish.allowed(found.size), "promised": fit.bound(best.h, best.step, number, best.windows),
            "level": LEVEL, "mesh_and_step": mean, "mesh_and_step_deviation": deviation,
            "scatter_in_time": fit.time_scatter(best.windows), "order": order[0], "order_deviation": order[1],
            "coarsest_mesh": constant[0], "coarsest_mesh_deviation": constant[1],
            "limit": float(fit.limit.mean()) if fit.limit.any() else None,
            "limit_deviation": float(fit.limit.std()) if fit.limit.any() else None}
    line = (f"  {wish.name}: within {percent(told['promised'])} (wished {percent(told['wish'])}); mesh and step "
            f"{100 * mean:+.2g} ± {100 * deviation:.2g} %, over time ± {percent(told['scatter_in_time'])}; order "
            f"{order[0]:.2g} ± {order[1]:.2g}, coarsest mesh {100 * constant[0]:+.2g} ± {100 * constant[1]:.2g} %")
    if found.morphology:
        between = found.morphology[0]
        seeds = max(1, math.ceil((1.96 * between / told["wish"])**2))
        told.update(between_morphologies=between, between_morphologies_deviation=found.morphology[1],
                    morphologies_for_the_mean=seeds)
        line += (f"\n    between morphologies ± {percent(between)}: " +
                 (f"their mean to {percent(told['wish'])} takes {seeds} of them" if seeds > 1 else
                  "one stands for the composite"))
    return line, told


def size_in_words(number, unit):
    for factor, name in ((1e9, "G"), (1e6, "M"), (1e3, "k")):
        if number >= factor:
            return f"{number / factor:.3g} {name}{unit}"
    return f"{number:.3g} {unit}"


def text_of(planning, found, seconds):
    """The answer as text."""
    best, case = planning.best, planning.case
    lines = ["", f"{best.cell} cells of {1e6 * best.h:.4g} µm, {found.mesh.nodes} nodes; step {1e9 * found.step:.4g} ns, "
             f"{best.safety:g} of the limit; storage {found.storage}; window {1e6 * case.window[0]:.4g} to "
             f"{1e6 * end_of(planning):.4g} µs, {best.windows:g} times the scene's",
             f"{size_in_words(found.node_steps, 'node-steps')} in {found.steps} steps: {found.seconds:.3g} ± "
             f"{found.spread * found.seconds:.2g} s of one core, {size_in_words(found.memory, 'B')} ± "
             f"{100 * MEMORY_SPREAD:.0f} % of memory, {size_in_words(found.disk, 'B')} ± {100 * DISK_SPREAD:.0f} % of disk",
             "errors, in nineteen of twenty cases:"]
    lines += [said_of(planning, wish)[0] for wish in planning.wishes]
    if planning.asked.want and not planning.kept_all:
        lines.append(f"The budget of {planning.budget:g} s does not buy all that is wished for; this comes nearest.")
    if found.single:
        lines.append(f"single storage takes {found.single:.2f} of the seconds" +
                     ("" if found.storage == "single" else ": not worth it") + ".")
    if others := otherwise(planning):
        lines.append("other morphologies do otherwise: " + ", ".join(
            f"seed {pilot.seed} {pilot.regime} at {pilot.frequency / 1e3:.0f} kHz" for pilot in others))
    if planning.passed_over:
        lines.append("passed over, another regime than on finer meshes: " +
                     ", ".join(pilot.name for pilot in planning.passed_over))
    lines += [f"left out: {what}" for what in planning.left_out]
    lines += [f"pilot runs took {planning.spent:.3g} s of one core, announced {planning.announced:.3g}; all in "
              f"{seconds:.0f} s", "", f"run it:  {command_of(planning)}",
              f"all of this: {planning.out / 'plan.yaml'}, {planning.out / 'plan.png'}"]
    return "\n".join(lines)


def otherwise(planning):
    """Pilots of other seeds whose regime or frequency is another one; none where no wish is of the cycle."""
    finest = planning.of(planning.cells[0])[-1]
    return [pilot for pilot in planning.of(planning.cells[0], "morphology") if not refusals.alike(pilot, finest)] \
        if any(wish.kind != "trajectory" for wish in planning.wishes) else []


def command_of(planning):
    """What starts the proposed run, with the program that the pilots were run with, as it is found from here."""
    program = programs.program("slide")
    if program.is_relative_to(Path.cwd()):
        program = program.relative_to(Path.cwd())
    return shlex.join([str(program), "-options_file_yaml", str(planning.out / "scene.yaml")])


def end_of(planning):
    return planning.case.scene_of(planning.best.windows)["time_end"]


if __name__ == "__main__":
    raise SystemExit("slipscale.planning.said is a library, no command: slipscale -h lists the commands.")
