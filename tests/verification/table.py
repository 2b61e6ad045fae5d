"""Runs every verification test and writes what they found as a Markdown table.

    /usr/bin/python3 tests/verification/table.py [build folder, default build/release] [--into README.md]

Without --into the table goes to standard output; with it, between the two `verification table` comments of that
file. A row that ranks disagree on appears once for each finding, with its ranks. Exit code 1 when a test fails.
"""

import argparse
import os
import pathlib
import re
import subprocess
import sys

ROW = re.compile(r"^(\d+): verification \| (.*)$")
BEGIN, END = "<!-- verification table: begin -->", "<!-- verification table: end -->"


def findings(log):
    """Rows in the order of the tests, each with the sorted rank counts that found it."""
    ranks, printed, rows = {}, [], {}
    for line in log.splitlines():
        if started := re.match(r"^\s*Start\s+(\d+): \S+\.np(\d+)", line):
            ranks[int(started[1])] = int(started[2])
        elif row := ROW.match(line):
            printed.append((int(row[1]), row[2]))
    for test, row in sorted(printed, key=lambda each: each[0]):  # tests run side by side and end as they like
        rows.setdefault(row, set()).add(ranks[test])
    found = [(tuple(row.split(" | ")), sorted(on)) for row, on in rows.items()]
    topics = list(dict.fromkeys(row[0] for row, _ in found))  # keep a case together
    return sorted(found, key=lambda entry: topics.index(entry[0][0]))


def markdown(rows):
    lines = ["| case | quantity | expected | found | order | ranks | source |", "|---|---|---|---|---|---|---|"]
    last = None
    for (topic, quantity, expected, found, order, source), on in rows:
        shown = "" if topic == last else topic
        lines.append(f"| {shown} | {quantity} | {expected} | {found} | {order} | {' '.join(map(str, on))} | {source} |")
        last = topic
    return "\n".join(lines) + "\n"


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("build", nargs="?", default="build/release", type=pathlib.Path)
    arguments.add_argument("--into", type=pathlib.Path, help="file that holds the two comments")
    chosen = arguments.parse_args()
    run = subprocess.run(["ctest", "--test-dir", chosen.build, "-L", "^verification$", "--verbose",
                          "--parallel", str(os.cpu_count())],
                         capture_output=True, text=True)
    rows = findings(run.stdout)
    if run.returncode or not rows:
        sys.stderr.write("\n".join(run.stdout.splitlines()[-30:]) + run.stderr + "\nverification failed\n")
        return 1
    table = markdown(rows)
    if not chosen.into:
        print(table, end="")
        return 0
    text = chosen.into.read_text()
    if BEGIN not in text or END not in text:
        sys.stderr.write(f"{chosen.into} lacks the comments '{BEGIN}' and '{END}': put them where the table belongs\n")
        return 2
    before, rest = text.split(BEGIN, 1)
    chosen.into.write_text(f"{before}{BEGIN}\n{table}{END}{rest.split(END, 1)[1]}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
