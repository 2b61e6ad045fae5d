"""The table of a study: its runs, spelled out from lists of values, and one tidy row for each, failures included."""

import csv
import io
import itertools
from pathlib import Path

from slipscale.reading.yaml_file import load
from slipscale.running.attempt import number_or_text, write_whole

OUTCOME = ("status", "reason", "wall_seconds")


def grid(values):
    """All combinations of a dict of values, lists standing for several: {a: [1, 2], b: 3} gives {a: 1, b: 3} and
    {a: 2, b: 3}."""
    lists = [value if isinstance(value, list) else [value] for value in values.values()]
    return [dict(zip(values, chosen)) for chosen in itertools.product(*lists)]


def run_name(options):
    """The values of all options, joined with '_'."""
    return "_".join(str(value) for value in options.values())


def named_runs(groups, defaults):
    """The runs of all groups (a dict of grids; an empty list leaves a group out) by `run_name`. A run that several
    groups ask for is there once. `defaults` holds every option."""
    runs = {}
    for group in groups.values():
        for options in grid(group):
            if unknown := options.keys() - defaults.keys():
                raise ValueError(f"unknown option {sorted(unknown)[0]!r} in a group of runs: known are "
                                 f"{', '.join(defaults)}")
            options = {**defaults, **options}
            runs[run_name(options)] = options
    return runs


def collect(outcomes, read):
    """Rows (dicts) in the order of `outcomes` (paths of outcome.yaml): the options, how the run ended, and for one that
    is ok what `read(folder)` gives, which may say for what `reason` some of it is empty."""
    rows = []
    for path in map(Path, outcomes):
        outcome = load(path, written=True)
        row = {**outcome["options"], **{name: outcome[name] for name in OUTCOME}}
        if outcome["status"] == "ok":
            found = read(path.parent)
            if hidden := outcome["options"].keys() & found.keys():
                raise ValueError(f"{path}: {sorted(hidden)[0]!r} is both an option and a result: rename the option")
            row.update(found)
        rows.append(row)
    return rows


def is_true(value):
    """Whether a cell, of a row or as read from a file, says yes."""
    return value is True or value == "true"


def cell_of(value):
    """A value as a file holds it: yes and no as YAML has them."""
    return str(value).lower() if isinstance(value, bool) else value


def write_csv(path, rows):
    """One line for each row; columns in the order in which they first appear, empty where a row has no value."""
    columns = list(dict.fromkeys(name for row in rows for name in row))
    text = io.StringIO()
    writer = csv.DictWriter(text, columns, lineterminator="\n")
    writer.writeheader()
    writer.writerows({name: cell_of(value) for name, value in row.items()} for row in rows)
    write_whole(Path(path), text.getvalue())


def read_csv(path):
    """Rows as dicts, numbers as int or float, what is empty as None; of a folder its table.csv."""
    path = Path(path) / "table.csv" if Path(path).is_dir() else path
    with Path(path).open(newline="") as file:
        return [{name: number_or_text(text) for name, text in row.items()} for row in csv.DictReader(file)]


def quickest(rows, same, seconds="seconds"):
    """Of rows that are ok and agree in the columns `same`, the one with the least `seconds`; in order of appearance."""
    best = {}
    for row in rows:
        if row["status"] == "ok":
            key = tuple(row[name] for name in same)
            if key not in best or row[seconds] < best[key][seconds]:
                best[key] = row
    return list(best.values())


def markdown(header, rows):
    """A Markdown table of texts."""
    lines = [header, ["---"] * len(header), *rows]
    return "".join("| " + " | ".join(str(cell) for cell in line) + " |\n" for line in lines)


def replace_between(path, name, text):
    """Puts `text` between the lines '<!-- NAME: begin … -->' and '<!-- NAME: end -->' of a file; ValueError without."""
    lines = Path(path).read_text().splitlines(keepends=True)
    begin = [k for k, line in enumerate(lines) if line.startswith(f"<!-- {name}: begin")]
    end = [k for k, line in enumerate(lines) if line.startswith(f"<!-- {name}: end")]
    if not (len(begin) == len(end) == 1 and begin[0] < end[0]):
        raise ValueError(f"{path} needs one line '<!-- {name}: begin -->' and below it one '<!-- {name}: end -->'")
    write_whole(Path(path), "".join(lines[:begin[0] + 1]) + text + "".join(lines[end[0]:]))
