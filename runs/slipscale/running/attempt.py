"""Runs a program and writes how it ended, so that a study keeps its failures beside its results.

    python3 -m slipscale.running.attempt FOLDER/outcome.yaml [--after OTHER/outcome.yaml] [--limit SECONDS]
        [--set name=value ...] -- program arguments ...

outcome.yaml: `options`, what --set names; `status`, ok or failed; `reason`, the last thing said by a program that
failed; `wall_seconds`; `cpu_seconds`, of all its processes; `command`. After a failure named by --after, the program
is not run and fails for the same reason. Everything said is in log.txt beside it. The exit code is 0 either way: a
failure is a result. An interrupted program (SIGINT, SIGTERM, SIGHUP) is none: it leaves no outcome, and the exit code
is 1.
"""

import os
import resource
import shlex
import signal
import subprocess
import sys
import time
from pathlib import Path

import yaml

from slipscale.parser import Parser
from slipscale.reading.yaml_file import load

INTERRUPTIONS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)
# A program that is started without mpirun needs no daemon of Open MPI's: a process less for each short run.
ALONE = {"OMPI_MCA_ess_singleton_isolated": "1"}
FAILED_BEFORE = "the run was not started"


def last_words(log):
    """The last line said that is not empty, for a reason."""
    lines = [line.strip() for line in log.read_text(errors="replace").splitlines() if line.strip()]
    return lines[-1] if lines else "nothing was said"


def run(command, log, limit=None):
    """Runs `command` (list of words) into the file `log`: the reason why it failed, or None. Raises KeyboardInterrupt
    when the program was interrupted."""
    with log.open("wb") as file:
        try:
            done = subprocess.run(command, stdin=subprocess.DEVNULL, stdout=file, stderr=subprocess.STDOUT,
                                  timeout=limit, env={**ALONE, **os.environ})
        except subprocess.TimeoutExpired:
            return f"it took longer than {limit:g} s"
        except OSError as error:
            return f"{command[0]} cannot be run ({error.strerror})"
    if done.returncode < 0 and -done.returncode in INTERRUPTIONS:
        raise KeyboardInterrupt
    if done.returncode < 0:
        return f"killed by {signal.Signals(-done.returncode).name} after: {last_words(log)}"
    return last_words(log) if done.returncode else None


def number_or_text(text):
    """What a command line or a table says: an int, a float, the text, or None for nothing."""
    for kind in (int, float) if "_" not in text else ():
        try:
            return kind(text)
        except ValueError:
            continue
    return text or None


def write_whole(path, text):
    """Under its final name the file is there completely or not at all."""
    unfinished = path.with_name(path.name + ".unfinished")
    unfinished.write_text(text)
    os.replace(unfinished, path)


def cpu_seconds():
    """Time that the processes started and ended so far have computed, s: what runs beside them costs less of it than of
    the time that passes."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def attempt(outcome, command, options=None, after=(), limit=None):
    """Runs `command` and writes the outcome (a path). Returns what was written, as a dict."""
    outcome.parent.mkdir(parents=True, exist_ok=True)
    reasons = [earlier["reason"] for earlier in (load(path, written=True) for path in after)
               if earlier["status"] != "ok"]
    start, computed = time.monotonic(), cpu_seconds()
    reason = f"{FAILED_BEFORE}: {reasons[0]}" if reasons else run(command, outcome.parent / "log.txt", limit)
    found = {"options": options or {}, "status": "failed" if reason else "ok", "reason": reason,
             "wall_seconds": round(time.monotonic() - start, 3), "cpu_seconds": round(cpu_seconds() - computed, 3),
             "command": shlex.join(command)}
    write_whole(outcome, yaml.safe_dump(found, sort_keys=False, allow_unicode=True, width=1000))
    return found


def main(arguments=None):
    arguments = sys.argv[1:] if arguments is None else arguments
    parser = Parser("slipscale.running.attempt", __doc__, "python3 -m")
    parser.add_argument("outcome", type=Path, help="YAML file to write")
    parser.add_argument("--after", type=Path, nargs="*", default=[], help="outcomes that have to be ok")
    parser.add_argument("--limit", type=float, help="seconds after which the program is ended")
    parser.add_argument("--set", nargs="*", default=[], metavar="NAME=VALUE", help="options that made this run")
    cut = arguments.index("--") if "--" in arguments else len(arguments)
    given, command = parser.parse_args(arguments[:cut]), arguments[cut + 1:]
    if not command:
        parser.error("the program to run stands after --")
    options = {name: number_or_text(value) for name, _, value in (word.partition("=") for word in given.set)}
    try:
        found = attempt(given.outcome, command, options, given.after, given.limit)
    except KeyboardInterrupt:
        print(f"interrupted: {shlex.join(command)}", file=sys.stderr)
        return 1
    if found["reason"]:
        print(f"{given.outcome}: {found['reason']}", file=sys.stderr)
    return 0


if __name__ == "__main__":
    sys.exit(main())
