"""Collects the runs of the study in one table, a row for each number compared; run by the Snakefile."""

from pathlib import Path

import numpy as np

from relocalisation.comparison import compare_phases, read_comparison
from relocalisation.comparison import row as compared_row
from relocalisation.interfaces import compare_interfaces
from slipscale.reading import Statistics, Summary
from slipscale.reading.mesh import centroids_and_areas
from slipscale.reading.yaml_file import load
from slipscale.running.studies import started_by_snakemake
from slipscale.running.table import collect, write_csv


def outcome_of(path):
    return load(path, written=True)


def costs(run, before):
    """Seconds that a processor computed, by program: relocalize's hold its comparison."""
    return {f"{name}_seconds": outcome_of(path)["cpu_seconds"]
            for name, path in {"relocalize": run, **before}.items()}


def vibrations(before):
    """Of both runs: the strongest frequency of friction, Hz, and the standard deviation of σ_yy over time, root of its
    mean square over the area, Pa; None where a run has no spectrum or no statistics."""
    found = {}
    for scale in ("heterogeneous", "homogeneous"):
        folder = Path(before[scale]).parent
        peaks = Summary(folder).headline.get("spectrum_peaks") or [None]
        found.update({f"{scale}_frequency": peaks[0], f"{scale}_deviation": deviation(folder)})
    return found


def deviation(folder):
    if not (folder / "statistics.h5").is_file():
        return None
    with Statistics(folder) as file:
        _, area = centroids_and_areas(file.coordinates, file.triangles, file.cell_of_triangle)
        return np.sqrt(np.average(file.read("deviation")[:, 1]**2, weights=area))


def rows_of(run, before):
    """A failed run has one row with its reason."""
    run = Path(run)
    row = collect([run], lambda folder: {**costs(run, before), **vibrations(before)})[0]
    if row["status"] != "ok":
        return [row]
    if row["tensors"] == "periodic":
        compared = compare_phases(run.parent, Path(before["heterogeneous"]).parent)
    else:
        depths = {name: float(job.params.compare[name]) for name in ("layer", "bulk")}
        compared = [*read_comparison(run.parent),
                    *compare_interfaces(run.parent, Path(before["heterogeneous"]).parent, **depths, row=compared_row)]
    return [{**row, **found} for found in compared]


job = started_by_snakemake(globals())
write_csv(job.output[0],
          [row for run, before in zip(job.input.outcomes, job.params.before)
           for row in rows_of(run, before)])
