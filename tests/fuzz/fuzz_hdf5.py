"""Damages the files that programs read of each other, and looks at what the readers make of them.

    fuzz_hdf5.py [--seconds 60] [--seed 1] [--keep FOLDER] [--only NAME]

localization.h5, fields.h5 and statistics.h5 go to `relocalize`, effective.yaml goes to `slide`. Damage is done where the
format has a place for it (a dataset of another size or kind, numbers that are none, an attribute that is a list) and
anywhere else (bytes turned over, files cut). A reader may take it or refuse it with one sentence and exit code 2. It
fails when it crashes, takes longer than `--hang` seconds or more memory than `--memory` MB, says something else, takes
what cannot be true, or writes what is not finite. Failing files are kept. The same seed makes the same damage.

The environment says where the programs are, as for tests/programs: SLIPSCALE_SLIDE and so on.
"""

import argparse
import random
import re
import shutil
import sys
import time
from dataclasses import dataclass, field
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "programs"))

import numpy as np  # noqa: E402
from damage import watched  # noqa: E402
from relocalizing import HETEROGENEOUS, HOMOGENEOUS, RELOCALIZE, Relocalising  # noqa: E402
from running import SLIDE, arguments_of, h5py  # noqa: E402
from scenes import block  # noqa: E402

# What `relocalize` reads; damage elsewhere may pass.
READ = {
    "localization.h5": ("mesh/coordinates", "mesh/cells", "mesh/region", "cell/localisation", "region/stiffness",
                        "effective/stiffness"),
    "fields.h5": ("mesh/coordinates", "mesh/cells", "mesh/region", "time", "frames/00000/strain", "frames/00001/strain"),
    "statistics.h5": ("mesh/coordinates", "mesh/cells", "mesh/region", "statistics/strain/mean",
                      "statistics/strain/covariance"),
}
ATTRIBUTES = {
    "localization.h5": (("mesh/region", "names"), ("region/stiffness", "names"), ("effective/stiffness", "boundary"),
                        ("effective/stiffness", "cell_area")),
    "fields.h5": (("mesh/region", "names"),),
    "statistics.h5": (("mesh/region", "names"), *(("statistics", name) for name in ("from", "to", "samples", "quantile"))),
}


@dataclass
class Damage:
    """What was done to a file, and whether a reader must refuse it."""

    text: str
    fatal: bool = False


def replaced(file, name, values, **how):
    """Another content of a dataset, with the attributes it had."""
    attributes = dict(file[name].attrs)
    del file[name]
    made = file.create_dataset(name, data=values, **how)
    made.attrs.update(attributes)


# Each takes (chance, file, dataset name) and returns the damage, or None where it does not apply.

def entry(chance, file, name):
    values = file[name][()]
    if values.dtype.kind != "f":
        return None
    wrong = chance.choice([np.nan, np.inf, -np.inf, 1e308])
    values.flat[chance.randrange(values.size)] = wrong
    file[name][...] = values
    return Damage(f"{wrong} in {name}", fatal=not np.isfinite(wrong))


def all_equal(chance, file, name):
    value = chance.choice([0, 1, -1])
    file[name][...] = np.full_like(file[name][()], value)
    harmless = name == "time" or name.startswith("frames") or name.startswith("statistics") or name == "mesh/region"
    return Damage(f"{name} is {value} everywhere", fatal=not harmless)


def negated(chance, file, name):
    values = file[name][()]
    file[name][...] = -values
    wrong = name in ("cell/localisation", "region/stiffness", "effective/stiffness", "statistics/strain/covariance")
    return Damage(f"{name} negated", fatal=wrong and bool(np.any(values)))


def scaled(chance, file, name):
    values = file[name][()]
    if values.dtype.kind != "f":
        return None
    row = chance.randrange(len(values))
    values[row] *= 1 + 10.0 ** chance.uniform(-3, 3)
    file[name][...] = values
    return Damage(f"row {row} of {name} scaled", fatal=name in ("cell/localisation", "region/stiffness"))


def index(chance, file, name):
    values = file[name][()]
    if values.dtype.kind != "i":
        return None
    wrong = chance.choice([-1, 2**31 - 1, -2**31, 10**6])
    values.flat[chance.randrange(values.size)] = wrong
    file[name][...] = values
    return Damage(f"{wrong} in {name}", fatal=True)


def size(chance, file, name):
    values = file[name][()]
    other = chance.choice([values[:-1], values[:0], np.concatenate([values, values[:1]]), values.reshape(-1)[:-1],
                           values.reshape(1, *values.shape)])
    replaced(file, name, other)
    return Damage(f"{name} of shape {other.shape} for {values.shape}")


def declared(chance, file, name):
    values = file[name][()]
    rows = 10 ** chance.randrange(8, 13)
    kept = dict(file[name].attrs)
    del file[name]
    made = file.create_dataset(name, shape=(rows, *values.shape[1:]), maxshape=(None, *values.shape[1:]),
                               chunks=(1024, *values.shape[1:]), dtype=values.dtype)
    if chance.random() < 0.5:
        made[:len(values)] = values
    made.attrs.update(kept)
    return Damage(f"{name} declares {rows} rows", fatal=True)


def kind(chance, file, name):
    values = file[name][()]
    other = chance.choice([np.full(values.shape, b"word"), values.astype("f4"), values.astype("i8"),
                           values.astype("complex128"), np.array(3.0)])
    replaced(file, name, other)
    return Damage(f"{name} as {other.dtype}, shape {other.shape}")


def gone(chance, file, name):
    del file[name]
    return Damage(f"{name} is gone", fatal=True)


def group(chance, file, name):
    del file[name]
    file.create_group(name)
    return Damage(f"{name} is a group", fatal=True)


def attribute(chance, file, owner, name):
    made = chance.choice(["gone", "list", "empty", "number", "nan", "bytes", "group"])
    attributes = file[owner].attrs
    if name not in attributes:
        return None
    if made == "group":
        return None
    del attributes[name]
    if made == "list":
        attributes[name] = np.arange(chance.choice([0, 2, 100000 // 16]), dtype=float)
    elif made == "empty":
        attributes[name] = h5py.Empty("S8")
    elif made == "number":
        attributes[name] = chance.choice([0.0, -1.0, 1e300])
    elif made == "nan":
        attributes[name] = np.nan
    elif made == "bytes":
        attributes[name] = np.array([b"\xff\xfe"] * chance.choice([1, 3]))
    # Of a text that is gone there is no other; numbers may be those of another run.
    texts = name in ("names", "boundary")
    return Damage(f"{owner}'s attribute {name}: {made}", fatal=(texts or made in ("list", "nan")) and made != "gone"
                  or name == "names")


DATASETS = (entry, all_equal, negated, scaled, index, size, declared, kind, gone, group)


def raw(chance, path):
    """Bytes, without a thought of what they mean."""
    data = bytearray(path.read_bytes())
    made = chance.choice(["flip", "flip", "flip", "cut", "zero", "copy"])
    at = chance.randrange(len(data))
    if made == "flip":
        for _ in range(chance.choice([1, 1, 8, 64])):
            at = chance.randrange(len(data)) if chance.random() < 0.5 else chance.randrange(min(4096, len(data)))
            data[at] ^= 1 << chance.randrange(8)
    elif made == "cut":
        del data[at:]
    elif made == "zero":
        data[at:at + 64] = bytes(len(data[at:at + 64]))
    else:
        other = chance.randrange(len(data))
        data[at:at + 64] = data[other:other + len(data[at:at + 64])]
    path.write_bytes(data)
    return Damage(f"bytes: {made} at {at}")


def damaged_hdf5(chance, path):
    if chance.random() < 0.35:
        return raw(chance, path)
    with h5py.File(path, "r+") as file:
        while True:
            if chance.random() < 0.3:
                done = attribute(chance, file, *chance.choice(ATTRIBUTES[path.name]))
            else:
                done = chance.choice(DATASETS)(chance, file, chance.choice(READ[path.name]))
            if done:
                return done


def damaged_yaml(chance, path):
    lines = path.read_text().split("\n")
    at = chance.randrange(len(lines))
    made = chance.choice(["drop", "double", "cut", "bytes", "nan", "nest", "tab"])
    if made == "drop":
        del lines[at]
    elif made == "double":
        lines.insert(at, lines[at])
    elif made == "cut":
        lines = lines[:at] + [lines[at][:chance.randrange(len(lines[at]) + 1)]]
    elif made == "nan":
        lines = [re.sub(r"\d\.\d+e[+-]\d+", chance.choice([".nan", "nan", ".inf", "-1.0e+300", "word", "[1, 2]"]), line,
                        count=1) if line.startswith(("stiffness", "density")) else line for line in lines]
    elif made == "nest":
        lines.insert(at, "a: " + "[" * 1000)
    elif made == "tab":
        lines[at] = "\t" + lines[at]
    text = "\n".join(lines).encode()
    if made == "bytes":
        text = bytes(byte ^ (1 << chance.randrange(8)) if chance.random() < 0.01 else byte for byte in text)
    path.write_bytes(text)
    return Damage(f"effective.yaml: {made} at line {at + 1}", fatal=made == "nan")


class Sound(Relocalising):
    """The files before they are damaged."""

    def runTest(self):
        """Nothing: a test needs one."""

    def make(self):
        block(self.folder / "block.msh", regions=("matrix", "inclusion"), divisions=6)
        short = {"fields_every": 500, "history_every": 500, "boundary_top_ramp": 10e-6}
        self.make_runs(**short)
        self.draw_cell(self.folder / "torus.msh")
        self.run_cell(mesh_file="torus.msh", output_folder="torus", cell_estimate_error="false")
        return self.folder


@dataclass
class Reader:
    """A program that reads a damaged copy of `source`."""

    source: str
    program: str
    options: dict
    damage: callable
    outputs: tuple = ()
    faults: list = field(default_factory=list)


RUN = {"relocalize_run": "homogeneous", "relocalize_tensors": "cell", "output_folder": "out"}
COMPARED = {**RUN, "relocalize_reference": "heterogeneous", "relocalize_layer": 0.9e-3, "relocalize_bulk": 0.9e-3}
STRIP = {**RUN, "relocalize_correction": "strip", "relocalize_strip": 2.6e-3}
OUT = ("relocalized.h5", "relocalized_statistics.h5")
SLID = {**HOMOGENEOUS, "time_end": 1e-7, "fields_every": None, "fields_quantities": None, "statistics_from": None,
        "statistics_every": None, "output_folder": "out"}
READERS = {
    "tensors": Reader("cell/localization.h5", RELOCALIZE, RUN, damaged_hdf5, OUT),
    "tensors-strip": Reader("cell/localization.h5", RELOCALIZE, STRIP, damaged_hdf5, OUT),
    "tensors-tiled": Reader("torus/localization.h5", RELOCALIZE, {**RUN, "relocalize_tensors": "torus"}, damaged_hdf5, OUT),
    "run": Reader("homogeneous/fields.h5", RELOCALIZE, RUN, damaged_hdf5, OUT),
    "reference": Reader("heterogeneous/fields.h5", RELOCALIZE, COMPARED, damaged_hdf5, OUT),
    "statistics": Reader("homogeneous/statistics.h5", RELOCALIZE, RUN, damaged_hdf5, OUT),
    "material": Reader("cell/effective.yaml", SLIDE, SLID, damaged_yaml),
}


def fault(reader, damage, outcome, folder, limits):
    """What is wrong with the answer; None where nothing is."""
    code, err, seconds, memory = outcome
    if seconds > limits.hang:
        return f"{seconds:.1f} s"
    if code not in (0, 2):
        return f"exit code {code}: {err[-300:]}"
    if memory > limits.memory:
        return f"{memory:.0f} MB"
    if code == 2:
        fine = re.fullmatch(r"\w+: [^\n]+\n", err)
        return None if fine else f"no sentence: {err[-300:]}"
    # What a reference must have is its stress; its strain may be anything.
    if damage.fatal and not (reader.source.startswith("heterogeneous") and "strain" in damage.text):
        return "taken without a word"
    for name in reader.outputs:
        path = folder / "out" / name
        if path.exists() and not_finite(path):
            return f"{name} has {not_finite(path)} that is not finite"
    return None


def not_finite(path):
    found = []
    with h5py.File(path) as file:
        file.visititems(lambda name, item: found.append(name) if isinstance(item, h5py.Dataset) and
                        item.dtype.kind == "f" and not np.all(np.isfinite(item[()])) else None)
    return found[0] if found else None


def run(reader, folder, limits):
    """Exit code, stderr, seconds and MB of the largest process."""
    code, _, err, seconds, memory = watched([reader.program, *arguments_of(reader.options)], folder, limits.hang)
    return code, err, seconds, memory


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("--seconds", type=float, default=60)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--keep", type=Path, default=Path("fuzz_hdf5_failures"))
    parser.add_argument("--only", choices=sorted(READERS))
    parser.add_argument("--hang", type=float, default=10, help="s")
    parser.add_argument("--memory", type=float, default=500, help="MB")
    limits = parser.parse_args()
    sound = Sound()
    sound.setUp()
    base = sound.make()
    names = [limits.only] if limits.only else list(READERS)
    end, tried, refused, failed = time.monotonic() + limits.seconds, 0, 0, []
    while time.monotonic() < end:
        name = names[tried % len(names)]
        reader, chance = READERS[name], random.Random(f"{limits.seed}/{name}/{tried}")
        folder = base.parent / f"{base.name}-mutant"
        shutil.rmtree(folder, ignore_errors=True)
        shutil.copytree(base, folder)
        damage = reader.damage(chance, folder / reader.source)
        outcome = run(reader, folder, limits)
        tried += 1
        refused += outcome[0] == 2
        if wrong := fault(reader, damage, outcome, folder, limits):
            failed.append((name, damage.text, wrong))
            print(f"{name}: {damage.text}: {wrong}", flush=True)
            limits.keep.mkdir(parents=True, exist_ok=True)
            shutil.copy(folder / reader.source, limits.keep / f"{name}-{limits.seed}-{tried - 1}-{Path(reader.source).name}")
        shutil.rmtree(folder, ignore_errors=True)
    sound.doCleanups()
    print(f"seed {limits.seed}: {tried} damaged files, {refused} refused, {len(failed)} failures")
    return 1 if failed or tried == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
