"""Which mode of one body is which of another: by the likeness of their shapes, on any two meshes of the same block."""

from dataclasses import dataclass

import numpy as np

LEAST = 0.5  # likeness of two shapes from which on they count as one mode's
ACROSS = 41  # places along the longer side at which shapes are compared


@dataclass(frozen=True)
class Pair:
    """Two Mode, the second None where there is no partner, and the likeness of their shapes, 0 to 1."""

    one: object
    other: object
    likeness: float


def sampled(coordinates, triangles, shape, places):
    """A shape [np, 2], complex, at places [n, 2]: [2 n]; 0 outside of the mesh."""
    from matplotlib.tri import LinearTriInterpolator, Triangulation  # nothing is drawn

    mesh = Triangulation(*coordinates.T, triangles)
    parts = [LinearTriInterpolator(mesh, part)(*places.T).filled(0)
             for component in shape.T for part in (component.real, component.imag)]
    return np.concatenate([parts[0] + 1j * parts[1], parts[2] + 1j * parts[3]])


def places_of(coordinates):
    """Points [n, 2] of a regular grid within the box of a mesh, away from its rim by half a spacing."""
    low, high = coordinates.min(axis=0), coordinates.max(axis=0)
    spacing = (high - low).max() / ACROSS
    sides = [np.linspace(a, b, max(2, round((b - a) / spacing)) + 1) for a, b in zip(low, high)]
    x, y = np.meshgrid(*(0.5 * (side[1:] + side[:-1]) for side in sides))
    return np.column_stack([x.ravel(), y.ravel()])


def likeness(one, other):
    """[n, m] of samples [n, k] and [m, k]: the square of the cosine between them, whatever their phases and sizes (modal
    assurance criterion: R. J. Allemang, D. L. Brown, Proc. IMAC 1 (1982) 110)."""
    lengths = np.outer((np.abs(one)**2).sum(axis=1), (np.abs(other)**2).sum(axis=1))
    return np.abs(one.conj() @ other.T)**2 / np.where(lengths > 0, lengths, 1)


def matched(like, least=LEAST):
    """{row: column} of a matrix of likeness, the best pairs first, each row and column once, none below `least`."""
    found, free = {}, like.copy()
    while free.size and free.max() >= least:
        row, column = np.unravel_index(free.argmax(), free.shape)
        found[int(row)] = int(column)
        free[row, :] = free[:, column] = -1
    return found


def samples_of(modes, places):
    """Of the modes of a slipscale.reading.modes.Modes whose shapes were written, [n, k]."""
    with modes.shapes as shapes:
        return np.array([sampled(shapes.coordinates, shapes.triangles, shapes.shape(k), places)
                         for k in range(shapes.count)])


def pairs_of(one, other):
    """A Pair for each mode of `one` whose shape is there; both are Modes."""
    with one.shapes as shapes:
        places = places_of(shapes.coordinates)
    like = likeness(samples_of(one, places), samples_of(other, places))
    partner = matched(like)
    return [Pair(one.modes[k], other.modes[partner[k]] if k in partner else None,
                 float(like[k, partner[k]] if k in partner else like[k].max(initial=0.0))) for k in range(len(like))]


if __name__ == "__main__":
    raise SystemExit("slipscale.measuring.pairing is a library, no command: slipscale -h lists the commands.")
