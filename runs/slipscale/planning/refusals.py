"""Why no mesh will do, and what would help: each a sentence, or None where there is no reason."""

from slipscale.planning.case import ACROSS_MEMORY

SAME_FREQUENCY = 0.15  # relative: what differs by more is another mode
FEWEST_SIZES = 3
MOST_UNSETTLED = 1 / 3  # of the runs: by chance some are

COULOMB = ("with Coulomb's law no mesh will do: on every mesh the smallest waves that it carries grow, and finer meshes do "
           "not agree (runs/refinement). A law with memory helps: friction_law regularized with a friction_time T of at "
           "least {time:.3g} s, for which c_s T spans two cells of {size:.3g} m")
SHORT = ("friction's memory is shorter than two cells: c_s T is {length:.3g} m ({slow:.4g} m/s times {time:.3g} s), so cells "
         "may not be larger than {size:.3g} m, of which the pilot runs alone take about {seconds:.3g} s, more than "
         "{most:.3g}. A longer memory helps, T of {enough:.3g} s or more, or more time for the pilots, --pilots {wanted}")
SHORT_SIZES = ("friction's memory is shorter than two cells of {given:.3g} m: c_s T is {length:.3g} m ({slow:.4g} m/s times "
               "{time:.3g} s). Cells of at most {size:.3g} m help, or T of {enough:.3g} s or more")
DRAWING = ("only {count} meshes of {cell} cells show one drawing and run, and an order needs {fewest}: {left_out}. Wider "
           "gap and clearance of the recipe help, or finer pilots, --sizes")
REGIME = ("the regime changes between the pilot meshes: {seen}. What a coarse mesh does says nothing about a fine one; finer "
          "pilots help, --sizes {size:.3g}, or more friction memory or damping, which make the small waves weaker")
UNSETTLED = ("the window has not settled: {seen} of {count} runs change from its first half to its second. A later window "
             "helps: -time_end {later:.3g}, or --window with times after growth has ended")


def of_law(case):
    """Coulomb's law, or a memory of zero."""
    if case.memory is None or case.memory > 0:
        return None
    size = min(float(case.recipe["block_height"]), float(case.recipe["block_width"])) / 40
    return COULOMB.format(size=size, time=ACROSS_MEMORY * size / case.slowest_shear)


def of_memory(case, seconds, most, top, given=None):
    """A memory that is resolved only by meshes whose pilots cost more than `most` s, or not by a size that is given;
    `top`: the largest size that all else allows, m."""
    if not case.memory:
        return None
    told = {"length": case.slowest_shear * case.memory, "slow": case.slowest_shear, "time": case.memory,
            "size": case.memory_size()}
    if given is not None:
        return SHORT_SIZES.format(given=given, enough=ACROSS_MEMORY * given / case.slowest_shear, **told) \
            if given > case.memory_size() * (1 + 1e-9) else None
    if seconds <= most or case.memory_size() > top * (1 + 1e-9):
        return None
    cheap = case.memory_size() * (seconds / most)**(1 / 3)
    return SHORT.format(seconds=seconds, most=most, wanted=f"{1.2 * seconds / 60:.3g}min",
                        enough=ACROSS_MEMORY * cheap / case.slowest_shear, **told)


def of_drawing(pilots, cell, left_out):
    """Fewer than FEWEST_SIZES `pilots` of one kind of cells."""
    return DRAWING.format(count=len(pilots), cell=cell, fewest=FEWEST_SIZES, left_out="; ".join(left_out)) \
        if len(pilots) < FEWEST_SIZES else None


def alike(one, other):
    """Whether two pilots, with regime and frequency, do the same."""
    same = one.frequency == other.frequency or (other.frequency and
                                                abs(one.frequency / other.frequency - 1) <= SAME_FREQUENCY)
    return one.regime == other.regime and bool(same)


def usable(pilots):
    """Of the size pilots of one kind, coarse to fine, those from the coarsest on from which all do as the finest."""
    kept = []
    for pilot in reversed(pilots):
        if not alike(pilot, pilots[-1]):
            break
        kept.insert(0, pilot)
    return kept


def of_regime(kept, pilots):
    """Of the main kind: fewer than FEWEST_SIZES sizes do alike."""
    if len(kept) >= FEWEST_SIZES:
        return None
    seen = ", ".join(f"{pilot.regime} at {pilot.frequency / 1e3:.0f} kHz with {1e6 * pilot.h:.4g} µm" for pilot in pilots)
    return REGIME.format(seen=seen, size=pilots[-1].h)


def of_window(pilots, case):
    """More than a third of the runs had not settled."""
    unsettled = [pilot for pilot in pilots if not pilot.settled]
    if len(unsettled) <= MOST_UNSETTLED * len(pilots):
        return None
    return UNSETTLED.format(seen=len(unsettled), count=len(pilots), later=2 * case.window[1])


if __name__ == "__main__":
    raise SystemExit("slipscale.planning.refusals is a library, no command: slipscale -h lists the commands.")
