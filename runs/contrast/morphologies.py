"""Morphologies of one composite beside their homogenised blocks: pairs of rows of a table, in groups, and their spread.

Rows have the columns `young`, `diameter`, `size`, `seed`, `model` and what was measured.
"""

import numpy as np

COMPOSITE = ("young", "diameter", "size", "seed")


def paired(rows):
    """Pairs (heterogeneous, homogeneous row) of the composites for which both runs are ok, in the table's order."""
    ok = {(row["model"], *(row[name] for name in COMPOSITE)): row for row in rows if row["status"] == "ok"}
    return [(row, ok["homogeneous", *key[1:]]) for key, row in ok.items()
            if key[0] == "heterogeneous" and ("homogeneous", *key[1:]) in ok]


def groups_of(pairs):
    """Pairs by (diameter, young), discs from large to small, each on the mesh that most morphologies have."""
    groups = {}
    for key in sorted({(-own["diameter"], own["young"]) for own, _ in pairs}):
        members = [pair for pair in pairs if (-pair[0]["diameter"], pair[0]["young"]) == key]
        sizes = [own["size"] for own, _ in members]
        usual = max(dict.fromkeys(sizes), key=sizes.count)
        groups[-key[0], key[1]] = [pair for pair in members if pair[0]["size"] == usual]
    return groups


def spread(values):
    """Standard deviation over mean of a list; with n values, the unbiased one. 0 of a single value."""
    return float(np.std(values, ddof=1) / np.mean(values)) if len(values) > 1 else 0.0


def rank_correlation(a, b):
    """Spearman's, of two lists without equal values; nan for fewer than three."""
    if len(a) < 3:
        return float("nan")
    ranks = [np.argsort(np.argsort(values)) for values in (a, b)]
    return float(np.corrcoef(*ranks)[0, 1])


def fold(values):
    """Largest over smallest."""
    return max(values) / min(values)


if __name__ == "__main__":
    raise SystemExit("contrast.morphologies is a library, no command: snakemake --snakefile runs/contrast/Snakefile "
                     "runs the study.")
