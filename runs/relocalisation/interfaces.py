"""Tractions along the interfaces of the inclusions: a heterogeneous run of `slide` against `relocalize`, as rows of a table
(comparison.py). The measures:

interface_error                relative L2 error over the interfaces and all times, part all, layer or bulk, component normal or
                               shear
interface_index                largest debonding index over the interfaces and all times
debonded                       number of inclusions whose index reaches 1
first_inclusion, first_time    number of the inclusion whose index is the first to reach 1, and when [s]; None where none does
first_x, first_y               where [m]
same_inclusion                 part of the inclusions that debond in the heterogeneous run that debond in the other, too
false_inclusion                part of those that debond in the other that do not in the heterogeneous run

Nodes that are also on the outer boundary are left out, as in the files. The index is that of the strengths the programs were
given.
"""

from pathlib import Path

import h5py
import numpy as np

from slipscale.reading.files import UnreadableRun, open_hdf5, read_dataset

SOURCES = ("reference", "relocalised", "homogeneous")


class Interfaces:
    """interfaces.h5: time [n] s; x, y, length [ni] m; inclusion [ni]; inner [ni] (not on the outer boundary); normal, shear
    [n, ni] Pa, index [n, ni] or None; of the variant `of` ("" or "homogeneous")."""

    def __init__(self, folder, of="", program="slide"):
        prefix, self.folder = of and f"{of}/", folder
        with open_hdf5(Path(folder) / "interfaces.h5", program) as file:
            rows = min(len(item) for item in (file["time"], file[f"{prefix}shear_traction"]))
            self.time = read_dataset(file, "time")[:rows]
            self.x, self.y, self.length = (read_dataset(file, name) for name in ("x", "y", "length"))
            self.inclusion = read_dataset(file, "inclusion").astype(int)
            self.inner = read_dataset(file, "outer") == 0
            self.normal, self.shear = (read_dataset(file, f"{prefix}{name}_traction")[:rows] for name in ("normal", "shear"))
            self.index = file[f"{prefix}index"][:rows] if isinstance(file.get(f"{prefix}index"), h5py.Dataset) else None


def same_times(times, reference):
    """Pairs of rows whose times are nearest, at most half of the distance of the rows of either apart."""
    half = 0.5 * min(np.median(np.diff(each)) for each in (times, reference) if len(each) > 1)
    nearest = np.abs(reference[None, :] - times[:, None]).argmin(axis=1)
    return [(row, other) for row, other in enumerate(nearest) if abs(reference[other] - times[row]) <= half]


def places(found, reference):
    """Nodes of `reference` at those of `found`; raises UnreadableRun where the interfaces are not the same."""
    if len(found.x) != len(reference.x):
        raise UnreadableRun(f"The interfaces of {found.folder} and {reference.folder} have different nodes: make both anew.")
    order = [np.lexsort((np.round(part.y, 12), np.round(part.x, 12), part.inclusion)) for part in (found, reference)]
    match = np.empty(len(found.x), int)
    match[order[0]] = order[1]
    if np.hypot(found.x - reference.x[match], found.y - reference.y[match]).max() > 1e-9:
        raise UnreadableRun(f"The interfaces of {found.folder} and {reference.folder} have different nodes: make both anew.")
    return match


def relative(found, expected, weight):
    return np.sqrt(np.sum(weight * (found - expected) ** 2) / np.sum(weight * expected ** 2))


def first(part):
    """(inclusion, time, x, y) of the first index of 1, or None."""
    if part.index is None:
        return None
    over = (part.index >= 1) & part.inner
    rows = np.flatnonzero(over.any(axis=1))
    if not len(rows):
        return None
    node = int(np.argmax(np.where(part.inner, part.index[rows[0]], -1)))
    return int(part.inclusion[node]), float(part.time[rows[0]]), float(part.x[node]), float(part.y[node])


def debonded(part):
    over = ((part.index >= 1) & part.inner).any(axis=0)
    return set(part.inclusion[over])


def compare_interfaces(relocalised, reference, layer, bulk, row):
    """Rows, made by `row(measure, part, component, values)`; folders of `relocalize` and of `slide`. `layer` and `bulk`, m, as
    of `relocalize`."""
    expected = Interfaces(reference)
    found = {of: Interfaces(relocalised, variant, "relocalize")
             for of, variant in (("relocalised", ""), ("homogeneous", "homogeneous"))}
    match = places(found["relocalised"], expected)
    pairs = same_times(found["relocalised"].time, expected.time)
    if not pairs:
        raise UnreadableRun(f"The interfaces of {relocalised} and {reference} have no time in common: choose another "
                            "interfaces_interval.")
    ours, theirs = (np.array(rows) for rows in zip(*pairs, strict=True))
    some = found["relocalised"]
    box = [(values.min(), values.max()) for values in (some.x, some.y)]
    parts = {"all": some.inner, "layer": some.inner & (some.y < layer),
             "bulk": some.inner & (some.y > bulk) & (some.y < box[1][1]) & (some.x > box[0][0]) & (some.x < box[0][1])}
    rows = []
    for part, inside in parts.items():
        for component in ("normal", "shear"):
            true = getattr(expected, component)[theirs][:, match][:, inside]
            if true.size and np.any(true):
                rows.append(row("interface_error", part, component, {
                    of: relative(getattr(each, component)[ours][:, inside], true, each.length[inside])
                    for of, each in found.items()}))
    if expected.index is None:
        return rows
    # At the times that all have.
    expected.index, expected.time = expected.index[theirs], expected.time[theirs]
    every = {"reference": expected, **found}
    for of, each in found.items():
        each.index, each.time = each.index[ours], each.time[ours]
    rows.append(row("interface_index", "all", "index", {of: each.index[:, each.inner].max() for of, each in every.items()}))
    began = {of: at for of, each in every.items() if (at := first(each)) is not None}
    for k, name in enumerate(("first_inclusion", "first_time", "first_x", "first_y")):
        rows.append(row(name, "all", "index", {of: at[k] for of, at in began.items()}))
    true = debonded(expected)
    sets = {of: debonded(each) for of, each in found.items()}
    rows.append(row("debonded", "all", "index", {"reference": len(true), **{of: len(each) for of, each in sets.items()}}))
    rows.append(row("same_inclusion", "all", "index",
                    {of: len(each & true) / len(true) for of, each in sets.items() if true}))
    rows.append(row("false_inclusion", "all", "index",
                    {of: len(each - true) / len(each) for of, each in sets.items() if each}))
    return rows


if __name__ == "__main__":
    raise SystemExit("relocalisation.interfaces is a library, no command: snakemake --snakefile "
                     "runs/relocalisation/Snakefile runs the study.")
