"""From pilot runs to fitted errors: of each result that is wished for, over size, step and kind of cells."""

from dataclasses import dataclass

import numpy as np

from slipscale.mistakes import Mistake
from slipscale.planning import demands, values
from slipscale.planning.errors import Runs, between, fitted
from slipscale.planning.wishes import DISTANCES

RELATED = 0.5  # a relative distance above this is not small: unrelated signals are √2 apart


@dataclass
class Result:
    """fit: errors.Fitted; size: of relative errors, in the unit of the result (1 of distances); morphology: standard
    deviation between morphologies and its own error, relative, or None."""

    fit: object
    size: float
    morphology: tuple | None = None


def measured(pilot, wishes, case):
    """The pilot with `settled`, `regime`, `frequency`, and `values`: pairs of value and standard error of the averages
    and the stresses that are wished for."""
    pilot.settled, pilot.regime, pilot.frequency = values.settled(pilot.folder, case.window)
    names = [wish.name for wish in wishes if wish.kind == "average"]
    pilot.values = values.averages(pilot.folder, case.window, names)
    for wish in wishes:
        if wish.kind == "stress":
            pilot.values[wish.name] = values.stress(pilot.folder, case.window, values.region_of(wish.name))
    return pilot


def runs_of(pilots, cells, found):
    """errors.Runs of pilots, `found` giving value and error of each."""
    pairs = [found(pilot) for pilot in pilots]
    return Runs([pilot.h for pilot in pilots], [pilot.step for pilot in pilots],
                [cells.index(pilot.cell) for pilot in pilots], [pair[0] for pair in pairs], [pair[1] for pair in pairs])


def of_average(name, pilots, cells):
    finest = min(pilots, key=lambda pilot: pilot.h)
    size = abs(finest.values[name][0])
    if not size > 0:
        raise Mistake(f"{name} is 0 in the finest pilot run, and nothing is relative to that: " +
                      ("nothing vibrates there" if name == "frequency" else "wish for another result"))
    return Result(fitted(runs_of(pilots, cells, lambda pilot: pilot.values[name]), size), size)


def of_distance(wish, pilots, cells, case):
    """Of a trajectory, spectrum or portrait: distances to the finest run of the first kind."""
    sizes = [pilot for pilot in pilots if pilot.role == "size"]
    finest = min((pilot for pilot in sizes if pilot.cell == cells[0]), key=lambda pilot: pilot.h)
    floor, found = 0.0, {}
    for pilot in sizes:
        if pilot is finest:
            continue
        if wish.name in DISTANCES:
            apart, floor = values.cycle_distance(pilot.folder, finest.folder, case.window, wish.name)
            found[pilot.name] = values.without_scatter(apart, floor)
        else:
            apart = values.trajectory_distance(pilot.folder, finest.folder, case.before, wish.name)
            found[pilot.name] = apart, 0.1 * apart
    others = [pilot for pilot in sizes if pilot.name in found]
    nearest = min(found[pilot.name][0] for pilot in others if pilot.cell == cells[0])
    if nearest > RELATED:
        raise Mistake(f"{wish.name}: the two finest pilot runs are {nearest:.2g} apart, as unrelated as two runs can be: "
                      "compare earlier, before squeal saturates (--before), or start from finer pilots (--sizes)")
    runs = runs_of(others, cells, lambda pilot: found[pilot.name])
    return Result(fitted(runs, finest=(finest.h, finest.step), own=floor), 1.0)


def morphology(name, seeds, own, size):
    """Between morphologies on one mesh: the pilots of other seeds, and the one with the recipe's own."""
    alike = [pilot for pilot in (*seeds, own) if pilot is not None]
    if len(alike) < 3:
        return None
    pairs = np.array([pilot.values[name] for pilot in alike])
    return tuple(part / size for part in between(*pairs.T))


def results(wishes, kept, seeds, cells, case):
    """A Result for each wish by name. kept: pilots of sizes and steps that count; seeds: those of other morphologies."""
    found = {}
    coarsest = max(kept, key=lambda pilot: (pilot.cell == cells[0], pilot.h, pilot.safety))
    own = coarsest if coarsest.cell == cells[0] and all(seed.h == coarsest.h for seed in seeds) else None
    for wish in wishes:
        if wish.kind in ("average", "stress"):
            found[wish.name] = of_average(wish.name, kept, cells)
            demands.of_size(wish, found[wish.name].size)
            found[wish.name].morphology = morphology(wish.name, seeds, own, found[wish.name].size)
        else:
            found[wish.name] = of_distance(wish, kept, cells, case)
    return found


if __name__ == "__main__":
    raise SystemExit("slipscale.planning.results is a library, no command: slipscale -h lists the commands.")
