"""What a run is off from its reference, with the scatter over time, and what it cost."""

from functools import cache

from slipscale.measuring.distance import spectrum_distance
from slipscale.measuring.regime import costs, friction_spectrum, measures
from slipscale.mistakes import Mistake
from slipscale.planning.values import averages, cycle_distance, stress

CONTACT = ("friction", "frequency", "amplitude", "stick", "open", "velocity")
BULK = ("displacement", "normal_force")
PHASES = ("matrix", "inclusion")


@cache
def values_of(folder, window, relocalised=None):
    """Pairs of value and standard error by name; stresses of regions that have frames, those of the folder `relocalised`
    where the microstructure was put back."""
    found = averages(folder, window, [*CONTACT, *BULK])
    held, *file = (relocalised, "relocalized.h5", "relocalize") if relocalised else (folder, "fields.h5", "slide")
    if (held / file[0]).is_file():
        for region in PHASES:
            try:
                found[f"stress_{region}"] = stress(held, window, region, *file)
            except Mistake:  # a region that is not there, as of a block without inclusions
                continue
    return found


@cache
def scatter_of_spectrum(folder, window):
    return cycle_distance(folder, folder, window, "spectrum")[1]


def measured(folder, window, relocalised=None):
    """Columns: each value and its standard error; regime and whether it had settled."""
    found = measures(folder, window)
    columns = {"regime": found["regime"], "settled": found["settled"]}
    for name, (value, error) in values_of(folder, window, relocalised).items():
        columns |= {name: value, f"{name}_scatter": error}
    return columns


def errors_of(folder, reference, window, relocalised=None):
    """Columns NAME_off, relative differences from the reference, NAME_bar, the standard error of each over time of both;
    spectrum_off, the distance of the spectra, spectrum_bar, that of the halves of the reference's window."""
    own, other = values_of(folder, window, relocalised), values_of(reference, window)
    columns = {}
    for name in own.keys() & other.keys():
        (value, error), (true, true_error) = own[name], other[name]
        if true:
            columns[f"{name}_off"] = value / true - 1
            columns[f"{name}_bar"] = ((error / true)**2 + (true_error / true)**2)**0.5
    columns["spectrum_off"] = spectrum_distance(friction_spectrum(folder, window), friction_spectrum(reference, window))
    columns["spectrum_bar"] = scatter_of_spectrum(reference, window)
    return dict(sorted(columns.items()))


def costs_of(folder, outcome, after=()):
    """Seconds of one core, node-steps, peak memory and disk, B, of a run; `after`: pairs of folder and outcome of what
    went on from it."""
    found, all_of = costs(folder), [(folder, outcome), *after]
    return {"seconds": sum(of["cpu_seconds"] for _, of in all_of),
            **{name: found[name] for name in ("nodes", "steps", "step", "node_steps")},
            "memory": max(of["peak_memory"] for _, of in all_of),
            "disk": sum(file.stat().st_size for held, _ in all_of for file in held.iterdir()),
            "energy_residual": found["energy_residual"]}


if __name__ == "__main__":
    raise SystemExit("tradeoff.errors is a library, no command: snakemake --snakefile runs/tradeoff/Snakefile runs the "
                     "study.")
