"""Runs a program and writes how it ended, so that a study keeps its failures beside its results.

    python3 -m slipscale.running.attempt FOLDER/outcome.yaml [--after OTHER/outcome.yaml] [--limit SECONDS]
        [--restart PROGRAM] [--set name=value ...] -- program arguments ...

outcome.yaml: `options`, what --set names; `status`, ok or failed; `reason`, the last thing said by a program that
failed; `wall_seconds`; `cpu_seconds`, of all its processes; `peak_memory`, B, the most that one of them held; `command`.
After a failure named by --after, the program is not run and fails for the same reason. Everything said is in log.txt
beside it. The exit code is 0 either way: a failure is a result. An interrupted program (SIGINT, SIGTERM, SIGHUP, SIGUSR1, or stopped by itself: exit code 3) is none:
it leaves no outcome, and the exit code is 1. --restart: see `going_on`.
"""

import os
import resource
import shlex
import signal
import subprocess
import sys
import threading
import time
from pathlib import Path

import yaml

from slipscale.parser import Parser
from slipscale.reading.yaml_file import load
from slipscale.running import going_on

INTERRUPTIONS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGUSR1)
# A program that is started without mpirun needs no daemon of Open MPI's: a process less for each short run.
ALONE = {"OMPI_MCA_ess_singleton_isolated": "1"}
FAILED_BEFORE = "the run was not started"
PATIENCE = 10  # s, for a program that a signal reached too, to write its checkpoint


def last_words(log):
    """The last line said that is not empty, for a reason."""
    lines = [line.strip() for line in log.read_text(errors="replace").splitlines() if line.strip()]
    return lines[-1] if lines else "nothing was said"


def raise_interrupt(*_):
    raise KeyboardInterrupt


def ended(process, limit):
    """Waits for the end; after `limit` s it is killed and TimeoutExpired raised. A signal to this process is as one to
    the program: it is given time to end by itself, then told."""
    mine = threading.current_thread() is threading.main_thread()
    before = {number: signal.signal(number, raise_interrupt) for number in INTERRUPTIONS if mine}
    try:
        process.wait(limit)
    except KeyboardInterrupt:
        for tell in (process.terminate, process.kill):
            try:
                process.wait(PATIENCE)
            except subprocess.TimeoutExpired:
                tell()
        process.wait()
        raise
    except subprocess.TimeoutExpired:
        process.kill()
        process.wait()
        raise
    finally:
        for number, handler in before.items():
            signal.signal(number, handler)


def run(command, log, limit=None, mode="wb", used=0):
    """Runs `command` (list of words) into the file `log`: exit code and reason why it failed, or None. `used`: s of the
    limit that are gone. Raises KeyboardInterrupt when the program was interrupted."""
    with log.open(mode) as file:
        try:
            process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=file, stderr=subprocess.STDOUT,
                                       env={**ALONE, **os.environ})
            ended(process, None if limit is None else limit - used)
        except subprocess.TimeoutExpired:
            return None, f"it took longer than {limit:g} s"
        except OSError as error:
            return None, f"{command[0]} cannot be run ({error.strerror})"
    code = process.returncode
    if -code in INTERRUPTIONS or code - 128 in INTERRUPTIONS:  # the second from a launcher
        raise KeyboardInterrupt
    if code < 0:
        return code, f"killed by {signal.Signals(-code).name} after: {last_words(log)}"
    return code, last_words(log) if code else None


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


def peak_memory():
    """The most that one of the processes started and ended so far held, B: of this run alone where it was the only
    one."""
    return 1024 * resource.getrusage(resource.RUSAGE_CHILDREN).ru_maxrss


def attempt(outcome, command, options=None, after=(), limit=None, restart=None):
    """Runs `command` and writes the outcome (a path). Returns what was written, as a dict. `restart`: the word of the
    command that names a program with checkpoints, see `going_on`. Raises KeyboardInterrupt."""
    outcome.parent.mkdir(parents=True, exist_ok=True)
    reasons = [earlier["reason"] for earlier in (load(path, written=True) for path in after)
               if earlier["status"] != "ok"]
    start, computed = time.monotonic(), cpu_seconds()
    log = outcome.parent / "log.txt"
    begun = going_on.Begun(outcome.parent, command, restart) if restart and not reasons else None

    def used():
        """Wall and processor time of this run so far, s."""
        earlier = begun.used if begun else (0, 0)
        return earlier[0] + time.monotonic() - start, earlier[1] + cpu_seconds() - computed

    if reasons:
        reason = f"{FAILED_BEFORE}: {reasons[0]}"
    elif begun:
        reason = begun.run(lambda words, mode: run(words, log, limit, mode, begun.used[0]), used)
    else:
        reason = run(command, log, limit)[1]
    wall, cpu = used()
    found = {"options": options or {}, "status": "failed" if reason else "ok", "reason": reason,
             "wall_seconds": round(wall, 3), "cpu_seconds": round(cpu, 3), "peak_memory": peak_memory(), "command": shlex.join(command)}
    write_whole(outcome, yaml.safe_dump(found, sort_keys=False, allow_unicode=True, width=1000))
    if begun:
        begun.forget()
    return found


def main(arguments=None):
    arguments = sys.argv[1:] if arguments is None else arguments
    parser = Parser("slipscale.running.attempt", __doc__, "python3 -m")
    parser.add_argument("outcome", type=Path, help="YAML file to write")
    parser.add_argument("--after", type=Path, nargs="*", default=[], help="outcomes that have to be ok")
    parser.add_argument("--limit", type=float, help="seconds after which the program is ended")
    parser.add_argument("--restart", metavar="PROGRAM", help="word of the command: a program that leaves checkpoints, to "
                        "go on with if this command was interrupted before")
    parser.add_argument("--set", nargs="*", default=[], metavar="NAME=VALUE", help="options that made this run")
    cut = arguments.index("--") if "--" in arguments else len(arguments)
    given, command = parser.parse_args(arguments[:cut]), arguments[cut + 1:]
    if not command:
        parser.error("the program to run stands after --")
    if given.restart and given.restart not in command:
        parser.error(f"--restart names {given.restart}, which is no word of the command")
    options = {name: number_or_text(value) for name, _, value in (word.partition("=") for word in given.set)}
    try:
        found = attempt(given.outcome, command, options, given.after, given.limit,
                        given.restart)
    except KeyboardInterrupt:
        print(f"interrupted: {shlex.join(command)}", file=sys.stderr)
        return 1
    if found["reason"]:
        print(f"{given.outcome}: {found['reason']}", file=sys.stderr)
    return 0


if __name__ == "__main__":
    sys.exit(main())
