"""A run of `slide` that was stopped goes on, if it is still the same run.

begun.yaml lies beside the checkpoints of a run that has not ended: its `command` without launcher, and the `wall_seconds`
and `cpu_seconds` that it has used. A run goes on when the command is the same, and the program older than the checkpoint;
with the command goes `-restart FOLDER`, so that slide compares what the words stand for (a file of options, the mesh) and
refuses what has changed, with exit code 2: then the run starts anew.

In a job of Slurm the program is told when it must have ended, with `-time_wall`, and ends before with a checkpoint.
"""

import os
import shlex
import subprocess
import time
from pathlib import Path

import yaml

STOPPED, REFUSED = 3, 2  # exit codes of slide
BEFORE_END = 60  # s, from the end of the program to that of its job
LEAST = 20  # s, for which no program is started


def job_ends():
    """When this job of Slurm reaches its limit, s since the epoch; None without a job, or if nobody knows."""
    if "SLURM_JOB_ID" not in os.environ:
        return None
    try:
        if "SLURM_JOB_END_TIME" in os.environ:
            return float(os.environ["SLURM_JOB_END_TIME"])
        said = subprocess.run(["squeue", "--noheader", "--Format=TimeLeft:32", "--job", os.environ["SLURM_JOB_ID"]],
                              capture_output=True, text=True, timeout=60, check=True).stdout
        return time.time() + seconds_of(said.split()[0])
    except (OSError, subprocess.SubprocessError, ValueError, IndexError):
        return None


def seconds_of(said):
    """Of Slurm's [days-][hours:]minutes:seconds."""
    days, _, rest = said.rpartition("-")
    seconds = 0
    for part in rest.split(":"):
        seconds = 60 * seconds + int(part)
    return seconds + 86400 * int(days or 0)


def checkpoint(folder):
    """The newest in the folder, a path, or None."""
    return next((folder / name for name in ("checkpoint.h5", "checkpoint_older.h5") if (folder / name).exists()), None)


class Begun:
    """The run of a command whose files lie in `folder`; `program` is the word of it that knows -restart. `used`: wall
    and processor time of earlier parts, s."""

    def __init__(self, folder, command, program):
        self.folder, self.command, self.program = folder, command, program
        self.file = folder / "begun.yaml"
        self.own = shlex.join(command[command.index(program):])
        self.used = (0, 0)
        self.goes_on = self.is_the_same()

    def is_the_same(self):
        try:
            known = yaml.safe_load(self.file.read_text())
            if known["command"] != self.own:
                return False
            if Path(self.program).stat().st_mtime > checkpoint(self.folder).stat().st_mtime:
                return False
            self.used = (float(known["wall_seconds"]), float(known["cpu_seconds"]))
        except (OSError, yaml.YAMLError, KeyError, TypeError, ValueError, AttributeError):
            return False
        return True

    def note(self, used):
        """What is known should this be the last that is heard of the run."""
        wall, cpu = used
        unfinished = self.file.with_name(self.file.name + ".unfinished")
        unfinished.write_text(yaml.safe_dump({"command": self.own, "wall_seconds": round(wall, 3),
                                              "cpu_seconds": round(cpu, 3)}, width=1000))
        os.replace(unfinished, self.file)

    def forget(self):
        self.file.unlink(missing_ok=True)

    def run(self, run, used):
        """The reason why it failed, or None. `run(command, mode of the log)` gives exit code and reason; `used()` the
        time so far. Raises KeyboardInterrupt when the run is to go on later."""
        try:
            ends = job_ends()
            if ends is None:
                wall = []
            elif (left := ends - time.time() - BEFORE_END) < LEAST:
                raise KeyboardInterrupt
            else:
                wall = ["-time_wall", f"{left / 60:.2f}"]
            code, reason = REFUSED, None
            if self.goes_on:
                code, reason = run([*self.command, *wall, "-restart", str(self.folder)], "ab")
            if code == REFUSED:  # it does not fit, or there is none
                self.used = (0, 0)
                for old in ("checkpoint.h5", "checkpoint_older.h5"):
                    (self.folder / old).unlink(missing_ok=True)
                self.note((0, 0))
                code, reason = run([*self.command, *wall], "ab" if self.goes_on else "wb")
            if code == STOPPED:
                raise KeyboardInterrupt
        except KeyboardInterrupt:
            if self.file.exists():
                self.note(used())
            raise
        return reason


if __name__ == "__main__":
    raise SystemExit("slipscale.running.going_on is a library, no command: slipscale -h lists the commands.")
