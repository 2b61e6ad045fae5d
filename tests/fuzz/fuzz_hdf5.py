"""Damages the files that programs read of each other, and looks at what the readers make of them.

    fuzz_hdf5.py [--seconds 60] [--seed 1] [--keep FOLDER] [--only NAME]

localization.h5, fields.h5 and statistics.h5 go to `relocalize`, effective.yaml goes to `slide`; so do history.h5, contact.h5,
fields.h5 and the checkpoint of a run that goes on, which must end with the same bits or be refused. Damage is done where
the format has a place for it (a dataset of another size or kind, numbers that are none, an attribute that is a list)
and anywhere else (bytes turned over, files cut): damage_hdf5.py. A reader may take it or refuse it with one sentence and
exit code 2. It fails when it crashes, takes longer than `--hang` seconds or more memory than `--memory` MB, says
something else, takes what cannot be true, or writes what is not finite. Failing files are kept. The same seed makes the same
damage.

`--seed 22 --seconds 2400`, on two cores with ten other processes: 693 files, 485 refused, 2 failed and since mended (a
free list in a heap of names that HDF5 overlooks in a file which it may write in; an overflow that was no refusal).

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
from damage_hdf5 import damaged_checkpoint, damaged_hdf5, damaged_record, damaged_yaml  # noqa: E402
from relocalizing import HOMOGENEOUS, RELOCALIZE, Relocalising  # noqa: E402
from running import SLIDE, arguments_of, datasets, h5py  # noqa: E402
from scenes import block  # noqa: E402


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
        self.run_scene(STOPPED)
        return self.folder

    def gone_on(self):
        """What the stopped run leaves in the end when nothing is damaged: {file: {dataset: bytes}}."""
        shutil.copytree(self.folder / "stopped", self.folder / "whole")
        self.run_scene({**GO_ON, "restart": "whole"})
        return records(self.folder / "whole")


@dataclass
class Reader:
    """A program that reads a damaged copy of `source`."""

    source: str
    program: str
    options: dict
    damage: callable
    outputs: tuple = ()
    goes_on: bool = False  # of `stopped`, to what `whole` is
    faults: list = field(default_factory=list)


RUN = {"relocalize_run": "homogeneous", "relocalize_tensors": "cell", "output_folder": "out"}
COMPARED = {**RUN, "relocalize_reference": "heterogeneous", "relocalize_layer": 0.9e-3, "relocalize_bulk": 0.9e-3}
STRIP = {**RUN, "relocalize_correction": "strip", "relocalize_strip": 2.6e-3}
OUT = ("relocalized.h5", "relocalized_statistics.h5")
SLID = {**HOMOGENEOUS, "time_end": 1e-7, "fields_every": None, "fields_quantities": None, "statistics_from": None,
        "statistics_every": None, "output_folder": "out"}
RECORDS = ("history", "contact", "fields")
STOPPED = {**HOMOGENEOUS, "time_end": 4e-6, "history_every": 10, "contact_every": 20, "fields_interval": 5e-7,
           "fields_every": None, "statistics_from": None, "statistics_every": None, "checkpoint_every": 40,
           "output_folder": "stopped"}
GO_ON = {"time_end": 6e-6}
READERS = {
    "tensors": Reader("cell/localization.h5", RELOCALIZE, RUN, damaged_hdf5, OUT),
    "tensors-strip": Reader("cell/localization.h5", RELOCALIZE, STRIP, damaged_hdf5, OUT),
    "tensors-tiled": Reader("torus/localization.h5", RELOCALIZE, {**RUN, "relocalize_tensors": "torus"}, damaged_hdf5,
                            OUT),
    "run": Reader("homogeneous/fields.h5", RELOCALIZE, RUN, damaged_hdf5, OUT),
    "reference": Reader("heterogeneous/fields.h5", RELOCALIZE, COMPARED, damaged_hdf5, OUT),
    "statistics": Reader("homogeneous/statistics.h5", RELOCALIZE, RUN, damaged_hdf5, OUT),
    "material": Reader("cell/effective.yaml", SLIDE, SLID, damaged_yaml),
    **{f"restart-{file}": Reader(f"stopped/{file}.h5", SLIDE, {**GO_ON, "restart": "stopped"}, damaged_record, goes_on=True)
       for file in RECORDS},
    "restart-checkpoint": Reader("stopped/checkpoint.h5", SLIDE, {**GO_ON, "restart": "stopped"}, damaged_checkpoint,
                                 goes_on=True),
}


def records(folder):
    return {file: {name: values.tobytes() for name, values in datasets(folder / f"{file}.h5").items()}
            for file in RECORDS}


def fault(reader, damage, outcome, folder, limits, whole):
    """What is wrong with the answer; None where nothing is."""
    code, err, seconds, memory = outcome
    if seconds > limits.hang:
        return f"{seconds:.1f} s"
    if code not in (0, 2):
        return f"exit code {code}: {err[:150]} ... {err[-300:]}"
    if memory > limits.memory:
        return f"{memory:.0f} MB"
    if code == 2:
        fine = re.fullmatch(r"\w+: [^\n]+\n", err)
        return None if fine else f"no sentence: {err[-300:]}"
    # What a reference must have is its stress; its strain may be anything.
    if damage.fatal and not (reader.source.startswith("heterogeneous") and "strain" in damage.text):
        return "taken without a word"
    if reader.goes_on:
        try:
            if records(folder / "stopped") != whole:
                return "goes on with damaged data"
        except (OSError, RuntimeError, KeyError, ValueError) as error:
            return f"goes on with what cannot be read: {error}"
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
    whole = sound.gone_on()
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
        if wrong := fault(reader, damage, outcome, folder, limits, whole):
            failed.append((name, damage.text, wrong))
            print(f"{name}: {damage.text}: {wrong}", flush=True)
            limits.keep.mkdir(parents=True, exist_ok=True)
            kept = limits.keep / f"{name}-{limits.seed}-{tried - 1}-{Path(reader.source).name}"
            shutil.copy(folder / reader.source, kept)
        shutil.rmtree(folder, ignore_errors=True)
    sound.doCleanups()
    print(f"seed {limits.seed}: {tried} damaged files, {refused} refused, {len(failed)} failures")
    return 1 if failed or tried == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
