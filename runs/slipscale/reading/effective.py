"""What `homogenize` found and what it cost, from its effective.yaml, as columns of a table."""

from pathlib import Path

from slipscale.reading import UnreadableRun, read_yaml

SIX = ("C11", "C22", "C12", "C66", "C16", "C26")


def read_effective(folder):
    """Columns: unknowns, cells, ranks, method (of the solver), iterations (the most of the three load cases),
    set_up_seconds, solve_seconds (of the three), seconds (in all), memory (B), C11 … C26 (Pa).

    They are those of the boundary condition that gave the stiffness. Raises UnreadableRun.
    """
    path = Path(folder) / "effective.yaml"
    found = read_yaml(path)
    try:
        report = found["homogenize"]
        cost = report[report["boundary"]]["cost"]
        return {"unknowns": cost["unknowns"], "cells": report["cells"], "ranks": report["ranks"],
                "method": cost["solver"], "iterations": max(cost["iterations"]),
                "set_up_seconds": float(cost["set_up_seconds"]),
                "solve_seconds": sum(map(float, cost["solve_seconds"])),
                "seconds": float(report["seconds"]), "memory": float(report["memory"]),
                **dict(zip(SIX, map(float, found["stiffness"]), strict=True))}
    except (KeyError, TypeError, ValueError) as error:
        raise UnreadableRun(
            f"{path} is not what this version of `homogenize` writes ({error!r}): run it again.") from error


def square_symmetric(row):
    """The three moduli of a solid with square symmetry from a row of six: no mesh of triangles has that symmetry, so
    that C11 and C22 differ by less than their errors and are averaged."""
    return {"C11": 0.5 * (row["C11"] + row["C22"]), "C12": row["C12"], "C66": row["C66"]}


def relative_errors(moduli, reference):
    """Columns error_<modulus>: the relative distance from each modulus of `reference` (a dict, Pa), signed."""
    return {f"error_{name}": moduli[name] / float(value) - 1 for name, value in reference.items()}
