"""Damages gmsh files of MSH 4.1, text and binary, and looks at what the reader makes of them.

    fuzz_msh.py READER [--seed 1] [--seconds 60 | --count 4000] [--keep FOLDER]

READER is the executable `fuzz_read_meshes` of the build folder. The same seed and count give the same files. A mutant
fails when the reader crashes, takes more than 10 s or more than ten times the file (and 20 MB) of memory, or says
anything but that the mesh is read or refused in one sentence; failed ones are kept. Exit code 1 when there are any.

`--seed 12 --seconds 900`, on two cores with thirty other processes: 8650 files, 528 read, 8122 refused, 0 failed.
"""

import argparse
import random
import re
import shutil
import subprocess
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path

from damage import damage_bytes, damage_lines

SECONDS, MEMORY = 10, 20_000  # s, kB
BATCH = 50

LAYERS = """
h = 3e-4; L = 1e-3;
Point(1) = {0, 0, 0, h}; Point(2) = {L, 0, 0, h}; Point(3) = {L, L, 0, h}; Point(4) = {0, L, 0, h};
Point(5) = {0, L/2, 0, h}; Point(6) = {L, L/2, 0, h};
Line(1) = {1, 2}; Line(2) = {2, 6}; Line(3) = {6, 3}; Line(4) = {3, 4}; Line(5) = {4, 5}; Line(6) = {5, 1};
Line(7) = {5, 6};
Curve Loop(1) = {1, 2, -7, 6}; Curve Loop(2) = {7, 3, 4, 5}; Plane Surface(1) = {1}; Plane Surface(2) = {2};
Physical Curve("bottom") = {1}; Physical Curve("top") = {-4}; Physical Curve("around") = {1, -2, 3, 4};
Physical Surface("matrix") = {1}; Physical Surface("inclusion") = {-2};
"""
PERIODIC = """
Periodic Curve{2} = {-6} Translate{L, 0, 0}; Periodic Curve{3} = {-5} Translate{L, 0, 0};
Periodic Curve{4} = {-1} Translate{0, L, 0};
"""
GEOMETRIES = {
    "plain": LAYERS,
    "mixed": LAYERS + "Recombine Surface{1};",
    "torus": LAYERS + PERIODIC,
    "second": LAYERS + "Mesh.ElementOrder = 2;",
}


def originals(folder):
    """The sound files: text and binary of each geometry."""
    found = {}
    for name, text in GEOMETRIES.items():
        for form in ("text", "binary"):
            geometry, mesh = folder / f"{name}.geo", folder / f"{name}-{form}.msh"
            geometry.write_text(text + "\n")  # gmsh passes over a last line without end
            subprocess.run(["gmsh", "-v", "1", "-2", "-format", "msh41", *(["-bin"] if form == "binary" else []),
                            geometry, "-o", mesh], check=True, stdin=subprocess.DEVNULL)
            found[mesh.stem] = mesh.read_bytes()
    return found


def mutant(data, rng):
    for _ in range(rng.choice((1, 1, 1, 2, 4))):
        is_binary = b"4.1 1 8" in data[:40]
        data = (damage_bytes if is_binary or rng.random() < 0.2 else damage_lines)(data, rng) or b"\n"
    return data


def faults_of(reader, paths):
    """What is wrong with each file that the reader does not take or refuse as it should; counts of what it did."""
    faults, counts, reasons = {}, Counter(), Counter()
    paths = list(paths)
    while paths:
        try:
            run = subprocess.run([reader, *paths], capture_output=True, timeout=SECONDS * 3 + len(paths))
            out, code = run.stdout, run.returncode
        except subprocess.TimeoutExpired as expired:
            out, code = expired.stdout or b"", "hangs"
        lines = out.decode(errors="replace").split("\n")
        done = [line.split("\t") for line in lines if line.count("\t") >= 3]
        for path, seconds, kilobytes, outcome, *_ in done:
            kind = outcome.split(":")[0]
            counts[kind] += 1
            reasons[re.sub(r"'[^']*'|[-+.\d]+(e[-+]?\d+)?", "#", outcome)[:70]] += 1
            if kind not in ("read", "refused"):
                faults[path] = outcome
            if float(seconds) > SECONDS:
                faults[path] = f"takes {seconds} s"
            if int(kilobytes) > MEMORY + 10 * Path(path).stat().st_size / 1000:
                faults[path] = f"takes {kilobytes} kB for a file of {Path(path).stat().st_size} bytes"
        if len(done) == len(paths):
            break
        faults[str(paths[len(done)])] = f"ends the reader ({code})"
        counts["ended"] += 1
        paths = paths[len(done) + 1:]
    return faults, counts, reasons


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("reader")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--seconds", type=float, default=float("inf"))
    parser.add_argument("--count", type=int, default=None)
    parser.add_argument("--keep", type=Path, default=Path("fuzz-failures"))
    parser.add_argument("--reasons", action="store_true", help="list how often each sentence was said")
    choice = parser.parse_args()
    if choice.count is None and choice.seconds == float("inf"):
        choice.seconds = 60
    rng, start, made = random.Random(choice.seed), time.monotonic(), 0
    counts, reasons, failed = Counter(), Counter(), {}
    with tempfile.TemporaryDirectory() as scratch:
        scratch = Path(scratch)
        sound = originals(scratch)
        faults, ok, _ = faults_of(choice.reader, [scratch / f"{name}.msh" for name in sound])
        if faults or ok["read"] != len(sound):
            sys.exit(f"the sound files are not read: {faults or ok}")
        while made < (choice.count or float("inf")) and time.monotonic() - start < choice.seconds:
            paths = []
            for _ in range(min(BATCH, (choice.count or made + BATCH) - made)):
                name = rng.choice(sorted(sound))
                path = scratch / f"{made}-{name}.msh"
                path.write_bytes(mutant(sound[name], rng))
                paths.append(path)
                made += 1
            faults, more, said = faults_of(choice.reader, paths)
            counts += more
            reasons += said
            for path, fault in faults.items():
                choice.keep.mkdir(exist_ok=True)
                shutil.copy(path, choice.keep)
                failed[Path(path).name] = fault
                print(f"{choice.keep / Path(path).name}: {fault}", flush=True)
            for path in paths:
                path.unlink()
    if choice.reasons:
        for reason, count in reasons.most_common():
            print(f"{count:6} {reason}")
    print(f"seed {choice.seed}: {made} files in {time.monotonic() - start:.0f} s: " +
          ", ".join(f"{count} {kind}" for kind, count in sorted(counts.items())) + f"; {len(failed)} failed")
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
