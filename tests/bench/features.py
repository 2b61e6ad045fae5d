"""What each feature of a scene costs: it alone against the bare scene, in turn, medians of processor time.

    tests/bench/features.py build/release [-size 62.5e-6] [-steps 6000] [-repeat 5] [-only damping]

Bare: a block with discs of the same material as the rest, pressed on a surface without friction, no row of any output after
the first. Of each run and one of a fifth of the steps: nanoseconds per node and step are the difference, set-up seconds what
is left; bytes are the most that the program held beyond the bare scene, of a node. A Markdown table.
"""

import argparse
import os
import statistics
import subprocess
import tempfile
from pathlib import Path

BARE = {"material_all_young": 45e9, "material_all_poisson": 0.25, "material_all_density": 1800, "surface_boundary": "bottom",
        "surface_speed": 2, "friction_law": "none", "boundary_top_x": "fixed", "boundary_top_y": -1.39e-6,
        "boundary_top_ramp": 4e-5, "time_step": 4e-9, "history_every": 10**7, "history_boundary": "top",
        "contact_every": 10**7, "contact_sums": "false", "checkpoint_minutes": 0, "progress": "none"}
FRICTION = {"friction_law": "regularized", "friction_coefficient": 0.5, "friction_time": 6e-7}
ROWS = {"history_every": 10}
FREE = {"boundary_top_x": None, "boundary_top_y": None, "boundary_top_ramp": None}
TABLE = Path("initial.csv")  # in the folder of the runs
FEATURES = {  # name: options on top of the bare scene; None leaves one out
    "bare": {},
    "mass damping": {"damping_mass": 100},
    "stiffness damping": {"damping_stiffness": 2e-9},
    "beta2 .6": {"time_beta2": 0.6},
    "a second material": {"material_inclusion_young": 80e9, "material_inclusion_poisson": 0.25,
                          "material_inclusion_density": 1800},
    "a graded material": {"material_all_young": "45e9*(1 + 0.5*y/H)"},
    "Coulomb's law": {"friction_law": "coulomb", "friction_coefficient": 0.5},
    "regularised law, threshold instantaneous": FRICTION,
    "regularised law, threshold regularised": {**FRICTION, "friction_threshold": "regularized"},
    "regularised law of the slip rate": {"friction_law": "regularized", "friction_coefficient": 0.5, "friction_rate": "slip",
                                         "friction_length": 1.2e-6, "friction_rate_reference": 1},
    "a coefficient that falls with the slip rate": {**FRICTION, "friction_law": "exponential", "friction_kinetic": 0.3,
                                                    "friction_slip_rate": 1},
    "friction of each phase": {**FRICTION, "friction_matrix_coefficient": 0.7, "friction_matrix_time": 3e-7},
    "a coefficient that is a formula of the place": {**FRICTION, "friction_coefficient": "0.5 + 0.1*sin(2*pi*x/L)"},
    "the same of place and time": {**FRICTION, "friction_coefficient": "0.5 + 0.1*sin(2*pi*(x/L - t/1e-5))"},
    "a surface speed that is a formula of time": {**FRICTION, "surface_speed": "2*(1 + 0.1*sin(2*pi*t/1e-5))"},
    "an upper side that is free": FREE,
    "a pressure on it that is a formula of place and time": {**FREE, "boundary_top_pressure": "1e6*(1 + x/L*sin(2*pi*t/1e-5))"},
    "an open end": {**FREE, "boundary_top_absorbing": "true", "initial_pressure": 1e6},
    "an initial state from a table of 100 x 100 points": {"initial_file": TABLE},
    "a rigid side with a plate": {"boundary_top_y": "rigid", "boundary_top_force": 7e4, "boundary_top_mass": 0.1},
    "history, a row in 10 steps": ROWS,
    "the same with five probes": {**ROWS, "history_points": "1e-3,0,2e-3,0,2.5e-3,0,3e-3,1e-3,4e-3,2e-3"},
    "the same with momenta": {**ROWS, "history_momentum": "true"},
    "contact, a row in 10 steps": {"contact_every": 10},
    "sums over every step at the contact": {"contact_sums": "true"},
    "the same sums, a row in 10 steps at the contact": {"contact_sums": "true", "contact_every": 10},
    "damping work of the cells, beside stiffness damping": {"damping_stiffness": 2e-9, "fields_every": 10**7,
                                                            "fields_quantities": "damping_work"},
    "interfaces, a row in 1000 steps": {"interfaces_region": "inclusion", "interfaces_every": 1000},
    "interfaces, a row in 10 steps": {"interfaces_region": "inclusion", "interfaces_every": 10},
    "fields, a frame in 500 steps": {"fields_every": 500},
    "statistics of every 20th step": {"statistics_from": 0, "statistics_every": 20},
    "checkpoint every 1000 steps": {"checkpoint_every": 1000},
    "periodic sides": {},
    "single storage": {"stiffness_storage": "single"},
}
PERIODIC = "periodic sides"


def mesh_of(build, size, periodic, folder):
    subprocess.run([build / "morphology", "-shape", "disc", "-cell", "grid", "-block_width", "5e-3", "-block_height", "5e-3",
                    "-diameter", "0.5e-3", "-fraction", "0.3", "-gap", "1e-4", "-clearance", "1e-4", "-size", str(size),
                    "-periodic", "x" if periodic else "none", "-output_folder", folder],
                   check=True, stdout=subprocess.DEVNULL)  # fmt: skip
    return folder / "mesh.msh"


def write_table(path, side=5e-3, points=100):
    """A block that is pressed a little, evenly."""
    places = [side * k / (points - 1) for k in range(points)]
    path.write_text("x,y,ux,uy\n" + "".join(f"{x!r},{y!r},0,{-1e-5 * y!r}\n" for y in places for x in places))


def run(build, mesh, options, steps, folder):
    """Processor seconds and the most memory, B, of a run; nodes."""
    options = {**BARE, **options, "time_end": steps * BARE["time_step"], "mesh_file": mesh, "output_folder": folder / "out"}
    options = {name: folder / value if value is TABLE else value for name, value in options.items() if value is not None}
    words = [word for name, value in options.items() for word in (f"-{name}", str(value))]
    process = subprocess.Popen([build / "slide", *words], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                               env={**os.environ, "OMP_NUM_THREADS": "1", "OPENBLAS_NUM_THREADS": "1"})
    said = process.stderr.read().decode()
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = status
    if status:
        raise SystemExit(f"{' '.join(words)}: {said}")
    text = (folder / "out" / "run.yaml").read_text()
    nodes = int(next(line.split()[1] for line in text.splitlines() if line.startswith("  nodes:")))
    return usage.ru_utime + usage.ru_stime, 1024 * usage.ru_maxrss, nodes


def measured(build, meshes, names, steps, repeat, folder):
    """By feature: lists of ns per node and step, set-up seconds and bytes."""
    found = {name: ([], [], []) for name in names}
    for _ in range(repeat):
        for name in names:
            mesh = meshes[name == PERIODIC]
            short, _, nodes = run(build, mesh, FEATURES[name], steps // 5, folder)
            long, memory, _ = run(build, mesh, FEATURES[name], steps, folder)
            each = (long - short) / (steps - steps // 5)
            for values, value in zip(found[name], (1e9 * each / nodes, short - each * (steps // 5), memory)):
                values.append(value)
    return found, nodes


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("build", type=Path)
    parser.add_argument("-size", type=float, default=62.5e-6, help="of the cells, m")
    parser.add_argument("-steps", type=int, default=6000)
    parser.add_argument("-repeat", type=int, default=5)
    parser.add_argument("-only", help="features whose name holds this")
    asked = parser.parse_args()
    names = [name for name in FEATURES if name == "bare" or not asked.only or asked.only in name]
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        meshes = [mesh_of(asked.build, asked.size, periodic, folder / f"mesh{periodic}") for periodic in (False, True)]
        write_table(folder / TABLE)
        found, nodes = measured(asked.build, meshes, names, asked.steps, asked.repeat, folder)
    bare = [statistics.median(values) for values in found["bare"]]
    print(f"{nodes} nodes, {asked.steps} steps, medians of {asked.repeat}\n")
    print("| feature | ns per node and step | over bare | bytes per node over bare | set-up [s] |\n|---|---|---|---|---|")
    for name, values in found.items():
        each, start, memory = (statistics.median(part) for part in values)
        print(f"| {name} | {each:.2f} | {each / bare[0]:.2f} | {(memory - bare[2]) / nodes:.0f} | {start:.2f} |")


if __name__ == "__main__":
    main()
