"""Runs of `slide` that are stopped in the middle."""

import os
import signal
import subprocess
import time
from pathlib import Path

from running import MPIEXEC, SLIDE, arguments_of, run

SECONDS = float(os.environ.get("SLIPSCALE_SECONDS", "120"))  # a run that takes longer hangs; more under load


def environment(folder):
    """Without what would change a run behind its back."""
    kept = {name: value for name, value in os.environ.items() if not name.startswith("PETSC_OPTIONS")}
    return {**kept, "HOME": str(folder)}


def launch(arguments, folder):
    return run([SLIDE, *arguments], folder, environment(folder))


class Job:
    """A run that goes on: `code` and `err` once it is finished."""

    def __init__(self, options, folder, ranks):
        self.folder = Path(folder)
        self.out = self.folder / str(options.get("output_folder") or options["restart"])
        for old in self.folder.glob("pid.*"):
            old.unlink()
        # exec: the number is the rank's own.
        script = 'echo $$ > pid.${OMPI_COMM_WORLD_RANK:-0}; exec "$0" "$@"'
        launcher = [] if ranks == 1 else [MPIEXEC, "-n", str(ranks)]
        self.before = self.written()
        self.job = subprocess.Popen([*launcher, "bash", "-c", script, SLIDE, *arguments_of(options)], cwd=self.folder,
                                    env=environment(self.folder), stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                                    stderr=subprocess.PIPE, text=True)

    def written(self):
        """When the run last wrote its rows; None before."""
        try:
            return (self.out / "history.h5").stat().st_mtime_ns
        except OSError:
            return None

    def stop(self, how, seconds, chance):
        """Some seconds after its first rows."""
        deadline = time.monotonic() + SECONDS
        while self.written() == self.before and self.job.poll() is None and time.monotonic() < deadline:
            time.sleep(0.002)
        time.sleep(seconds)
        if self.job.poll() is not None:
            return
        if how == "signal":
            self.job.send_signal(signal.SIGUSR1)
            return
        ranks = [int(file.read_text() or 0) for file in sorted(self.folder.glob("pid.*"))]
        for rank in ranks if how == "kill of all" else [chance.choice(ranks)]:
            try:
                os.kill(rank, signal.SIGKILL)
            except ProcessLookupError:
                pass

    def finish(self):
        try:
            _, self.err = self.job.communicate(timeout=SECONDS)
        except subprocess.TimeoutExpired:
            self.job.kill()
            self.job.communicate()
            raise
        self.code = self.job.returncode
