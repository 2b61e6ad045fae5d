"""Memory of a run of `slide` beyond what the program takes on a mesh of 100 nodes, in bytes per node: at its highest, and
while it steps.

    tests/bench/memory.py build/release [-nodes 580000] [-shape quadrilaterals] [options of slide]
"""

import argparse
import os
import subprocess
import tempfile
import time
from pathlib import Path

SCENE = """\
material: {all: {young: 45e9, poisson: .25, density: 1800}}
surface: {boundary: bottom, height: 0, speed: 2}
friction: {law: regularized, coefficient: .5, length: 1.2e-6}
boundary: {top: {x: fixed, y: -1.39e-6, ramp: 40e-6}}
"""
STEPS = 100


def mesh_of(build, nodes, shape, path):
    subprocess.run([build / "tests/bench/bench_step", "-nodes", str(nodes), "-shape", shape, "-write", path], check=True)
    return path


def resident(process):
    """kB now; 0 when the process is gone."""
    try:
        lines = Path(f"/proc/{process}/status").read_text().splitlines()
    except OSError:
        return 0
    return next((int(line.split()[1]) for line in lines if line.startswith("VmRSS")), 0)


def memory(build, mesh, options, folder):
    """(highest, last seen) of a run, bytes."""
    (folder / "scene.yaml").write_text(SCENE)
    run = [build / "slide", "-options_file_yaml", folder / "scene.yaml", "-mesh_file", mesh, "-output_folder", folder / "out",
           "-time_step", "1e-9", "-time_end", str(STEPS * 1e-9), *options]  # fmt: skip
    process = subprocess.Popen(run, stdout=subprocess.DEVNULL)
    seen = 0
    while True:
        done, status, usage = os.wait4(process.pid, os.WNOHANG)
        if done:
            break
        seen = resident(process.pid) or seen
        time.sleep(0.01)
    assert status == 0, run
    return 1024 * usage.ru_maxrss, 1024 * seen


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build", type=Path)
    parser.add_argument("-nodes", type=int, default=580000)
    parser.add_argument("-shape", default="quadrilaterals")
    arguments, options = parser.parse_known_args()
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        own = memory(arguments.build, mesh_of(arguments.build, 100, arguments.shape, folder / "small.msh"), options, folder)
        mesh = mesh_of(arguments.build, arguments.nodes, arguments.shape, folder / "large.msh")
        whole = memory(arguments.build, mesh, options, folder)
    highest, steady = ((a - b) / arguments.nodes for a, b in zip(whole, own))
    print(f"{arguments.nodes} nodes, {arguments.shape}: {highest:.0f} bytes per node at the highest, {steady:.0f} while it steps; "
          f"the program itself {own[0] / 1e6:.0f} MB")  # fmt: skip


if __name__ == "__main__":
    main()
