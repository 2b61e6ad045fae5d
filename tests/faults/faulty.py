"""Runs programs on disks and systems that fail them, and looks at what they leave.

SLIPSCALE_FAULT_LIBRARY is disk_fault.cpp, compiled.
"""

import os
import signal
import subprocess
import sys
import time
import xml.etree.ElementTree as ElementTree
from pathlib import Path

ROOT = Path(__file__).parents[2]
sys.path[:0] = [str(ROOT / "tests" / "programs"), str(ROOT / "runs")]

import h5py
import yaml
from running import MPIEXEC, SLIDE, InScratch, arguments_of
from scenes import SQUEAL, block
from slipscale.reading.recovery import make_good

LIBRARY = os.environ["SLIPSCALE_FAULT_LIBRARY"]
# 1500 steps with every kind of output.
SCENE = {**SQUEAL, "time_end": 30e-6, "time_step": 2e-8, "history_every": 7, "contact_every": 30, "fields_every": 25,
         "statistics_from": 1e-6, "statistics_every": 50}
GROWING = ("history.h5", "contact.h5", "fields.h5")
SECONDS = float(os.environ.get("SLIPSCALE_SECONDS", "120"))  # within which all ranks must have ended; more under load


def contents(path):
    """All datasets of an HDF5 file by path, read fully."""
    found = {}
    with h5py.File(path, "r") as file:
        file.visititems(lambda name, item: found.update({name: item[()]}) if isinstance(item, h5py.Dataset) else None)
    return found


def alive(process):
    try:
        return Path(f"/proc/{process}/stat").read_text().rsplit(")", 1)[1].split()[0] != "Z"
    except OSError:
        return False


class Faults(InScratch):
    """A test with a block, in a folder of its own."""

    def setUp(self):
        super().setUp()
        block(self.folder / "block.msh")

    # Running

    def command(self, program, scene, ranks, before):
        launcher = [] if ranks == 1 else [MPIEXEC, "-n", str(ranks)]
        # exec: the process number is the program's own; the library stays out of bash.
        script = ('echo $$ > pid.${OMPI_COMM_WORLD_RANK:-0}; '
                  '[ -z "$FAULT_PROGRAM" ] || export LD_PRELOAD="$FAULT_SO"; exec "$0" "$@"')
        return [*launcher, *before, "bash", "-c", script, program, *arguments_of(scene)]

    def start(self, scene, ranks=1, program=SLIDE, before=(), **fault):
        """A running job; `before`: words before its command; `fault`: for disk_fault.cpp, without FAULT_, small."""
        for old in self.folder.glob("pid.*"):
            old.unlink()
        more = {"FAULT_" + name.upper(): str(value) for name, value in fault.items()}
        if fault:
            more |= {"FAULT_PROGRAM": Path(program).name, "FAULT_SO": LIBRARY}
        job = subprocess.Popen(self.command(program, scene, ranks, before), cwd=self.folder,
                               env=self.environment(**more), text=True, stdin=subprocess.DEVNULL,
                               stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.addCleanup(self.end, job)
        return job

    def end(self, job):
        if job.poll() is None:
            job.send_signal(signal.SIGTERM)  # mpiexec then ends the ranks
        try:
            job.communicate(timeout=30)
        except subprocess.TimeoutExpired:
            job.kill()

    def finish(self, job):
        """Its exit code and what it said on stderr; that all ranks end in time.

        mpiexec itself may hang after a rank was killed early (Open MPI 4.1 waits for a lock of its own, with all ranks
        gone): it is ended then, and its exit code is -9.
        """
        try:
            _, err = job.communicate(timeout=SECONDS)
        except subprocess.TimeoutExpired:
            self.assertFalse([process for process in self.processes() if alive(process)], "ranks go on for ever")
            job.kill()
            _, err = job.communicate()
        deadline = time.monotonic() + 10
        while any(alive(process) for process in self.processes()):
            self.assertLess(time.monotonic(), deadline, "a rank stays behind")
            time.sleep(0.02)
        return job.returncode, err

    def processes(self):
        texts = [file.read_text() for file in sorted(self.folder.glob("pid.*"))]
        return [int(text) for text in texts if text.strip()]

    def run_job(self, scene, ranks=1, **fault):
        return self.finish(self.start(scene, ranks, **fault))

    def reference(self, scene, ranks=1):
        """What the uninterrupted run leaves: {file: {dataset: values}}."""
        code, err = self.run_job({**self.checkpointed(scene), "output_folder": "whole"}, ranks)
        self.assertEqual((code, err), (0, ""))
        return {name: contents(self.folder / "whole" / name) for name in GROWING}

    def calls(self, scene, part, ranks=1, program=SLIDE):
        """What a run does to the files of whose path this is a part: [(call, bytes, path)]."""
        log = self.folder / "calls"
        log.unlink(missing_ok=True)
        code, err = self.finish(self.start(scene, ranks, program, path=part, log=log))
        self.assertEqual(code, 0, err)
        found = []
        for line in log.read_text().splitlines():
            _, call, count, path = line.split(" ", 3)
            found.append((call, int(count), path))
        return found

    def checkpointed(self, scene):
        return {**scene, "checkpoint_every": 100} if self.knows_restart() else scene

    def knows_restart(self):
        if not hasattr(Faults, "restart_known"):
            Faults.restart_known = "-restart" in self.slide("-help").out
        return Faults.restart_known

    # What is left

    def check_left(self, folder, reference):
        """Every file is readable, and holds the first rows and frames of the uninterrupted run, bit by bit. How
        many of them a kill had left in the middle of a change."""
        torn = 0
        for name in GROWING:
            path = folder / name
            if path.exists():
                torn += make_good(path)
                self.check_file(contents(path), reference[name], name)
        if (folder / "fields.xdmf").exists():
            self.check_shown(folder)
        if (folder / "run.yaml").exists():
            self.assertIn("run", yaml.safe_load((folder / "run.yaml").read_text()))
        return torn

    def check_file(self, found, whole, name):
        grow = [key for key in found if not key.startswith(("mesh/", "frames/")) and
                not key.endswith(("/x", "/y")) and key not in ("x", "y", "tributary_length", "region_share")]
        rows = {len(found[key]) for key in grow}
        self.assertEqual(len(rows), 1, f"{name}: {rows}")
        rows = rows.pop()
        if name == "fields.h5":
            frames = {key.split("/")[1] for key in found if key.startswith("frames/")}
            self.assertEqual(frames, {f"{k:05}" for k in range(rows)})
            expected = {key for key in whole if not key.startswith("frames/") or int(key.split("/")[1]) < rows}
        else:
            expected = set(whole)
        self.assertEqual(set(found), expected, name)
        for key, values in found.items():
            part = whole[key][:rows] if key in grow else whole[key]
            self.assertEqual(values.tobytes(), part.tobytes(), f"{name}: {key}")

    def check_shown(self, folder):
        """The XDMF file is whole and names nothing that is not there."""
        tree = ElementTree.parse(folder / "fields.xdmf")
        there = contents(folder / "fields.h5")
        for item in tree.iter("DataItem"):
            file, _, path = item.text.partition(":")
            self.assertEqual(file, "fields.h5")
            self.assertIn(path.strip("/"), there)

    def check_restart(self, reference, ranks=1, folder="out"):
        """A folder with a checkpoint goes on to the same bits, as often as one asks. Whether there was one."""
        if not self.knows_restart() or not list((self.folder / folder).glob("checkpoint*.h5")):
            return False
        code, err = self.run_job({"restart": folder}, ranks)
        self.assertEqual((code, err), (0, ""))
        for name in GROWING:
            found = contents(self.folder / folder / name)
            self.assertEqual(set(found), set(reference[name]), name)
            for key, values in found.items():
                self.assertEqual(values.tobytes(), reference[name][key].tobytes(), f"{name}: {key}")
        return True
