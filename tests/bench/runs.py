"""Whole runs of `slide` in turn, from their summaries: ns per node and step (wall time), medians and the least.

    tests/bench/runs.py [-repeat 5] name='command' name='command' ...

Each command gets an output folder of its own; the first is what the others are compared with.
"""

import argparse
import re
import statistics
import subprocess
import tempfile
from pathlib import Path

COST = re.compile(r"^  ns_per_node_and_step: (\S+)", re.M)


def cost(command):
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run(f"{command} -output_folder {folder}/out", shell=True, check=True, stdout=subprocess.DEVNULL)
        return float(COST.search((Path(folder) / "out/summary.yaml").read_text()).group(1))


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("-repeat", type=int, default=5)
    parser.add_argument("run", nargs="+", help="name='command'")
    arguments = parser.parse_args()
    runs = [run.split("=", 1) for run in arguments.run]
    costs = {name: [] for name, _ in runs}
    for _ in range(arguments.repeat):
        for name, command in runs:
            costs[name].append(cost(command))
    first = costs[runs[0][0]]
    print("| run | ns per node and step | least | over the first: median | least |\n|---|---|---|---|---|")
    for name, values in costs.items():
        median, least = statistics.median(values), min(values)
        ratio = statistics.median(b / a for a, b in zip(first, values))
        print(f"| {name} | {median:.2f} | {least:.2f} | {ratio:.3f} | {least / min(first):.3f} |")


if __name__ == "__main__":
    main()
