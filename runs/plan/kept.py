"""Whether a promise was kept: of each wish the proposed run against the one that is twice finer."""

from slipscale.planning import values
from slipscale.planning.wishes import DISTANCES, kind_of

ERRORS_ALLOWED = 2  # standard errors over time of the finer run, which is not exact either
SECONDS_ALLOWED = 0.3


def judged(name, promised, proposed, finer, window, before=None):
    """A dict: value and error (relative, over time) of the proposed run and of the finer one; apart, their relative
    difference; within: whether that is at most `promised`; holds: whether it is, but for the scatter of the finer."""
    kind = kind_of(name)
    if kind == "trajectory":
        apart = values.trajectory_distance(proposed, finer, before, name)
        return {"value": None, "finer": None, "error": 0.0, "finer_error": 0.0, "apart": apart,
                **verdict(apart, promised, 0.0)}
    if name in DISTANCES:
        apart, floor = values.cycle_distance(proposed, finer, window, name)
        return {"value": None, "finer": None, "error": floor, "finer_error": floor, "apart": apart,
                **verdict(apart, promised, floor)}
    if kind == "stress":
        pairs = [values.stress(folder, window, values.region_of(name)) for folder in (proposed, finer)]
    else:
        pairs = [values.averages(folder, window, [name])[name] for folder in (proposed, finer)]
    (value, error), (other, other_error) = pairs
    apart = value / other - 1
    return {"value": value, "finer": other, "error": error / abs(other), "finer_error": other_error / abs(other),
            "apart": apart, **verdict(apart, promised, other_error / abs(other))}


def verdict(apart, promised, scatter):
    return {"within": abs(apart) <= promised, "holds": abs(apart) <= promised + ERRORS_ALLOWED * scatter}


if __name__ == "__main__":
    raise SystemExit("plan.kept is a library, no command: snakemake --snakefile runs/plan/Snakefile runs the study.")
