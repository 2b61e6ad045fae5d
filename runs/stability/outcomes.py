"""What other studies saw: the rows of a folded table in their README, or of a CSV file."""

import re
from pathlib import Path

from slipscale.mistakes import Mistake
from slipscale.running.attempt import number_or_text
from slipscale.running.table import read_csv


def markdown_rows(text, *heads):
    """Rows (dicts, numbers as such) of the first table of a Markdown text whose header has all `heads`."""
    lines = text.splitlines()
    for k, line in enumerate(lines[:-1]):
        cells = cells_of(line)
        if set(heads) <= set(cells) and re.fullmatch(r"[|\s:-]+", lines[k + 1] or "-|"):
            rows = []
            for row in lines[k + 2:]:
                if not row.startswith("|"):
                    break
                rows.append({name: number_or_text(value) for name, value in zip(cells, cells_of(row))})
            return rows
    raise Mistake(f"there is no table with the columns {', '.join(heads)}")


def cells_of(line):
    return [cell.strip() for cell in line.strip().strip("|").split("|")]


def outcomes(path, *heads):
    """Rows of a table in `path`, a README.md or a CSV file. Raises Mistake."""
    if Path(path).suffix == ".csv":
        return read_csv(path)
    try:
        return markdown_rows(Path(path).read_text(), *heads)
    except (OSError, Mistake) as error:
        raise Mistake(f"{path} does not say what was seen: {error}") from error


def swept(path):
    """Of the study `sweep`: dicts of coefficient, speed (m/s), size (m), frequency (Hz), amplitude, regime, settled."""
    rows = outcomes(path, "friction_coefficient", "surface_speed", "size", "amplitude", "regime")
    return [{"coefficient": row["friction_coefficient"], "speed": row["surface_speed"], "size": row["size"],
             "frequency": row.get("frequency [Hz]", row.get("frequency")), "amplitude": row["amplitude"],
             "regime": row["regime"], "settled": row["settled"]}
            for row in rows if row["status"] == "ok" and row["amplitude"] is not None]


def verdicts(path):
    """Of the study `equivalence`: dicts of coefficient, load (MPa), speed, memory, block, verdict."""
    rows = outcomes(path, "coefficient", "load", "speed", "memory", "block", "verdict")
    return [{name: row[name] for name in ("coefficient", "load", "speed", "memory", "block", "verdict")} for row in rows]


if __name__ == "__main__":
    raise SystemExit("stability.outcomes is a library, no command: snakemake --snakefile runs/stability/Snakefile runs "
                     "the study.")
