"""What a pilot run gave: each result that is wished for with its standard error over time."""

import numpy as np

from slipscale.measuring import distance
from slipscale.measuring.regime import friction_spectrum, measures
from slipscale.measuring.window import rows_in
from slipscale.mistakes import Mistake
from slipscale.planning.wishes import STRESS
from slipscale.reading import Fields, History, Summary
from slipscale.reading.mesh import centroids_and_areas

PARTS = 5  # of the window, for results whose error no blocks tell
PART_OF_CELLS = 0.99  # of the stress in a region, over its area and the frames


def cut(window, parts=PARTS):
    times = np.linspace(*window, parts + 1)
    return list(zip(times, times[1:]))


def averages(folder, window, names, point=0):
    """Pairs of value and standard error of `names`, of regime.MEASURES, over `window` (s): errors of blocks where
    `measures` has them, else from the values of five parts. Raises UnreadableRun."""
    whole = measures(folder, window, point)
    if missing := [name for name in names if whole.get(name) is None]:
        raise Mistake(f"{folder} has no {missing[0]}: name a probe point with history_points.")
    found, pieces = {}, None
    for name in names:
        error = whole.get(f"{name}_error")
        if f"{name}_error" not in whole:
            pieces = pieces or [measures(folder, part, point) for part in cut(window)]
            parts = [piece[name] for piece in pieces if piece[name] is not None]
            error = float(np.std(parts, ddof=1) / np.sqrt(len(parts))) if len(parts) > 1 else 0.0
        found[name] = whole[name], error or 0.0
    return found


def stress(folder, window, region, *file):
    """Pair of value and standard error, Pa: what PART_OF_CELLS of the region's von Mises stress lies below, over its
    area and the frames of fields.h5 in `window`, or of another `file` (name and program, as of Fields). Raises Mistake
    where there is no such region."""
    with Fields(folder, *file) as fields:
        if region not in fields.region_names:
            raise Mistake(f"there is no region {region}, whose stress is wished for: the mesh has "
                          f"{', '.join(fields.region_names)}")
        frames = [k for k, time in enumerate(fields.time) if window[0] <= time <= window[1] * (1 + 1e-9)]
        cells = np.flatnonzero(fields.region == fields.region_names.index(region))
        area = centroids_and_areas(fields.coordinates, fields.triangles, fields.cell_of_triangle)[1][cells]
        values = np.array([equivalent(fields, k, cells) for k in frames])
    if len(values) < 2 * PARTS:
        raise Mistake(f"{folder} has {len(values)} frames in the window, and the stress needs {2 * PARTS}")
    blocks = [weighted_quantile(part, area) for part in np.array_split(values, PARTS)]
    return weighted_quantile(values, area), float(np.std(blocks, ddof=1) / np.sqrt(PARTS))


def equivalent(fields, frame, cells):
    """Von Mises stress [cells] of a frame, Pa; of the stress in the plane alone where the frames have no more, as of a
    material that is not isotropic and does not tell that across it."""
    if fields.holds("von_mises", frame):
        return fields.read("von_mises", frame).ravel()[cells]
    xx, yy, xy = fields.read("stress", frame)[cells].T
    return np.sqrt(xx**2 - xx * yy + yy**2 + 3 * xy**2)


def weighted_quantile(values, area, part=PART_OF_CELLS):
    """Of values [frames, cells], cells counting by their area [cells]."""
    weight = np.broadcast_to(area, values.shape).ravel()
    order = np.argsort(values, axis=None)
    share = np.cumsum(weight[order]) - 0.5 * weight[order]
    return float(np.interp(part * weight.sum(), share, values.ravel()[order]))


def signal(folder, name, point=0):
    """time [n] s and values [n] of one of wishes.TRAJECTORIES."""
    history = History(folder)
    what = name.removeprefix("trajectory_")
    if what.endswith("force"):
        return history.time, history.boundary[Summary(folder).measured_boundary(history)][what]
    if not 0 <= point < len(history.points):
        raise Mistake(f"{folder} recorded no probe point, whose trajectory is wished for: name one with history_points.")
    of = history.points[point]
    return history.time, (of.u if what == "displacement" else of.v)[:, 0]


def trajectory_distance(folder, reference, window, name, point=0):
    """Relative L2 distance of a trajectory from that of the reference, at the reference's times in `window`."""
    (time, own), (at, true) = signal(folder, name, point), signal(reference, name, point)
    rows = rows_in(at, window)
    if rows.stop - rows.start < 8:
        raise Mistake(f"{reference} has {rows.stop - rows.start} rows between {window[0]:g} and {window[1]:g} s: choose "
                      "another --before, or a smaller history_interval.")
    return distance.relative_l2(np.interp(at[rows], time, own), true[rows])


def cycle_distance(folder, reference, window, name, point=0):
    """Pair: distance of a spectrum or portrait from the reference's, and how far the halves of the reference's window
    are apart, over √2: what scatter alone makes of two whole windows."""
    halves = cut(window, 2)
    if name == "spectrum":
        own, true = friction_spectrum(folder, window), friction_spectrum(reference, window)
        parts = [friction_spectrum(reference, half) for half in halves]
        measure = distance.spectrum_distance
    else:
        own, true = portrait(folder, window, point), portrait(reference, window, point)
        parts = [portrait(reference, half, point) for half in halves]
        measure = distance.portrait_distance
    return measure(own, true), measure(*parts) / np.sqrt(2)


def portrait(folder, window, point):
    time, u = signal(folder, "trajectory_displacement", point)
    rows = rows_in(time, window)
    return u[rows], signal(folder, "trajectory_velocity", point)[1][rows]


def without_scatter(found, floor):
    """A distance whose square holds that of the scatter, and its standard error."""
    return float(np.sqrt(max(0.0, found**2 - floor**2))), float(max(0.5 * floor, 0.1 * found))


def region_of(name):
    return name.removeprefix(STRESS)


def settled(folder, window):
    """Whether the run had settled in the window, its regime and its frequency (Hz), as `measures` says."""
    found = measures(folder, window)
    return found["settled"], found["regime"], found["frequency"]


if __name__ == "__main__":
    raise SystemExit("slipscale.planning.values is a library, no command: slipscale -h lists the commands.")
