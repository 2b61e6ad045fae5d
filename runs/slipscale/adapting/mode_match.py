"""How far the growing modes of a homogeneous block are from those of a composite, and the parameters that bring them
nearest.

A mode is paired with that of like shape (slipscale.measuring.pairing). The misfit is 0 where each growing mode of the
composite has a partner of its growth and frequency, and nothing else grows in the block; about 1 where none grows at
all, or none is near.
"""

import numpy as np

NEAR = 0.05  # of a frequency: what counts as much as a growth that is off by that of the fastest mode
STEP = 0.3  # of the logarithm of a parameter: edge of the first simplex
REACH = (20, 1.5)  # factors by which the first and the other parameters may change: beyond, modes are another model's
SMALL = 2e-3  # of a logarithm: a simplex of that size is done


def misfit(pairs, others):
    """`pairs`: (mode, partner or None) of each growing mode of the composite; `others`: growth rates (1/s) of growing
    modes of the block that are partner of none of them. Raises ValueError without pairs."""
    if not pairs:
        raise ValueError("no mode of the composite grows")
    fastest = max(mode.growth_rate for mode, _ in pairs)
    weights = np.array([mode.growth_rate / fastest for mode, _ in pairs])
    squares = [1 if partner is None else min(1, ((partner.growth_rate - mode.growth_rate) / fastest)**2 +
                                             ((partner.frequency / mode.frequency - 1) / NEAR)**2)
               for mode, partner in pairs]
    stray = sum(min(1, (rate / fastest)**2) for rate in others)
    return float(np.sqrt((weights @ squares + stray) / weights.sum()))


def nearest(evaluate, start, scan, most):
    """Parameters (dict of numbers > 0) of least misfit: that of the first parameter is scanned by the factors `scan`,
    then all are followed downhill from the best, in their logarithms (J. A. Nelder, R. Mead, Comput. J. 7 (1965) 308).
    `evaluate`: the misfit of such a dict, inf where there is none; at most `most` evaluations after the scan."""
    names = list(start)
    at = lambda logs: {name: float(np.exp(log)) for name, log in zip(names, logs)}  # noqa: E731
    origin = np.log([start[name] for name in names])
    first = np.eye(len(names))[0]
    points = [origin + np.log(factor) * first for factor in scan]
    found = [(evaluate(at(point)), k) for k, point in enumerate(points)]
    best = points[min(found)[1]]
    simplex = [(min(found)[0], best)]
    left = most

    reach = np.log([REACH[min(k, 1)] for k in range(len(names))])

    def tried(point):
        nonlocal left
        if np.any(np.abs(point - origin) > reach):
            return np.inf, point
        left -= 1
        return evaluate(at(point)), point

    simplex += [tried(best + STEP * edge) for edge in np.eye(len(names))]
    key = lambda pair: pair[0]  # noqa: E731
    for _ in range(2 * most):  # tries that reach too far cost nothing, but not for ever
        if left <= 0:
            break
        simplex.sort(key=key)
        points = np.array([point for _, point in simplex])
        if np.ptp(points, axis=0).max() < SMALL or not np.isfinite(simplex[0][0]):
            break
        middle, worst = points[:-1].mean(axis=0), points[-1]
        reflected = tried(2 * middle - worst)
        if reflected[0] < simplex[0][0]:
            simplex[-1] = min(reflected, tried(3 * middle - 2 * worst), key=key)
        elif reflected[0] < simplex[-2][0]:
            simplex[-1] = reflected
        else:
            inner = tried(middle + 0.5 * (reflected[1] if reflected[0] < simplex[-1][0] else worst) - 0.5 * middle)
            if inner[0] < min(simplex[-1], reflected, key=key)[0]:
                simplex[-1] = inner
            else:
                simplex = simplex[:1] + [tried(0.5 * (simplex[0][1] + point)) for _, point in simplex[1:]]
    value, point = min(simplex, key=key)
    return at(point), value


if __name__ == "__main__":
    raise SystemExit("slipscale.adapting.mode_match is a library, no command: slipscale -h lists the commands.")
