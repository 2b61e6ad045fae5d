"""The table of README.md, a time step over MATBAIJ's product: medians over processes in turn, each of which lets its
variants take turns.

    tests/bench/table.py build/release [-processes 3] [-nodes 24000,145000,580000] [-sizes 34.6e-6,9.1e-6]
"""

import argparse
import re
import statistics
import subprocess
import tempfile
from pathlib import Path

FIGURE = re.compile(r"^  (\S.*?) +([\d.]+) ns per node \(least +([\d.]+)\) +([\d.]+) x MATBAIJ$", re.M)
HEAD = re.compile(r"^(\d+) nodes.*?([\d.]+) % repeat", re.M)
VARIANTS = ("step", "step, pairs", "step, base instructions", "step, stiffness damping", "the same, single")


def fitted(build, size, folder):
    """A mesh of squares fitted to 45 discs."""
    recipe = "-shape disc -diameter .5e-3 -fraction .35 -cell grid -edge inside -gap .08e-3 -clearance .08e-3 -seed 1"
    subprocess.run(
        [build / "morphology", *recipe.split(), "-block_width", "5e-3", "-block_height", "5e-3", "-size", size,
         "-output_folder", folder], check=True, stdout=subprocess.DEVNULL)  # fmt: skip
    return folder / "mesh.msh"


def cases(build, arguments, folder):
    """[(what, options of bench_step)]"""
    found = []
    for nodes in filter(None, arguments.nodes.split(",")):
        for shape in ("triangles", "quadrilaterals", "general"):
            found.append((shape, ["-nodes", nodes, "-shape", shape]))
    for k, size in enumerate(filter(None, arguments.sizes.split(","))):
        found.append(("fitted to 45 discs", ["-mesh", fitted(build, size, folder / str(k))]))
    return found


def measured(build, options, arguments):
    """(nodes, per cent that repeat, ns of the product per node, {variant: ratio}), medians."""
    figures = []
    for _ in range(arguments.processes):
        text = subprocess.run(
            [build / "tests/bench/bench_step", *options, "-repetitions", str(arguments.repetitions)],
            check=True, capture_output=True, text=True).stdout  # fmt: skip
        nodes, repeat = HEAD.search(text).groups()
        figures.append({name: (float(median), float(ratio)) for name, median, _, ratio in FIGURE.findall(text)})
    product = statistics.median(f["MATBAIJ product"][0] for f in figures)
    ratios = {name: statistics.median(f[name][1] for f in figures) for name in VARIANTS}
    return nodes, repeat, product, ratios


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build", type=Path)
    parser.add_argument("-processes", type=int, default=3)
    parser.add_argument("-repetitions", type=int, default=9)
    parser.add_argument("-nodes", default="24000,145000,580000")
    parser.add_argument("-sizes", default="34.6e-6,9.1e-6", help="of the fitted squares, m")
    arguments = parser.parse_args()
    print("| nodes | mesh | repeat | `MATBAIJ` product | " + " | ".join(VARIANTS) + " |")
    print("|---" * (4 + len(VARIANTS)) + "|")
    with tempfile.TemporaryDirectory() as folder:
        for what, options in cases(arguments.build, arguments, Path(folder)):
            nodes, repeat, product, ratios = measured(arguments.build, options, arguments)
            row = " | ".join(f"{ratios[name]:.3f}".lstrip("0") for name in VARIANTS)
            print(f"| {nodes} | {what} | {repeat} % | {product:.1f} ns per node | {row} |", flush=True)


if __name__ == "__main__":
    main()
