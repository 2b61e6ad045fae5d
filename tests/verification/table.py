"""Runs every verification test once and writes what they found as a Markdown table.

    python3 tests/verification/table.py [build folder, default build/release] [--into tests/verification/README.md]

Without --into the table goes to standard output; with it, between the two `verification table` comments of that
file. Exit code 1 when a test fails.
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
    """Rows in the order of the tests, those of one case together."""
    printed = [(int(row[1]), row[2]) for row in map(ROW.match, log.splitlines()) if row]
    printed.sort(key=lambda each: each[0])  # tests run side by side and end as they like
    found = [tuple(row.split(" | ")) for row in dict.fromkeys(row for _, row in printed)]
    topics = list(dict.fromkeys(row[0] for row in found))
    return sorted(found, key=lambda row: topics.index(row[0]))


def markdown(rows):
    lines = ["| case | quantity | expected | found | order | against |", "|---|---|---|---|---|---|"]
    last = None
    for topic, *others in rows:
        lines.append(" | ".join(["| " + ("" if topic == last else topic), *others]) + " |")
        last = topic
    return "\n".join(lines) + "\n"


def main():
    arguments = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    arguments.add_argument("build", nargs="?", default="build/release", type=pathlib.Path)
    arguments.add_argument("--into", type=pathlib.Path, help="file that holds the two comments")
    chosen = arguments.parse_args()
    text = chosen.into.read_text() if chosen.into else ""
    if chosen.into and (BEGIN not in text or END not in text):
        sys.stderr.write(f"{chosen.into} lacks the comments '{BEGIN}' and '{END}': put them where the table belongs\n")
        return 2
    run = subprocess.run(["ctest", "--test-dir", chosen.build, "-L", "^verification$", "-LE", "^nightly$", "--verbose",
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
    before, rest = text.split(BEGIN, 1)
    chosen.into.write_text(f"{before}{BEGIN}\n{table}{END}{rest.split(END, 1)[1]}")
    return 0


if __name__ == "__main__":
    sys.exit(main())
