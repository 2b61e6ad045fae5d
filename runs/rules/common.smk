# What the Snakefiles of all studies share: where things are, how a program is started, and that a failure is a result.
# A study's Snakefile includes this first. Everything in its study.yaml can be overruled, with --config or --configfile;
# --config study=FILE takes another file in its place. Files are found and results written from where the user stands
# (or --directory says), files that come with a study from the folder that holds `runs` too.
import os
import shlex
import shutil
import sys
from pathlib import Path

TOP = Path(workflow.basedir).parents[1]
sys.path.insert(0, str(TOP / "runs"))
from slipscale.mistakes import Mistake
from slipscale.running import ended, programs, studies
from slipscale.running.commands import settings, words
from slipscale.running.table import named_runs, read_csv, run_name

try:
    SETTINGS = studies.settings_of(config.get("study", f"{workflow.basedir}/study.yaml"),
                                   workflow.overwrite_configfiles, workflow.overwrite_config, workflow.config_args)
except Mistake as mistake:
    sys.exit(f"{workflow.basedir}: {mistake}")
config.clear()
config.update(SETTINGS)

OUT = config["output"]
PROGRAMS = programs.folder(config["programs"])
JOB = "{SLURM_ARRAY_TASK_ID}/{SLURM_ARRAY_TASK_COUNT}".format_map(
    {"SLURM_ARRAY_TASK_ID": 1, "SLURM_ARRAY_TASK_COUNT": 1, **os.environ})
PYTHON = shlex.quote(sys.executable)
ATTEMPT = f"{PYTHON} -m slipscale.running.attempt"
SLIPSCALE = f"{PYTHON} -m slipscale"
# Of jobs whose run may be longer than their time: where jobs are sent again at all, by the profile of a cluster, these go
# on in the next one, and the next.
GOES_ON = 20 if workflow.restart_times else 0

# Unbound: several runs at a time would else all be bound to the same first cores.
os.environ.update(PYTHONPATH=str(TOP / "runs"), SLIPSCALE_PROGRAMS=str(PROGRAMS), OMP_NUM_THREADS="1",
                  OPENBLAS_NUM_THREADS="1", OMPI_MCA_hwloc_base_binding_policy="none")
if os.getuid() == 0:  # as in a container
    os.environ.update(OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
                      OMPI_MCA_btl_vader_single_copy_mechanism="none")

found_from_here = studies.finder(TOP)


def outcome_of(kind, name):
    """How `name`, a mesh, an effective material or a run, ended: a path."""
    return f"{OUT}/{kind}/{name}/outcome.yaml"


def quoted(paths):
    """Paths as words for a shell."""
    return shlex.join(map(str, paths))


def readme_of(folder):
    """The README that is renewed, or None: that of a clone, and of what the study itself says, not of what is laid
    over."""
    return folder if config["readme"] and (TOP / "CMakeLists.txt").is_file() else None


def on_ranks(ranks):
    """What stands before a program that runs on so many ranks; study.yaml may name another launcher, as `srun -n`."""
    if "SLURM_ARRAY_TASK_ID" in os.environ and int(ranks) > int(os.environ.get("SLURM_NTASKS", 1)):
        sys.exit(f"A run on {ranks} ranks needs a job of as many: array.sh -n {ranks}")
    return f"{config.get('mpirun', 'mpirun -n')} {ranks}" if int(ranks) > 1 else ""


def part_of(names, part):
    """Of `names`, every n-th beginning with the k-th, for a `part` k/n: so long and short runs are spread evenly."""
    k, n = map(int, str(part).split("/"))
    return list(names)[k - 1::n]


def say_what_is_run():
    """How many runs there are, and of which groups, before anything runs."""
    if not os.environ.get("SLIPSCALE_STUDY_SAID"):
        print(studies.what_is_run(config, RUNS), file=sys.stderr, flush=True)
        os.environ["SLIPSCALE_STUDY_SAID"] = "1"  # once, not by each job that reads this again


# One of n parts of the runs, --config part=k/n or the part of a task in an array of Slurm's: for several snakemakes,
# each of which makes one.
rule part:
    input: lambda _: [outcome_of("run", name) for name in part_of(RUNS, config.get("part", JOB))]


# After all that the engine says.
onerror:
    table = Path(f"{OUT}/table.csv")
    if table.is_file() and not Path(f"{OUT}/ended.txt").exists():
        sentence, good = ended.said(read_csv(table), table)
        if not good:
            print(sentence, file=sys.stderr)


# The study fails if not one of its runs came to its end, after its table and its report are there.
localrules: ended


rule ended:
    input:
        table=f"{OUT}/table.csv",
        report=f"{OUT}/report.md"
    output: f"{OUT}/ended.txt"
    shell: PYTHON + " -m slipscale.running.ended {input.table:q} {output:q}"
