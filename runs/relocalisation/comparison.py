"""What `relocalize` found against a heterogeneous run, as rows of a table.

A row has the columns measure, part, component, time, reference, relocalised, homogeneous. The measures:

error, error_<statistic>       relative L2 error over space and all frames, or of a statistic over time (mean, …)
average                        of the stress over the area and all frames [Pa]
quantile_<level>               by area, of the last frame [Pa]
frame_error                    relative L2 error over space of the frame at `time` [s], of all
probe_correlation, probe_slope, probe_error    of a history at a point


The part is all, layer, bulk, a phase, or a point such as 'inclusion at 4.2, 0.2 mm'. `reference` is None for errors.
"""

from pathlib import Path

import numpy as np

from slipscale.reading import Fields, UnreadableRun, read_yaml
from slipscale.reading.mesh import centroids_and_areas

COMPONENTS = ("xx", "yy", "xy")
SOURCES = ("reference", "relocalised", "homogeneous")
LEVELS = (0.01, 0.5, 0.99)


def read_comparison(folder):
    """The rows of comparison.yaml of a folder. Raises UnreadableRun."""
    path = Path(folder) / "comparison.yaml"
    found = read_yaml(path)
    if not found:
        raise UnreadableRun(f"There is no {path.name} in {path.parent}: give `relocalize` a -relocalize_reference.")
    try:
        return [*error_rows(found), *value_rows(found), *frame_rows(found.get("frames", {})),
                *probe_rows(found.get("probes", {}))]
    except (KeyError, TypeError, ValueError) as error:
        raise UnreadableRun(
            f"{path} is not what this version of `relocalize` writes ({error!r}): run it again.") from error


def row(measure, part, component, values, time=None):
    """`values` by source; YAML reads 1e-05 as text, hence the conversion."""
    return {"measure": measure, "part": part, "component": component, "time": time,
            **{source: float(values[source]) if source in values else None for source in SOURCES}}


def parts_of(group):
    """Pairs of a part's name and what is said of it."""
    for name, said in group.items():
        if name == "phases":
            yield from said.items()
        elif isinstance(said, dict):
            yield name, said


def error_rows(found):
    groups = {"error": found.get("error", {}),
              **{"error_" + name.replace(" ", "_"): said for name, said in found.get("statistics", {}).items()}}
    return [row(measure, part, component, said[component])
            for measure, group in groups.items() for part, said in parts_of(group) for component in COMPONENTS]


def value_rows(found):
    rows = [row("average", part, component, said[component])
            for part, said in parts_of(found.get("mean", {})) for component in COMPONENTS]
    quantiles = found.get("quantiles", {})
    for part, said in parts_of(quantiles):
        for component in COMPONENTS:
            for k, level in enumerate(quantiles["levels"]):
                rows.append(row(f"quantile_{float(level):g}", part, component,
                                {source: said[component][source][k] for source in SOURCES}))
    return rows


def frame_rows(frames):
    rows = []
    for component in COMPONENTS:
        for k, time in enumerate(frames.get("time", [])):
            values = {source: frames["all"][component][source][k] for source in SOURCES[1:]}
            rows.append(row("frame_error", "all", component, values, float(time)))
    return rows


def probe_rows(probes):
    rows = []
    for probe in probes.values():
        where = f"{probe['region']} at {', '.join(f'{1e3 * float(x):.4g}' for x in probe['x'])} mm"
        for component in COMPONENTS:
            for kind in ("correlation", "slope", "error"):
                values = {source: probe[component][source][kind] for source in SOURCES[1:]}
                rows.append(row(f"probe_{kind}", where, component, values))
    return rows


def weighted_quantile(values, weights, level):
    """The least of `values` [n] below or at which lies the part `level` of the `weights` [n]."""
    order = np.argsort(values)
    reached = np.cumsum(weights[order])
    return values[order][np.searchsorted(reached, level * reached[-1]).clip(max=len(values) - 1)]


def phase_values(file, quantity):
    """Averages over the area and all frames, and quantiles of the last frame, of each phase and component.

    `file` is a `reading.Fields`. A dict by measure, phase and component, in the unit of `quantity`.
    """
    _, area = centroids_and_areas(file.coordinates, file.triangles, file.cell_of_triangle)
    phases = {name: file.region == k for k, name in enumerate(file.region_names) if np.any(file.region == k)}
    frames = [file.read(quantity, frame) for frame in range(len(file.time))]
    mean, last = np.mean(frames, axis=0), frames[-1]
    found = {}
    for phase, inside in phases.items():
        for i, component in enumerate(COMPONENTS):
            found["average", phase, component] = np.average(mean[inside, i], weights=area[inside])
            for level in LEVELS:
                found[f"quantile_{level:g}", phase, component] = weighted_quantile(last[inside, i], area[inside], level)
    return found


def compare_phases(relocalised, reference):
    """Rows for two composites that are alike but not the same, as one tiled with a periodic cell: the averages and
    quantiles of their phases. Both are folders, of `relocalize` and of the heterogeneous run. Raises UnreadableRun."""
    with Fields(reference) as file:
        expected = phase_values(file, "stress")
    with Fields(relocalised, "relocalized.h5", "relocalize") as file:
        found, homogeneous = phase_values(file, "stress"), phase_values(file, "homogeneous_stress")
    return [row(*key, {"reference": expected[key], "relocalised": found[key], "homogeneous": homogeneous[key]})
            for key in expected if key in found]


if __name__ == "__main__":
    raise SystemExit("relocalisation.comparison is a library, no command: snakemake --snakefile "
                     "runs/relocalisation/Snakefile runs the study.")
