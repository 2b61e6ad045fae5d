"""Collects the runs of the study in one table, a row for each number compared; run by the Snakefile."""

from pathlib import Path

import yaml

from analysis.comparison import compare_phases, read_comparison
from analysis.reading import Summary
from analysis.table import collect, write_csv


def outcome_of(path):
    return yaml.safe_load(Path(path).read_text())


def costs(run, before):
    """Seconds that a processor computed, by program: relocalize's hold its comparison."""
    return {f"{name}_seconds": outcome_of(path)["cpu_seconds"]
            for name, path in {"relocalize": run, **before}.items()}


def frequencies(before):
    """The strongest in the friction of both runs, Hz; None without a spectrum."""
    found = {}
    for scale in ("heterogeneous", "homogeneous"):
        peaks = Summary(Path(before[scale]).parent).headline.get("spectrum_peaks") or [None]
        found[f"{scale}_frequency"] = peaks[0]
    return found


def rows_of(run, before):
    """A failed run has one row with its reason."""
    run = Path(run)
    row = collect([run], lambda folder: {**costs(run, before), **frequencies(before)})[0]
    if row["status"] != "ok":
        return [row]
    if row["tensors"] == "periodic":
        compared = compare_phases(run.parent, Path(before["heterogeneous"]).parent)
    else:
        compared = read_comparison(run.parent)
    return [{**row, **found} for found in compared]


write_csv(snakemake.output[0],  # noqa: F821
          [row for run, before in zip(snakemake.input.outcomes, snakemake.params.before)  # noqa: F821
           for row in rows_of(run, before)])
