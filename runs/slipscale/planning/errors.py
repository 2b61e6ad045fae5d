"""How far a result is from its limit on a mesh of size h with a step Δt: order and constant fitted to a few coarse runs,
the scatter of the runs told apart from the error of the mesh.

Model, for each kind of cells k:   v = v0 + a_k (h/H)^p_k + b (Δt/D)^q + noise,   noise of variance e² + s²,

H and D the largest size and step of the runs, e the standard error of each run (from blocks of its window), s what runs
scatter by besides. Given p, q and s that is linear: with normal priors on v0, a and b (how much error a coarse mesh may
have) the posterior is normal, and its evidence weighs the orders and scatters of a grid. What is said of an error is what
this mixture says, sampled: orders that a few runs cannot tell apart all count (J. M. Bernardo, A. F. M. Smith, Bayesian
Theory, 1994, ch. 5). A distance to the finest run has no v0 and the columns (h/H)^p - (h_f/H)^p.
"""

import itertools
from dataclasses import dataclass, field

import numpy as np

ORDERS = (0.75, 1.0, 1.25, 1.5, 1.75, 2.0)  # of the mesh: 2 is that of scheme and elements, contact makes it less
STEP_ORDERS = (1.0, 2.0)
EXTRA = (0.0, 0.5, 1.0, 2.0, 4.0)  # scatter s, in units of the runs' standard error or, if it is larger, of their misfit
COARSE_ERROR = 0.3  # of the value: standard deviation of what the coarsest mesh may be off, before anything was run
STEP_ERROR = 0.1  # the same of the longest step
SAMPLES = 4000
LEVEL = 0.95  # of all bounds: one in twenty may be wrong
LEAST = 1e-9  # of the value: no result is known better


@dataclass
class Runs:
    """What was run, arrays [n]: size of the cells m, step s, kind a number from 0, value and its standard error in the
    unit of the value."""

    h: np.ndarray
    step: np.ndarray
    kind: np.ndarray
    value: np.ndarray
    error: np.ndarray

    def __post_init__(self):
        self.h, self.step, self.value, self.error = (np.asarray(x, dtype=float)
                                                     for x in (self.h, self.step, self.value, self.error))
        self.kind = np.asarray(self.kind, dtype=int)
        if not len(self.h) or np.any(self.h <= 0) or np.any(self.step <= 0):
            raise ValueError("sizes and steps have to be positive")


@dataclass
class Fitted:
    """Samples [m] of the posterior: limit v0; amplitude [m, kinds] at H; order [m, kinds]; of the step amplitude
    step_amplitude [m] at D and step_order [m]; scatter [m], s; normal [m], standard normal numbers that stand for the
    noise of a run to come. own: standard error of a run of the pilots' window. size: what relative errors are relative
    to."""

    coarsest: float
    longest: float
    limit: np.ndarray
    amplitude: np.ndarray
    order: np.ndarray
    step_amplitude: np.ndarray
    step_order: np.ndarray
    scatter: np.ndarray
    own: float
    size: float
    normal: np.ndarray = field(repr=False, default=None)

    def error(self, h, step, kind=0):
        """value - limit on such a mesh, [m]."""
        return (self.amplitude[:, kind] * (h / self.coarsest) ** self.order[:, kind] +
                self.step_amplitude * (step / self.longest) ** self.step_order)

    def noise(self, windows=1.0):
        """Of a run whose window is so many times that of the pilots, [m]."""
        return self.normal * np.sqrt((self.own**2 + self.scatter**2) / windows)

    def bound(self, h, step, kind=0, windows=1.0, level=LEVEL):
        """What the error stays below, with the scatter of the run, relative to the size."""
        return float(np.quantile(np.abs(self.error(h, step, kind) + self.noise(windows)), level) / self.size)

    def expected(self, h, step, kind=0):
        """Mean and standard deviation of the error of mesh and step, relative to the size."""
        error = self.error(h, step, kind) / self.size
        return float(np.mean(error)), float(np.std(error))

    def time_scatter(self, windows=1.0):
        """Standard error of a run over time, relative to the size."""
        return float(np.sqrt(np.mean(self.own**2 + self.scatter**2) / windows) / self.size)

    def order_of(self, kind=0):
        """Mean and standard deviation of the order in h."""
        return float(np.mean(self.order[:, kind])), float(np.std(self.order[:, kind]))

    def constant_of(self, kind=0):
        """Mean and standard deviation of the error of the coarsest mesh, relative to the size."""
        amplitude = self.amplitude[:, kind] / self.size
        return float(np.mean(amplitude)), float(np.std(amplitude))


def columns(runs, p, q, coarsest, longest, finest=None):
    """The matrix [n, 1 + kinds + 1] of limit, mesh (p of each kind) and step, or without the limit those of distances to
    a run (`finest`, a pair of h and step)."""
    kinds = len(p)
    parts = [np.ones(len(runs.h))] if finest is None else []
    for k in range(kinds):
        own = (runs.h / coarsest) ** p[k] - (0 if finest is None else (finest[0] / coarsest) ** p[k])
        parts.append(np.where(runs.kind == k, own, 0.0))
    parts.append((runs.step / longest) ** q - (0 if finest is None else (finest[1] / longest) ** q))
    return np.column_stack(parts)


def posterior(matrix, value, variance, mean, deviation):
    """Of a linear model with normal noise and prior: mean [c], covariance [c, c] of the coefficients, log evidence."""
    prior = np.diag(1 / deviation**2)
    precision = prior + matrix.T @ (matrix / variance[:, None])
    covariance = np.linalg.inv(precision)
    found = covariance @ (prior @ mean + matrix.T @ (value / variance))
    misfit, moved = value - matrix @ found, (found - mean) / deviation
    evidence = -0.5 * (np.sum(misfit**2 / variance) + moved @ moved + np.sum(np.log(variance)) +
                       np.linalg.slogdet(precision)[1] + 2 * np.sum(np.log(deviation)))
    return found, 0.5 * (covariance + covariance.T), evidence


def least_misfit(runs, size, finest):
    """Root mean square of what the best order leaves, with as many degrees of freedom as are left."""
    kinds, best = int(runs.kind.max()) + 1, np.inf
    for order in ORDERS:
        matrix = columns(runs, (order,) * kinds, 1.0, runs.h.max(), runs.step.max(), finest)
        left = runs.value - matrix @ np.linalg.lstsq(matrix, runs.value, rcond=1e-8)[0]
        best = min(best, float(left @ left))
    return np.sqrt(best / max(1, len(runs.h) - kinds - 2))


def fitted(runs, size=None, finest=None, own=None, seed=1):
    """The Fitted of `runs` (Runs). size: of relative errors, by default the finest run's value; finest: a pair of h and
    step of the run that values are distances to, which then have the size 1; own: standard error over time of a run to
    come, by default the median of the runs'."""
    kinds = int(runs.kind.max()) + 1
    size = size if size is not None else (1.0 if finest else abs(float(runs.value[np.argmin(runs.h)])))
    if not size > 0:
        raise ValueError("a value of zero has no relative error")
    coarsest, longest = runs.h.max(), runs.step.max()
    if finest:
        longest = max(longest, finest[1])
    own = float(np.median(runs.error)) if own is None else own
    unit = max(float(np.median(runs.error)), least_misfit(runs, size, finest), LEAST * size)
    mean = np.zeros((0 if finest else 1) + kinds + 1)
    deviation = np.concatenate([[] if finest else [2 * size], np.full(kinds, COARSE_ERROR * size), [STEP_ERROR * size]])
    if finest:
        deviation[:] = 1.0
    else:
        mean[0] = float(runs.value[np.argmin(runs.h)])
    found = []
    for p in itertools.product(ORDERS, repeat=kinds):
        for q in STEP_ORDERS:
            matrix = columns(runs, p, q, coarsest, longest, finest)
            for extra in EXTRA:
                variance = runs.error**2 + (extra * unit)**2 + (LEAST * size)**2
                found.append((p, q, extra * unit, *posterior(matrix, runs.value, variance, mean, deviation)))
    return sampled(found, kinds, bool(finest), coarsest, longest, own, size, seed)


def sampled(found, kinds, distances, coarsest, longest, own, size, seed):
    """Samples of the mixture `found`, a list of (orders, step order, scatter, mean, covariance, log evidence)."""
    draw = np.random.default_rng(seed)
    evidence = np.array([one[5] for one in found])
    weight = np.exp(evidence - evidence.max())
    chosen = draw.choice(len(found), SAMPLES, p=weight / weight.sum())
    coefficients = np.empty((SAMPLES, len(found[0][3])))
    for k in np.unique(chosen):
        of = chosen == k
        coefficients[of] = draw.multivariate_normal(found[k][3], found[k][4], of.sum(), method="eigh")
    at = 0 if distances else 1
    return Fitted(coarsest, longest, np.zeros(SAMPLES) if distances else coefficients[:, 0],
                  coefficients[:, at:at + kinds], np.array([found[k][0] for k in chosen]), coefficients[:, at + kinds],
                  np.array([found[k][1] for k in chosen]), np.array([found[k][2] for k in chosen]), own, size,
                  draw.standard_normal(SAMPLES))


def between(values, errors):
    """Standard deviation between morphologies from a value of each [n] and its error over time [n]: of what is left
    when these are taken off; and its own standard error. nan of fewer than two."""
    values, errors = np.asarray(values, dtype=float), np.asarray(errors, dtype=float)
    if len(values) < 2:
        return float("nan"), float("nan")
    seen, in_time = np.var(values, ddof=1), np.mean(errors**2)
    left = np.sqrt(max(0.0, seen - in_time))
    return float(left), float(np.sqrt(seen / (2 * (len(values) - 1))))


if __name__ == "__main__":
    raise SystemExit("slipscale.planning.errors is a library, no command: slipscale -h lists the commands.")
