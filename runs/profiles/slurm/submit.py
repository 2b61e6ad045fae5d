#!/usr/bin/env python3
"""Gives a job of snakemake to Slurm and prints its number; the script of the job, the last word, says what it needs."""

import json
import os
import re
import sys
from pathlib import Path


def sbatch(script):
    """The command for a job's script."""
    job = json.loads(re.search(r"^# properties = (.*)$", Path(script).read_text(), re.MULTILINE)[1])
    needs, ranks = job["resources"], int(job["resources"].get("ranks", 1))
    name = "-".join([job.get("rule") or job.get("groupid", "group"), *map(str, job.get("wildcards", {}).values())])
    words = ["sbatch", "--parsable", f"--job-name={name}", f"--output={Path('out/slurm').resolve()}/%x-%j.log",
             f"--ntasks={ranks}", f"--cpus-per-task={max(1, job.get('threads', 1) // ranks)}"]
    for option, resource in (("time", "runtime"), ("mem", "mem_mb")):
        words += [f"--{option}={needs[resource]}"] if resource in needs else []
    # To the steps of the job, where srun starts the program. Without, the program is told its wall time (going_on.py).
    words += [f"--signal=USR1@{needs['stops']}"] if needs.get("stops") else []
    return [*words, *(["--exclusive"] if needs.get("exclusive") else []), script]


if __name__ == "__main__":
    Path("out/slurm").mkdir(parents=True, exist_ok=True)
    command = sbatch(sys.argv[-1])
    os.execvp(command[0], command)
