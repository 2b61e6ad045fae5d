"""Random valid scenes of `slide`: the same bits on one and two ranks, closed energy, the same bits after stops.

    python3 tests/soak/soak.py --minutes 120 --seed 2
    python3 tests/soak/soak.py --scene soak_failures/2-17.yaml       # one that failed, again

A scene is run on one rank, on two, and once more, stopped in the middle by a signal, kill -9 of one rank or of all, or an
earlier end, and gone on with on another number of ranks. Every dataset of every file must have equal bytes, and
summary.yaml equal numbers. What fails is kept, with all that the soak needs to run it again, in files of some lines.
SLIPSCALE_SLIDE, SLIPSCALE_MORPHOLOGY and SLIPSCALE_MPIEXEC say where the programs are.
"""

import argparse
import collections
import os
import random
import re
import shutil
import subprocess
import sys
import tempfile
import time
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[1] / "programs"))

import numpy as np
import meshes
import random_scenes
import schema
import yaml
from jobs import Job, launch
from running import datasets

RESIDUAL = 1e-9  # of what flowed
STOPS = ("signal", "kill of all", "kill of one", "earlier end")
ONE_STEP = 1e-9  # s
TOO_EARLY = (-10, 138)  # SIGUSR1 before a rank asks for it: the end, and nothing to lose
EFFECTIVE = "stiffness: [6.1e10, 5.2e10, 1.7e10, 1.9e10, 2.0e9, -1.0e9]\ndensity: 2100\n"


class Failure(Exception):
    """What is wrong, in a sentence."""


class Refused(Exception):
    """slide does not take the scene, for the reason that it gives."""


def contents(folder):
    """{file, dataset: its values} of all that a run leaves, and its summary without what it cost."""
    found = {}
    for path in sorted(folder.glob("*.h5")):
        if not path.name.startswith("checkpoint"):
            found.update({(path.name, name): values for name, values in datasets(path).items()})
    for path in folder.glob("*.xdmf"):
        found[path.name, ""] = np.frombuffer(path.read_bytes(), np.uint8)
    summary = yaml.safe_load((folder / "summary.yaml").read_text())
    del summary["cost"]
    return found, summary


def compare(one, other, what):
    """Of two runs' contents; Failure names the first difference."""
    if one[0].keys() != other[0].keys():
        raise Failure(f"{what}: {sorted(one[0].keys() ^ other[0].keys())} are in one only")
    for name, values in one[0].items():
        if values.shape != other[0][name].shape or values.tobytes() != other[0][name].tobytes():
            raise Failure(f"{what}: {name[0]} {name[1]} differs")
    for name, value in one[1].items():
        if repr(value) != repr(other[1][name]):
            raise Failure(f"{what}: summary.yaml: {name} is {value} and {other[1][name]}")


def said(err):
    """What slide itself said, without its launcher; all where it said nothing."""
    return " ".join(dict.fromkeys(line for line in err.splitlines() if line.startswith("slide: "))) or err[-400:]


def own(err):
    """What slide said, if its launcher said no more than that it passes a signal on."""
    return "" if re.match(r"mpi(run|exec): Forwarding signal", err) else err


class Soak:
    def __init__(self, folder, keep, seed):
        self.folder, self.keep, self.seed = folder, keep, seed
        self.schema = schema.read(launch(["-help"], folder).out)
        random_scenes.check_coverage(self.schema, random.Random(seed))
        self.counts = collections.Counter()
        self.used = set()
        self.refusals = collections.Counter()
        self.worst = {"double": 0, "single": 0}  # by the precision in which the stiffness is stored
        (folder / "effective.yaml").write_text(EFFECTIVE)

    def slide(self, options, ranks=1, stop=None):
        """Runs to its end, or until `stop` (a function of the Job) has acted; returns the Job."""
        job = Job(options, self.folder, ranks)
        if stop:
            stop(job)
        job.finish()
        return job

    def whole(self, options, folder, ranks=1):
        """A run that must come to its end: its contents."""
        job = self.slide({**options, "output_folder": folder}, ranks)
        if job.code == 2:
            raise Refused(said(job.err))
        if job.code or job.err:
            raise Failure(f"{ranks} ranks: exit code {job.code}: {said(job.err)}")
        return contents(self.folder / folder)

    def draw(self, number):
        """A scene and how it is run, a dict; Refused."""
        chance = random.Random(f"{self.seed}/{number}")
        scene = random_scenes.Scene(self.schema, chance)
        scene.physics()
        meshes.make_mesh(scene.mesh, self.folder, os.environ["SLIPSCALE_MORPHOLOGY"])
        self.drawn = {**scene.options, "time_end": ONE_STEP, "run_soak_stop": "kill of all", "run_soak_ranks": "1,2",
                      "run_soak_seed": f"{self.seed}/{number}"}
        self.whole({**scene.options, "time_end": ONE_STEP}, "probe")
        run = yaml.safe_load((self.folder / "probe" / "run.yaml").read_text())["run"]
        work = 10 ** chance.uniform(3.5, 6.7)  # nodes times steps: up to half a second
        scene.writing(run["stable_step"], max(40, int(work / run["nodes"])))
        self.used |= scene.used
        stop = chance.choice(STOPS)
        least = 0.2
        if stop == "earlier end":  # takes cadences and windows that the end does not change
            for name in ("fields_times", "fields_quantities", "fields_box") if "fields_times" in scene.options else ():
                scene.options.pop(name, None)
            if scene.rubs and "contact_interval" not in scene.options:
                scene.options.setdefault("contact_every", 20)
            if "statistics_from" in scene.options:
                scene.options.setdefault("statistics_every", 10)
                least = max(least, scene.options["statistics_to"] / scene.options["time_end"] + 0.01)
        ranks = [chance.choice((1, 2))]
        for _ in range(chance.choice((1, 1, 2))):
            ranks.append(chance.choice([n for n in (1, 2, 3) if n != ranks[-1]]))
        early = {}
        if stop == "earlier end":
            early["run_soak_earlier_end"] = schema.rounded(chance.uniform(least, 0.95) * scene.options["time_end"])
        return {**scene.options, **early, "run_soak_stop": stop, "run_soak_ranks": ",".join(map(str, ranks)),
                "run_soak_seed": f"{self.seed}/{number}"}

    def check(self, scene):
        """Failure, Refused, or nothing."""
        chance = random.Random(f"{scene['run_soak_seed']} how")
        for folder in ("one", "two", "out", "probe"):
            shutil.rmtree(self.folder / folder, ignore_errors=True)
        one = self.whole(scene, "one")
        lasts = yaml.safe_load((self.folder / "one" / "summary.yaml").read_text())["cost"]["wall_time"]
        self.check_numbers(one, scene.get("stiffness_storage", "double"))
        two = self.whole({**scene, **random_scenes.same_bits(self.schema, chance)}, "two", ranks=2)
        compare(one, two, "1 and 2 ranks")
        self.check_stops(scene, one, lasts, chance)
        for name in ("friction_law", "friction_rate", "friction_threshold", "boundary_top_y", "stiffness_storage"):
            value = scene.get(name, "none" if name == "friction_law" else "default")
            self.counts[f"{name}: {'a number' if isinstance(value, float) else value}"] += 1
        self.counts[f"mesh: {Path(scene['mesh_file']).stem}"] += 1
        self.counts[f"regime: {(one[1].get('contact') or {}).get('regime', 'no surface')}"] += 1

    def check_numbers(self, run, storage):
        residual = run[1]["energy"]["largest_relative_residual"]
        if residual is not None:
            self.worst[storage] = max(self.worst[storage], residual)
            if not residual < RESIDUAL:
                raise Failure(f"the energy does not close: {residual:g} of what flowed")
        for name, values in run[0].items():
            if values.dtype.kind == "f" and np.isinf(values).any():
                raise Failure(f"{name[0]} {name[1]} is infinite somewhere")

    def check_stops(self, scene, one, lasts, chance):
        ranks = [int(word) for word in str(scene["run_soak_ranks"]).split(",")]
        stop = scene["run_soak_stop"]
        what = f"{stop}, ranks {ranks}"
        self.counts[f"stop: {stop}"] += 1
        options = {**scene, **random_scenes.same_bits(self.schema, chance), "output_folder": "out"}
        if stop == "earlier end":
            options["time_end"] = scene["run_soak_earlier_end"]
        for turn, count in enumerate(ranks):
            last = turn == len(ranks) - 1
            waits = chance.uniform(0, 0.8 * lasts)
            act = None if last or stop == "earlier end" else lambda job: job.stop(stop, waits, chance)
            job = self.slide(options, count, act)
            allowed = (0,) if act is None else (0, 3, *TOO_EARLY) if stop == "signal" else (0, -9, 137, 1)
            if job.code not in allowed or (job.code == 0 and own(job.err)):
                raise Failure(f"{what}, turn {turn + 1}: exit code {job.code}: {said(job.err)}")
            self.counts["signals before the first step"] += job.code in TOO_EARLY
            there = any((self.folder / "out" / name).exists() for name in ("checkpoint.h5", "checkpoint_older.h5"))
            self.counts["runs stopped in the middle" if job.code else "runs that ended before the stop"] += not last
            if there:
                options = {"restart": "out", **random_scenes.same_bits(self.schema, chance)}
                if stop == "earlier end":
                    options["time_end"] = scene["time_end"]
                self.counts["restarts"] += not last
            else:
                self.counts["killed before the first checkpoint"] += not last
        compare(one, contents(self.folder / "out"), what)

    def one(self, scene, name):
        """Whether it is sound; says and keeps what is not."""
        try:
            self.check(scene)
        except Refused as refused:
            self.note_refusal(refused)
        except (Failure, OSError, subprocess.TimeoutExpired, KeyError) as failure:
            self.keep_scene(scene, name, failure)
            return False
        return True

    def keep_scene(self, scene, name, failure):
        self.keep.mkdir(parents=True, exist_ok=True)
        kept = self.keep / f"{name}.yaml"
        sentence = " ".join(f"{type(failure).__name__}: {failure}".split())
        kept.write_text(f"# {sentence}\n" + yaml.safe_dump(scene, sort_keys=True))
        print(f"{kept}: {sentence}", flush=True)

    def note_refusal(self, refused):
        self.refusals[re.sub(r"[-+]?\d[\d.e+-]*", "#", str(refused))[:110]] += 1


def report(soak, tried, failed, minutes):
    print(f"seed {soak.seed}: {tried} scenes in {minutes:.0f} min, {failed} failures, {sum(soak.refusals.values())} refused; "
          f"{soak.counts['restarts']} restarts, of {soak.counts['runs stopped in the middle']} runs stopped in the middle and "
          f"{soak.counts['runs that ended before the stop']} that had ended; largest energy residual "
          f"{soak.worst['double']:.1e}, with single storage {soak.worst['single']:.1e}")
    print(f"options of the schema drawn: {len(soak.used | set(random_scenes.SAME_BITS))} of {len(soak.schema)}, of which "
          f"{len(random_scenes.NOT_DRAWN)} never are")
    for name, count in sorted(soak.counts.items()):
        print(f"  {count:5d}  {name}")
    for said, count in soak.refusals.most_common(12):
        print(f"  {count:5d}  refused: {said}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--minutes", type=float, default=1)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--scene", type=Path, help="a kept scene, instead of random ones")
    parser.add_argument("--number", type=int, default=0, help="of the first scene of the seed")
    parser.add_argument("--keep", type=Path, default=Path("soak_failures"), help="folder of scenes that failed")
    asked = parser.parse_args()
    begin = time.monotonic()
    with tempfile.TemporaryDirectory() as scratch:
        soak = Soak(Path(scratch), asked.keep.resolve(), asked.seed)
        if asked.scene:
            scene = yaml.safe_load(asked.scene.read_text())
            meshes.make_mesh(Path(scene["mesh_file"]).stem, soak.folder, os.environ["SLIPSCALE_MORPHOLOGY"])
            good = soak.one(scene, asked.scene.stem)
            report(soak, 1, not good, (time.monotonic() - begin) / 60)
            return 0 if good and not soak.refusals else 1
        number, tried, failed = asked.number, 0, 0
        while time.monotonic() - begin < 60 * asked.minutes:
            try:
                scene = soak.draw(number)
            except Refused as refused:
                soak.note_refusal(refused)
            except Failure as failure:
                failed += 1
                soak.keep_scene(soak.drawn, f"{asked.seed}-{number}", failure)
            else:
                refused = sum(soak.refusals.values())
                failed += not soak.one(scene, f"{asked.seed}-{number}")
                tried += sum(soak.refusals.values()) == refused
            number += 1
        report(soak, tried, failed, (time.monotonic() - begin) / 60)
    return 1 if failed or tried == 0 or sum(soak.refusals.values()) > tried else 0


if __name__ == "__main__":
    sys.exit(main())
