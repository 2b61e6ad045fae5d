"""Which mesh, step and window keep every wish at the least price, or what a budget buys. Of fitted errors only."""

import math
from dataclasses import dataclass

import numpy as np

from slipscale.planning.costs import damped

FINER = 2.0**-0.25  # of successive sizes that are tried
WINDOWS = (1, 1.25, 1.5, 2, 2.5, 3, 4, 5, 6, 8, 10, 12, 16, 20, 25, 32, 40, 50, 64)
LONGEST = 7 * 86400.0  # s of one core: a run that takes longer is none to propose
MOST_SIZES = 32


@dataclass(frozen=True)
class Candidate:
    """cell: kind of cells, number: of the kind among those fitted; h m, safety, windows; step s, nodes, steps, seconds:
    expected; bounds: by wish, relative."""

    cell: str
    number: int
    h: float
    safety: float
    windows: float
    step: float
    nodes: float
    steps: float
    seconds: float
    bounds: dict

    @property
    def node_steps(self):
        return self.nodes * self.steps


@dataclass(frozen=True)
class Scaling:
    """Of a kind of cells: nodes of 1 m², so that nodes = density/h²; step: undamped stable step over size, s/m."""

    density: float
    step: float


def scaling_of(h, nodes, step):
    """From runs [n]: the median of what the finer half says; step: undamped stable ones."""
    h, nodes, step = (np.asarray(x, dtype=float) for x in (h, nodes, step))
    fine = h <= np.median(h)
    return Scaling(float(np.median((nodes * h**2)[fine])), float(np.median((step / h)[fine])))


class Search:
    """fits: errors.Fitted by wish; wishes: allowed share by name; scalings: by kind of cells, in the order of the fits'
    kinds; case: for damping and times; price: costs.Price."""

    def __init__(self, fits, allowed, scalings, case, price, coarsest, safeties):
        self.fits, self.allowed, self.scalings, self.case, self.price = fits, allowed, scalings, case, price
        self.sizes = [coarsest * FINER**k for k in range(MOST_SIZES)]
        self.safeties = safeties

    def candidate(self, cell, number, h, safety, windows):
        of = self.scalings[cell]
        step = safety * damped(of.step * h, self.case.damping)
        nodes, end = of.density / h**2, self.case.scene_of(windows)["time_end"]
        steps = end / step
        return Candidate(cell, number, h, safety, windows, step, nodes, steps, self.price(nodes, steps), {})

    def with_bounds(self, candidate):
        found = {name: fit.bound(candidate.h, candidate.step, candidate.number, candidate.windows)
                 for name, fit in self.fits.items()}
        return Candidate(**{**candidate.__dict__, "bounds": found})

    def worst(self, candidate):
        """The largest bound over what is allowed: wishes hold up to 1."""
        return max(candidate.bounds[name] / self.allowed[name] for name in self.fits)

    def possible(self, most):
        """Candidates that take at most so many s, cheapest first, without bounds."""
        found = [self.candidate(cell, number, h, safety, windows) for number, cell in enumerate(self.scalings)
                 for h in self.sizes for safety in self.safeties for windows in WINDOWS]
        return sorted((one for one in found if one.seconds <= most), key=lambda one: one.seconds)

    def cheapest(self, most=LONGEST):
        """The cheapest that keeps all wishes, or None."""
        hopeless = set()  # meshes that no window saves
        for one in self.possible(most):
            mesh = one.cell, one.h, one.safety
            if mesh in hopeless:
                continue
            one = self.with_bounds(one)
            if self.worst(one) <= 1:
                return one
            if one.windows == WINDOWS[0] and self.worst(self.with_bounds(
                    Candidate(**{**one.__dict__, "windows": WINDOWS[-1]}))) > 1:
                hopeless.add(mesh)
        return None

    def best(self, most):
        """What comes nearest to the wishes for at most so many s, or None where nothing is that cheap."""
        found = [self.with_bounds(one) for one in thinned(self.possible(most))]
        return min(found, key=self.worst, default=None)

    def front(self, name, most, count=40):
        """(seconds, bound) of one result of what is best for each price up to `most`, arrays for a picture."""
        possible = self.possible(most)
        if not possible:
            return np.array([]), np.array([])
        edges = np.geomspace(possible[0].seconds, most, count)
        best, found = math.inf, []
        for one in map(self.with_bounds, thinned(possible, 400)):
            if one.bounds[name] < best:
                best = one.bounds[name]
                found.append((one.seconds, best))
        return tuple(np.array(found).T) if found else (edges, edges * np.nan)


def thinned(candidates, most=600):
    """At most so many, evenly among them, the dearest too."""
    if len(candidates) <= most:
        return candidates
    return [candidates[k] for k in np.unique(np.linspace(0, len(candidates) - 1, most).astype(int))]


if __name__ == "__main__":
    raise SystemExit("slipscale.planning.proposal is a library, no command: slipscale -h lists the commands.")
