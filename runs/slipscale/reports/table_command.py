"""Rows and columns of a study's table as text.

    slipscale table out/sweep/table.csv [--columns friction_coefficient friction regime] [--where size=0.000125]
        [--sort friction] [--markdown]

Without --columns: the options that were varied, and what was found. Rows that failed, or lack something, keep their
reason. A folder may be given in place of its table.csv.
"""

from pathlib import Path

from slipscale.mistakes import Mistake
from slipscale.parser import Parser
from slipscale.reports.compare import aligned
from slipscale.running.attempt import number_or_text
from slipscale.running.table import OUTCOME, markdown, read_csv

FOUND = ("friction", "friction_error", "frequency", "amplitude", "stick", "open", "power_ratio", "settled",
         "amplitude_ratio", "regime", *OUTCOME[:2])


def chosen_columns(rows, columns):
    """The names of the columns. Raises Mistake for one that is not there."""
    known = list(dict.fromkeys(name for row in rows for name in row))
    if unknown := [name for name in columns or () if name not in known]:
        raise Mistake(f"the table has no column {unknown[0]}: it has {', '.join(known)}")
    if columns:
        return columns
    before = known[:known.index(OUTCOME[0])] if OUTCOME[0] in known else known
    varied = [name for name in before if len({str(row.get(name)) for row in rows}) > 1]
    found = [name for name in FOUND if name in known] if OUTCOME[0] in known else []
    failed = any(row.get("status") != "ok" or row.get("reason") for row in rows)
    return [*(varied or before), *(name for name in found if failed or name not in OUTCOME)]


def cell(value):
    if value is None:
        return ""
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def chosen_rows(rows, where, sort):
    """Rows whose columns have the values of `where`, in the order of a column. Raises Mistake."""
    for name, value in where.items():
        chosen_columns(rows, [name])
        rows = [row for row in rows if row.get(name) == value]
    if not rows:
        raise Mistake(f"no row has {', '.join(f'{name} {value}' for name, value in where.items())}")
    if sort:
        chosen_columns(rows, [sort])
        rows = sorted(rows, key=lambda row: (row.get(sort) is None, isinstance(row.get(sort), str), row.get(sort)))
    return rows


def main(arguments=None):
    parser = Parser("table", __doc__)
    parser.add_argument("table", help="table.csv of a study, or its folder")
    parser.add_argument("--columns", nargs="+", help="names of columns")
    parser.add_argument("--where", nargs="+", default=[], metavar="NAME=VALUE", help="only these rows")
    parser.add_argument("--sort", metavar="COLUMN", help="order of the rows")
    parser.add_argument("--markdown", action="store_true", help="as a table of Markdown")
    asked = parser.parse_args(arguments)
    path = Path(asked.table)
    path = path / "table.csv" if path.is_dir() else path
    if not path.is_file():
        raise Mistake(f"there is no {path}: give the table.csv of a study")
    rows = read_csv(path)
    if not rows:
        raise Mistake(f"{path} has no rows")
    where = {name: number_or_text(value) for name, _, value in (word.partition("=") for word in asked.where)}
    rows = chosen_rows(rows, where, asked.sort)
    columns = chosen_columns(rows, asked.columns)
    cells = [[cell(row.get(name)) for name in columns] for row in rows]
    print(markdown(columns, cells) if asked.markdown else aligned([columns, *cells]))
    return 0
