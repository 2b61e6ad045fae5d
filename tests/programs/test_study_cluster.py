"""Studies on a cluster, with a stand-in for Slurm that runs each job at once: the profile, an array of jobs, what they
ask for, and how they go on after a job was lost."""

import json
import os
import re
import shlex
import subprocess
import tempfile
import unittest
from pathlib import Path

import studies
import yaml
from running import datasets

PROFILE = studies.RUNS / "profiles" / "slurm"

# Runs a job as Slurm would and prints its number. A job whose words hold what `lost` says is lost without a trace; one
# that depends on a lost one is not run. In a job that `stopped` names, slide gets SIGUSR1 once it has left a checkpoint.
SBATCH = r'''#!/usr/bin/python3
import json, os, signal, subprocess, sys, time
from pathlib import Path

def slides(group):
    """(number, folder) of each slide of a process group."""
    for path in Path("/proc").glob("[0-9]*"):
        try:
            if os.getpgid(int(path.name)) == group and (path / "comm").read_text() == "slide\n":
                words = (path / "cmdline").read_text().split("\0")
                yield int(path.name), Path(os.readlink(path / "cwd")) / words[words.index("-output_folder") + 1]
        except (OSError, ValueError):
            pass

def run(script, log, words, stop):
    begin = time.time()
    job = subprocess.Popen(script, stdout=log, stderr=log, stdin=subprocess.DEVNULL, env={**os.environ, **words},
                           process_group=0)
    while stop and job.poll() is None:
        for number, folder in slides(job.pid):
            left = folder / "checkpoint.h5"
            if stop and left.exists() and left.stat().st_mtime > begin:
                os.kill(number, signal.SIGUSR1)
                stop = False
        time.sleep(0.02)
    return job.wait()

here = Path(__file__).parent
options = dict(word[2:].partition("=")[::2] for word in sys.argv[1:] if word.startswith("--"))
script = options["wrap"] if "wrap" in options else sys.argv[-1]
number = len(list(here.glob("job-*.json"))) + 1
lost, stopped = ((here / name).read_text().split() if (here / name).exists() else [] for name in ("lost", "stopped"))
states = []
before = [here / f"job-{word}.json" for word in options.get("dependency", "").split(":")[1:]]
never = any(json.loads(path.read_text())["state"] != "COMPLETED" for path in before)
first, last = map(int, options.get("array", "1-1").split("-"))
for task in range(first, last + 1):
    words = {"SLURM_JOB_ID": str(number), "SLURM_JOB_END_TIME": str(int(time.time()) + 60 * int(options.get("time", 60)))}
    if "ntasks" in options:
        words["SLURM_NTASKS"] = options["ntasks"]
    if "array" in options:
        words.update(SLURM_ARRAY_TASK_ID=str(task), SLURM_ARRAY_TASK_COUNT=str(last))
    name = f"{options['job-name']}{task if 'array' in options else ''}"
    if never or name in lost:
        states.append("CANCELLED" if never else "NODE_FAIL")
        lost = [other for other in lost if other != name]
    else:
        with (here / f"job-{number}-{task}.log").open("w") as log:
            code = run(["sh", "-c", script] if "wrap" in options else ["sh", script], log, words, name in stopped)
        stopped = [other for other in stopped if other != name]
        states.append("FAILED" if code else "COMPLETED")
(here / "lost").write_text(" ".join(lost))
(here / "stopped").write_text(" ".join(stopped))
state = next((state for state in states if state != "COMPLETED"), "COMPLETED")
(here / f"job-{number}.json").write_text(json.dumps({"options": options, "state": state, "script": script}))
print(number)
'''

SCONTROL = r'''#!/bin/sh
file=$(dirname "$0")/job-$3.json
[ -f "$file" ] || { echo 'slurm_load_jobs error: Invalid job id specified' >&2; exit 1; }
sed 's/.*"state": "\([A-Z_]*\)".*/   JobState=\1 Reason=None/' "$file"
'''

# 100 000 steps of a small block, in which there is time for a signal.
LONG = {"scene": {"time": {"end": 50e-6, "step": 0.5e-9}, "history": {"every": 100}, "contact": {"every": 5000},
                  "fields": {"every": 20000}, "statistics": {"from": 10e-6}, "checkpoint": {"every": 5000}},
        "sweep": {"friction_coefficient": [0.2, 0.5], "surface_speed": 2, "size": 1e-3}}
SWEEP = {"friction_coefficient": [0.1, 0.2, -0.5], "surface_speed": 2, "size": 1e-3}


class Cluster(studies.StudyCase):
    study = "sweep"
    place = "cluster"

    def setUp(self):
        super().setUp()
        self.slurm = self.folder / "slurm"
        self.slurm.mkdir()
        for name, text in (("sbatch", SBATCH), ("scontrol", SCONTROL), ("sacct", "#!/bin/sh\nexit 1\n")):
            (self.slurm / name).write_text(text)
            (self.slurm / name).chmod(0o755)

    def environment(self):
        kept = {name: value for name, value in os.environ.items() if not name.startswith(("SLURM_", "SBATCH_"))}
        # With CI snakemake asks for a job's state every second, not every ten.
        return {**kept, "CI": "true", "HOME": str(self.folder), "PATH": f"{self.slurm}:{os.environ['PATH']}"}

    def config(self, **changes):
        self.command(**{"sweep": SWEEP, "scene": {"time": {"end": 40e-6}, "history": {"every": 2}}, **changes})
        return ["--directory", self.folder, "--configfile", self.folder / "config.yaml"]

    def start(self, *words):
        return subprocess.run(list(map(str, words)), cwd=self.folder, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, text=True, timeout=studies.SECONDS, env=self.environment())

    def jobs(self, name):
        """What the jobs of this name (a pattern) asked for, in order."""
        files = sorted(self.slurm.glob("job-*.json"), key=lambda file: int(re.search(r"\d+", file.name)[0]))
        jobs = [json.loads(file.read_text()) for file in files if "-" not in file.stem[4:]]
        return [job for job in jobs if re.match(name, job["options"]["job-name"])]

    def statuses(self):
        return [row["status"] for row in self.table()]

    def logs(self):
        return "\n".join(log.read_text()[-3000:] for log in self.slurm.glob("*.log"))

    def test_a_job_for_each_run(self):
        name = "slide-friction_coefficient_0.2-surface_speed_2-size_0.001"
        (self.slurm / "lost").write_text(name)
        done = self.start("snakemake", "--profile", PROFILE, "--latency-wait", 1, "--snakefile", self.snakefile,
                          *self.config(ranks=2, limit=90))
        self.assertEqual(done.returncode, 0, done.stdout + self.logs())
        self.assertEqual(self.statuses(), ["ok", "ok", "failed"])
        self.assertEqual([job["state"] for job in self.jobs(name)], ["NODE_FAIL", "COMPLETED"])  # sent once more
        self.assertEqual(len(self.jobs("slide")), 4)  # a program that fails is a result
        asked = self.jobs("slide")[0]["options"]
        self.assertEqual([asked[option] for option in ("ntasks", "cpus-per-task", "time", "mem")],
                         ["2", "1", "4", "2000"])
        self.assertEqual(self.jobs("mesh")[0]["options"]["ntasks"], "1")
        outcome = next((self.out / "run").glob("*0.2*/outcome.yaml")).read_text()
        self.assertIn("command: mpirun -n 2 ", outcome)
        self.assertTrue((self.folder / "out" / "slurm").is_dir())

    def test_an_array_of_jobs(self):
        array = (PROFILE / "array.sh", "-n", 2, "-t", 30, 2, self.snakefile, *self.config())
        (self.slurm / "lost").write_text("sweep-runs2")
        done = self.start(*array)
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertEqual([job["state"] for job in self.jobs("sweep-")], ["COMPLETED", "NODE_FAIL", "CANCELLED"],
                         self.logs())
        runs = self.jobs("sweep-runs")[0]["options"]
        self.assertEqual([runs[option] for option in ("array", "ntasks", "time", "dependency")],
                         ["1-2", "2", "30", "afterok:1"])
        self.assertFalse((self.out / "table.csv").exists())
        before = self.written()
        self.assertEqual(len(before), 1 + 3 - 1)  # the mesh, and the runs without the second task's

        done = self.start(*array)
        self.assertEqual([job["state"] for job in self.jobs("sweep-")][3:], ["COMPLETED"] * 3, self.logs())
        self.assertEqual(self.run_again(before), {"run/friction_coefficient_0.2-surface_speed_2-size_0.001"})
        self.assertEqual(self.statuses(), ["ok", "ok", "failed"])
        self.assertTrue((self.out / "report.md").exists())

    def check_went_on(self, run, starts):
        """That a run started so often and left what one that nobody stopped leaves."""
        found = self.out / "run" / run
        log = (found / "log.txt").read_text()
        self.assertEqual(log.count("interrupted by SIGUSR1"), starts - 1, log[-3000:])
        self.assertEqual(log.count("steps to"), starts, log[-3000:])
        self.assertFalse((found / "begun.yaml").exists())
        words = shlex.split(yaml.safe_load((found / "outcome.yaml").read_text())["command"])
        self.assertEqual(words[-2], "-output_folder")
        self.assertNotIn("-restart", words)
        done = self.start(*words[:-1], self.folder / "whole")
        self.assertEqual(done.returncode, 0, done.stdout)
        for file in ("history.h5", "contact.h5", "fields.h5", "statistics.h5"):
            one, other = datasets(found / file), datasets(self.folder / "whole" / file)
            self.assertEqual(one.keys(), other.keys())
            for name, values in one.items():
                self.assertEqual(values.tobytes(), other[name].tobytes(), f"{file}: {name}")

    def test_a_run_longer_than_its_job_goes_on_in_the_next(self):
        run = "friction_coefficient_0.5-surface_speed_2-size_0.001"
        (self.slurm / "stopped").write_text(f"slide-{run}")
        done = self.start("snakemake", "--profile", PROFILE, "--latency-wait", 1, "--set-resources", "slide:runtime=60",
                          "--snakefile", self.snakefile, *self.config(**LONG))
        self.assertEqual(done.returncode, 0, done.stdout + self.logs())
        self.assertEqual([job["state"] for job in self.jobs(f"slide-{run}")], ["FAILED", "COMPLETED"])
        asked = self.jobs("slide")[0]["options"]
        self.assertEqual((asked["time"], asked["signal"]), ("60", "USR1@60"))
        self.assertNotIn("signal", self.jobs("mesh")[0]["options"])
        self.assertEqual(self.statuses(), ["ok", "ok"])
        self.check_went_on(run, starts=2)

    def test_an_array_goes_on_with_the_same_command(self):
        run = "friction_coefficient_0.5-surface_speed_2-size_0.001"  # of the second task
        array = (PROFILE / "array.sh", 2, self.snakefile, *self.config(**LONG))
        for _ in range(2):
            (self.slurm / "stopped").write_text("sweep-runs2")
            done = self.start(*array)
            self.assertEqual(done.returncode, 0, done.stdout)
            self.assertEqual([job["state"] for job in self.jobs("sweep-")[-3:]], ["COMPLETED", "FAILED", "CANCELLED"],
                             self.logs())
            self.assertTrue((self.out / "run" / run / "begun.yaml").exists())
        before = self.written()
        self.start(*array)
        self.assertEqual([job["state"] for job in self.jobs("sweep-")[-3:]], ["COMPLETED"] * 3, self.logs())
        self.assertEqual(self.run_again(before), {f"run/{run}"})
        self.check_went_on(run, starts=3)

    def test_a_scene_that_changed_since_starts_anew(self):
        run = "friction_coefficient_0.5-surface_speed_2-size_0.001"
        (self.slurm / "stopped").write_text("sweep-runs2")
        self.start(PROFILE / "array.sh", 2, self.snakefile, *self.config(**LONG))
        self.assertTrue((self.out / "run" / run / "begun.yaml").exists())
        changed = {**LONG, "scene": {**LONG["scene"], "damping": {"stiffness": 3e-9}}}
        self.start(PROFILE / "array.sh", 2, self.snakefile, *self.config(**changed))
        self.assertEqual(self.statuses(), ["ok", "ok"])
        self.assertIn("stiffness: 3e-09", (self.out / "run" / run / "run.yaml").read_text().replace("3.0e-09", "3e-09")
                      .replace("damping_stiffness", "stiffness"))

    def test_an_array_too_small_for_the_ranks_of_a_run(self):
        self.start(PROFILE / "array.sh", 2, self.snakefile, *self.config(ranks=2))
        self.assertEqual([job["state"] for job in self.jobs("sweep-")], ["COMPLETED", "FAILED", "CANCELLED"])
        self.assertIn("array.sh -n 2", self.logs())
        self.assertFalse(list(self.out.glob("run/*/outcome.yaml")))

    def test_what_a_job_asks_for(self):
        needs = {"ranks": 2, "mem_mb": 500, "runtime": 7, "exclusive": 1, "stops": 60}
        asked = "--ntasks=2 --cpus-per-task=2 --time=7 --mem=500 --signal=USR1@60 --exclusive"
        for resources, threads, words in ((needs, 4, asked),
                                          ({"exclusive": 0, "stops": 0}, 1, "--ntasks=1 --cpus-per-task=1")):
            script = self.folder / "job.sh"
            properties = {"rule": "mesh", "wildcards": {"mesh": "a"}, "threads": threads, "resources": resources}
            script.write_text(f"#!/bin/sh\n# properties = {json.dumps(properties)}\ntrue\n")
            self.assertEqual(self.start(PROFILE / "submit.py", script).returncode, 0)
            asked = self.jobs("mesh-a")[-1]["options"]
            said = " ".join(f"--{name}={value}".removesuffix("=") for name, value in asked.items()
                            if name not in ("parsable", "job-name", "output"))
            self.assertEqual(said, words)

    def test_words_of_an_array(self):
        done = self.start(PROFILE / "array.sh", 2)
        self.assertEqual(done.returncode, 2)
        self.assertIn("TASKS SNAKEFILE", done.stdout)


class Status(unittest.TestCase):
    """What snakemake is told of a job, by accounting or else by the controller."""

    def said(self, state, known_to):
        with tempfile.TemporaryDirectory() as folder:
            shows = {"sacct": f"echo {state}", "scontrol": f"echo '   JobState={state} Reason=None'"}
            for name, command in shows.items():
                (Path(folder) / name).write_text(f"#!/bin/sh\n{command if name == known_to else 'exit 1'}\n")
                (Path(folder) / name).chmod(0o755)
            return subprocess.run([PROFILE / "status.sh", "7"], capture_output=True, text=True, timeout=60,
                                  env={**os.environ, "PATH": f"{folder}:{os.environ['PATH']}"}).stdout.strip()

    def test_states(self):
        for state, expected in (("COMPLETED", "success"), ("RUNNING", "running"), ("PENDING", "running"),
                                ("REQUEUED", "running"), ("NODE_FAIL", "failed"), ("TIMEOUT", "failed"),
                                ("OUT_OF_MEMORY", "failed"), ("CANCELLED by 0", "failed")):
            for program in ("sacct", "scontrol"):
                self.assertEqual(self.said(state, program), expected, (state, program))
        self.assertEqual(self.said("", "nobody"), "running")  # the controller does not answer
        self.assertEqual(self.said("slurm_load_jobs error: Invalid job id specified", "scontrol"), "failed")


if __name__ == "__main__":
    studies.main()
