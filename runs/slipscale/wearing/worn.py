"""What `slipscale wear` finds of a run: the sums of contact.h5 over a window, and what follows from them."""

from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from slipscale.measuring.window import backwards, cut_away, unfinished
from slipscale.mistakes import Mistake
from slipscale.reading import ContactHistory, Summary, UnreadableRun
from slipscale.wearing import depth, flash
from slipscale.wearing.constants import at_nodes

TAKEN = ("friction_work", "pressure_slip", "slip_distance", "time_closed")


@dataclass(frozen=True)
class Worn:
    """time [n] s, of the rows in the window; x, length [nc] m; shares {region: [nc]}; sums {name: [n, nc]} since the
    window's first row; depth {law: [n, nc]} m since then; phases {law: [Phase]}; temperature [n, nc] K over that of the
    run's start, or None; notes: what has to be said of the window and of the run's end, sentences."""

    time: np.ndarray
    x: np.ndarray
    length: np.ndarray
    shares: dict
    sums: dict
    depth: dict = field(default_factory=dict)
    phases: dict = field(default_factory=dict)
    temperature: np.ndarray | None = None
    notes: tuple = ()

    def mean(self, values):
        """Of [nc] over the length of the contact."""
        return np.sum(values * self.length) / np.sum(self.length)


def read(folder, window):
    """(time, sums {name: [n, nc]} since t = 0, x, length, shares, rows of the window, notes). Raises UnreadableRun."""
    path = Path(folder) / "contact.h5"
    with ContactHistory(folder) as file:
        if missing := [name for name in TAKEN if f"sums/{name}" not in file.sums]:
            raise UnreadableRun(f"{path} has no sums/{missing[0]}: wear takes sums over every step, so run slide again "
                                "with -contact_sums true (its default), in a version that has the option.")
        shares = dict(zip(file.region_names, file.region_share.T, strict=True))
        shares = {name: share for name, share in shares.items() if share.any()}
        sums = {name: file.read(f"sums/{name}") for name in TAKEN}
        time, x, length = file.time, file.x, file.tributary_length
    if len(time) < 2:
        raise UnreadableRun(f"{path} has {len(time)} rows yet, and wear over a time needs 2: let the run go on for a while.")
    begin, end = window or (time[0], time[-1])
    if wrong := backwards((begin, end)):
        raise UnreadableRun(f"the window {wrong}.")
    rows = np.flatnonzero((time >= begin * (1 - 1e-9)) & (time <= end * (1 + 1e-9)))
    if len(rows) < 2:
        raise UnreadableRun(f"{path} has {len(rows)} rows between {begin:g} and {end:g} s, and wear over a time needs 2: "
                            f"it reaches from {time[0]:g} to {time[-1]:g} s; widen --window.")
    notes = filter(None, (cut_away(time, (begin, end)), unfinished(Summary(folder), time[-1])))
    return time, sums, x, length, shares, rows, tuple(notes)


def heat_flow(time, sums, shares, thermal):
    """Temperature of every row, [n, nc] K. thermal: conductivity, density, heat_capacity, share, each {region: value}."""
    effusive = at_nodes({name: flash.effusivity(*(thermal[part][name] for part in ("conductivity", "density",
                                                                                     "heat_capacity")))
                         for name in shares}, shares)
    return flash.temperature(time, sums["friction_work"] * at_nodes(thermal["share"], shares), effusive)


def worn(folder, factors, thermal=None, window=None):
    """The Worn of a run. factors(regions) gives {law: {region: k/H or k_E}} and thermal(regions) the constants of
    `heat_flow` or None. Raises Mistake."""
    time, sums, x, length, shares, rows, notes = read(folder, window)
    found = factors(list(shares))
    heating = thermal(list(shares)) if thermal else None
    if not found and heating is None:
        raise Mistake("nothing is asked for: give --archard and --hardness, --energy, or --conductivity, --density, "
                      "--heat-capacity and --share.")
    temperature = None if heating is None else heat_flow(time, sums, shares, heating)[rows]
    sums = {name: values[rows] - values[rows[0]] for name, values in sums.items()}
    last = {name: values[-1] for name, values in sums.items()}
    return Worn(time[rows], x, length, shares, sums,
                {law: depth.depth(law, factor, sums, shares) for law, factor in found.items()},
                {law: depth.phases(law, factor, last, shares, length) for law, factor in found.items()}, temperature, notes)


if __name__ == "__main__":
    raise SystemExit("slipscale.wearing.worn is a library, no command: slipscale -h lists the commands.")
