"""What a run of `slide` takes: steps, node-steps, seconds of one core, disk. Fitted to pilot runs, all of them smaller."""

import itertools
from dataclasses import dataclass

import numpy as np

PER_NODE = 7e-9  # s of a step and node, in cache (tests/bench/README.md); before anything was run
PER_STEP = 1.5e-6  # s of a step, whatever the mesh
START = 0.2  # s
HISTORY_ROW, CONTACT_ROW = 400, 68  # B of a row of history.h5, and of one of contact.h5 for each contact node
CONTACT_SUMS = 56  # B more with the sums over every step
CONTACT_ROWS, CONTACT_EVERY = 1000, 25  # of contact_every auto: at most so many rows, and steps between them at least
CHECKPOINT = 330  # B of a node
FRAME = {"u": 24, "v": 24, "stress": 36, "strain": 36, "von_mises": 12, "principal": 24,
         "damping_work": 12}  # B of a node, cells being 1.5
ROW_IN_MEMORY = 600  # B that a run keeps of a row of the history, for its summary


def damped(step, stiffness_damping):
    """The stable step that is left of an undamped one, s, with damping b K, s: Δt (Δt + 2b) = step²."""
    return np.sqrt(stiffness_damping**2 + step**2) - stiffness_damping


def undamped(step, stiffness_damping):
    """The stable step without damping, s, of one with it."""
    return np.sqrt(step * (step + 2 * stiffness_damping))


@dataclass
class Price:
    """Seconds of one core: start, of each step, of each step and node; spread, relative, of what was measured about
    it."""

    start: float = START
    per_step: float = PER_STEP
    per_node: float = PER_NODE
    spread: float = 0.5

    def __call__(self, nodes, steps):
        return self.start + steps * (self.per_step + self.per_node * nodes)


def fitted_price(nodes, steps, seconds):
    """The Price of runs [n], by least squares of relative errors, no part of it negative."""
    nodes, steps, seconds = (np.asarray(x, dtype=float) for x in (nodes, steps, seconds))
    matrix = np.column_stack([np.ones(len(steps)), steps, steps * nodes]) / seconds[:, None]
    best, found = np.inf, None
    for size in (1, 2, 3):
        for chosen in itertools.combinations(range(3), size):
            if len(chosen) > len(steps) or 2 not in chosen:
                continue
            part = np.linalg.lstsq(matrix[:, chosen], np.ones(len(steps)), rcond=None)[0]
            misfit = float(np.sum((matrix[:, chosen] @ part - 1)**2))
            if np.all(part >= 0) and misfit < best * (1 - 1e-6):
                best, found = misfit, dict(zip(chosen, part))
    spread = float(np.sqrt(best / max(1, len(steps) - len(found))))
    return Price(*(float(found.get(k, 0.0)) for k in range(3)), spread)


def frames_of(options, end, step):
    """Frames of fields.h5 that a scene asks for."""
    if "fields_times" in options:
        return str(options["fields_times"]).count(",") + 1
    if "fields_interval" in options:
        return int(end / float(options["fields_interval"])) + 1
    return int(end / step / float(options["fields_every"])) + 1 if "fields_every" in options else 0


def contact_rows(options, end, step):
    if "contact_interval" in options:
        return end / float(options["contact_interval"])
    every = options.get("contact_every", "auto")
    return min(CONTACT_ROWS, end / step / CONTACT_EVERY) if every == "auto" else end / step / float(every)


def disk(options, nodes, contact_nodes, end, step, row=HISTORY_ROW):
    """B that a run leaves."""
    rows = end / float(options["history_interval"])
    frame = sum(FRAME.get(name.strip(), 24) for name in str(options.get("fields_quantities", "u,v,stress")).split(","))
    sums = 0 if str(options.get("contact_sums", "true")).lower() in ("false", "no", "0", "off") else CONTACT_SUMS
    return (rows * row + contact_rows(options, end, step) * contact_nodes * (CONTACT_ROW + sums) + CHECKPOINT * nodes +
            frames_of(options, end, step) * nodes * frame)


if __name__ == "__main__":
    raise SystemExit("slipscale.planning.costs is a library, no command: slipscale -h lists the commands.")
