"""How programs end, and what is kept of it."""

import contextlib
import io
import signal
import subprocess
import sys
import tempfile
import time
import unittest
from pathlib import Path

import yaml

from slipscale.running import attempt

RUNS = Path(__file__).parents[2]


class Attempt(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        self.outcome = self.folder / "run" / "outcome.yaml"

    def main(self, *words):
        """Exit code and what stands in outcome.yaml."""
        with contextlib.redirect_stderr(io.StringIO()):
            code = attempt.main([str(self.outcome), *map(str, words)])
        return code, yaml.safe_load(self.outcome.read_text())

    def test_success(self):
        code, found = self.main("--set", "size=64", "rtol=1e-10", "element=triangle", "--", "sh", "-c",
                                "echo done; sleep .2")
        self.assertEqual(code, 0)
        self.assertEqual((found["status"], found["reason"]), ("ok", None))
        self.assertEqual(found["options"], {"size": 64, "rtol": 1e-10, "element": "triangle"})
        self.assertEqual(found["command"], "sh -c 'echo done; sleep .2'")
        self.assertTrue(0.2 <= found["wall_seconds"] < 20)
        self.assertTrue(0 <= found["cpu_seconds"] < 0.2)  # it sleeps
        self.assertEqual((self.outcome.parent / "log.txt").read_text(), "done\n")
        self.assertEqual({file.name for file in self.outcome.parent.iterdir()}, {"outcome.yaml", "log.txt"})

    def test_seconds_computed(self):
        busy = "import time\nwhile time.process_time() < 0.3: pass"
        found = self.main("--", sys.executable, "-c", busy)[1]
        self.assertTrue(0.3 <= found["cpu_seconds"] <= found["wall_seconds"] + 0.05, found)  # one process, one core

    def test_memory(self):
        """In a process of its own, as studies start it: 200 MB that the program fills."""
        subprocess.run([sys.executable, "-m", "slipscale.running.attempt", self.outcome, "--", sys.executable, "-c",
                        "filled = bytearray(b'x') * 200_000_000"], check=True, cwd=RUNS)
        self.assertTrue(200e6 <= yaml.safe_load(self.outcome.read_text())["peak_memory"] < 300e6)

    def test_failure_is_kept_with_its_last_words(self):
        code, found = self.main("--", "sh", "-c", "echo working; echo 'prog: no such mesh' >&2; echo; exit 2")
        self.assertEqual((code, found["status"], found["reason"]), (0, "failed", "prog: no such mesh"))

    def test_failure_in_silence(self):
        self.assertEqual(self.main("--", "false")[1]["reason"], "nothing was said")

    def test_killed(self):
        found = self.main("--", "sh", "-c", "echo step 7; kill -KILL $$")[1]
        self.assertEqual((found["status"], found["reason"]), ("failed", "killed by SIGKILL after: step 7"))

    def test_longer_than_its_limit(self):
        start = time.monotonic()
        found = self.main("--limit", 0.5, "--", "sleep", "60")[1]
        self.assertLess(time.monotonic() - start, 30)
        self.assertEqual((found["status"], found["reason"]), ("failed", "it took longer than 0.5 s"))

    def test_no_such_program(self):
        self.assertEqual(self.main("--", "/nowhere/prog")[1]["reason"],
                         "/nowhere/prog cannot be run (No such file or directory)")

    def test_nothing_is_run_after_a_failure(self):
        mesh, other = self.folder / "mesh" / "outcome.yaml", self.folder / "other" / "outcome.yaml"
        attempt.attempt(mesh, ["sh", "-c", "echo too coarse; exit 2"])
        attempt.attempt(other, ["true"])
        found = self.main("--after", other, mesh, "--", "touch", self.folder / "ran")[1]
        self.assertEqual((found["status"], found["reason"]), ("failed", "the run was not started: too coarse"))
        self.assertFalse((self.folder / "ran").exists())
        self.assertEqual(self.main("--after", other, "--", "touch", self.folder / "ran")[1]["status"], "ok")
        self.assertTrue((self.folder / "ran").exists())

    def test_an_interruption_is_no_result(self):
        for name in ("INT", "TERM", "HUP"):
            with contextlib.redirect_stderr(io.StringIO()):
                self.assertEqual(attempt.main([str(self.outcome), "--", "sh", "-c", f"kill -{name} $$"]), 1)
            self.assertFalse(self.outcome.exists())

    def test_interrupted_itself(self):
        """As by Ctrl-C, which reaches program and attempt."""
        process = subprocess.Popen([sys.executable, "-m", "slipscale.running.attempt", self.outcome, "--", "sleep",
                                    "60"],
                                   cwd=RUNS, stderr=subprocess.DEVNULL, start_new_session=True)
        log = self.outcome.parent / "log.txt"
        while not log.exists():
            time.sleep(0.02)
        process.send_signal(signal.SIGINT)
        self.assertNotEqual(process.wait(timeout=30), 0)
        self.assertFalse(self.outcome.exists())

    def test_needs_a_program(self):
        with self.assertRaises(SystemExit), contextlib.redirect_stderr(io.StringIO()) as said:
            attempt.main([str(self.outcome)])
        self.assertIn("the program to run stands after --", said.getvalue())


if __name__ == "__main__":
    unittest.main()
