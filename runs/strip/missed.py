"""How far a run with less microstructure is from that of the whole composite."""

import numpy as np

from slipscale.measuring.distance import spectrum_distance
from slipscale.measuring.regime import friction_spectrum, measures
from slipscale.reading.on_mesh import Statistics

QUANTITIES = {  # column: what it is
    "friction_off": "friction (mean T over mean N), less that of the whole",
    "frequency_off": "dominant frequency over that of the whole, less 1",
    "amplitude_off": "amplitude of T over mean N, over that of the whole, less 1",
    "spectrum_distance": "relative L2 distance of √density of friction",
    "mean_stress_distance": "relative L2 distance of the time mean of σ_yy near the contact",
    "deviation_distance": "the same of its standard deviation over time",
}
NORMAL = 1  # of xx, yy, xy
SAME = 1e-9  # m, within which the middles of two cells are one


def middles(statistics):
    """Middles [nc, 2] m of the cells, each the mean of its triangles'."""
    of_triangle = statistics.coordinates[statistics.triangles].mean(axis=1)
    count = np.bincount(statistics.cell_of_triangle)
    return np.column_stack([np.bincount(statistics.cell_of_triangle, of_triangle[:, axis]) / count for axis in (0, 1)])


def cells_near_contact(statistics, layer):
    """Cells whose middle lies within `layer` (m) of the lowest point, by place: a dict of (x, y) in units of SAME."""
    places = middles(statistics)
    near = np.flatnonzero(places[:, 1] < statistics.coordinates[:, 1].min() + layer)
    return {tuple(place): cell for cell, place in zip(near, np.round(places[near] / SAME).astype(int))}


def stress_distances(folder, whole, layer):
    """Of mean and deviation of σ_yy in the cells within `layer` of the contact; None where the meshes differ there."""
    with Statistics(folder) as own, Statistics(whole) as reference:
        cells, others = cells_near_contact(own, layer), cells_near_contact(reference, layer)
        shared = sorted(cells.keys() & others.keys())
        if len(shared) < max(len(cells), len(others)):
            return None, None
        own_cells, other_cells = ([of[place] for place in shared] for of in (cells, others))
        pairs = [(own.read(name)[own_cells, NORMAL], reference.read(name)[other_cells, NORMAL])
                 for name in ("mean", "deviation")]
    return tuple(float(np.linalg.norm(one - other) / np.linalg.norm(other)) for one, other in pairs)


def distances(folder, whole, window, layer):
    """QUANTITIES of the run in `folder` against the one in `whole`, both over `window` (two times in s)."""
    own, reference = measures(folder, window), measures(whole, window)

    def relative(name):
        return own[name] / reference[name] - 1 if reference[name] else None

    mean, deviation = stress_distances(folder, whole, layer)
    return {"friction_off": own["friction"] - reference["friction"], "frequency_off": relative("frequency"),
            "amplitude_off": relative("amplitude"),
            "spectrum_distance": spectrum_distance(friction_spectrum(folder, window), friction_spectrum(whole, window)),
            "mean_stress_distance": mean, "deviation_distance": deviation}


if __name__ == "__main__":
    raise SystemExit("strip.missed is a library, no command: snakemake --snakefile runs/strip/Snakefile runs the study.")
