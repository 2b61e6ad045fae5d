"""Says how many runs of a study came to their end, and fails if none did: a table of failures alone is no result.

    python3 -m slipscale.running.ended OUT/table.csv OUT/ended.txt

ended.txt holds the sentence; it is not there when no run came to its end, and the exit code is 1.
"""

import sys
from pathlib import Path

from slipscale.parser import Parser
from slipscale.running.attempt import write_whole
from slipscale.running.table import read_csv


def said(rows, table):
    """A sentence about the rows of the file `table`, and whether any is ok, or there is none at all."""
    ok = sum(row["status"] == "ok" for row in rows)
    if rows and not ok:
        return (f"None of the {len(rows)} rows of {table} is of a run that came to its end; the first: "
                f"{rows[0]['reason']}"), False
    return f"{ok} of the {len(rows)} rows of {table} are of runs that came to their end.", True


def main(arguments=None):
    parser = Parser("slipscale.running.ended", __doc__, "python3 -m")
    parser.add_argument("table", help="table.csv of a study")
    parser.add_argument("ended", type=Path, help="text file to write")
    asked = parser.parse_args(arguments)
    sentence, good = said(read_csv(asked.table), asked.table)
    print(sentence, file=sys.stderr)
    if good:
        write_whole(asked.ended, sentence + "\n")
    return 0 if good else 1


if __name__ == "__main__":
    sys.exit(main())
