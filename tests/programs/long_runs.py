"""Runs of slide on a small block that go on while a test does something to their output folder."""

import signal
import subprocess
import time

from running import MPIEXEC, SECONDS, SLIDE, InScratch, arguments_of
from scenes import SQUEAL, block

SCENE = {**SQUEAL, "time_end": 4e-6, "time_step": 2e-8}  # 200 steps
FOR_HOURS = {**SQUEAL, "time_end": 100, "history_every": 20, "contact_every": 1000}
RANKS = (1, 2)


class InBlock(InScratch):
    def setUp(self):
        super().setUp()
        block(self.folder / "block.msh")

    def start(self, scene, ranks):
        command = [SLIDE] if ranks == 1 else [MPIEXEC, "-n", str(ranks), SLIDE]
        job = subprocess.Popen([*command, *arguments_of(scene)], cwd=self.folder, env=self.environment(), text=True,
                               stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.addCleanup(self.end, job)
        return job

    def end(self, job):
        if job.poll() is None:
            job.send_signal(signal.SIGTERM)  # mpiexec then ends the ranks
        job.communicate()

    def wait_for(self, path):
        deadline = time.monotonic() + SECONDS
        while not path.exists():
            self.assertLess(time.monotonic(), deadline, f"no {path.name} for {SECONDS} s")
            time.sleep(0.05)
