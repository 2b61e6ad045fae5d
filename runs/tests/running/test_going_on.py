"""Runs that are stopped go on, if they are the same; otherwise they start anew."""

import contextlib
import io
import os
import tempfile
import time
import unittest
from pathlib import Path
from unittest import mock

import yaml

from slipscale.running import attempt, going_on

# Leaves a checkpoint and its words; ends as the file `code` says, or `refuses` a restart.
PROGRAM = """#!/bin/sh
here=$(dirname "$0")
echo "$*" >> "$here/words"
case "$*" in
  *-restart*) [ -e "$here/refuses" ] && { echo "slide: -friction is 2, but the run has 1" >&2; exit 2; } ;;
esac
echo state > "$here/run/checkpoint.h5"
exit $(cat "$here/code")
"""


class GoingOn(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        self.run_folder, self.program = self.folder / "run", self.folder / "slide"
        self.program.write_text(PROGRAM)
        self.program.chmod(0o755)
        os.utime(self.program, (0, 0))
        self.outcome = self.run_folder / "outcome.yaml"

    def attempt(self, code, *options, launcher=("env",), limit=(), **environment):
        """Exit code, and the words of the programs that were started."""
        (self.folder / "code").write_text(str(code))
        (self.folder / "words").write_text("")
        kept = {name: value for name, value in os.environ.items() if not name.startswith("SLURM_")}
        with contextlib.redirect_stderr(io.StringIO()), mock.patch.dict(os.environ, {**kept, **environment}, clear=True):
            found = attempt.main([str(self.outcome), "--restart", str(self.program), *limit, "--", *launcher,
                                  str(self.program), *(options or ("-friction", "1"))])
        return found, (self.folder / "words").read_text().splitlines()

    def result(self):
        return yaml.safe_load(self.outcome.read_text())

    def test_a_stopped_run_goes_on(self):
        self.assertEqual(self.attempt(3), (1, ["-friction 1"]))
        self.assertFalse(self.outcome.exists())
        begun = yaml.safe_load((self.run_folder / "begun.yaml").read_text())
        (self.run_folder / "begun.yaml").write_text(yaml.safe_dump({**begun, "wall_seconds": 100, "cpu_seconds": 50}))
        goes_on = f"-friction 1 -restart {self.run_folder}"
        self.assertEqual(self.attempt(3), (1, [goes_on]))
        self.assertEqual(self.attempt(0, launcher=("nice", "-n", "1")), (0, [goes_on]))  # how it is started is no matter
        found = self.result()
        self.assertEqual((found["status"], found["command"]), ("ok", f"nice -n 1 {self.program} -friction 1"))
        self.assertTrue(100 < found["wall_seconds"] < 130 and 50 <= found["cpu_seconds"] < 80, found)
        self.assertFalse((self.run_folder / "begun.yaml").exists())
        self.assertEqual(self.attempt(0), (0, ["-friction 1"]))  # that run has ended

    def test_without_a_checkpoint_or_with_other_options_it_starts_anew(self):
        self.attempt(3)
        (self.run_folder / "checkpoint.h5").unlink()
        self.assertEqual(self.attempt(3), (1, ["-friction 1"]))
        (self.run_folder / "checkpoint.h5").rename(self.run_folder / "checkpoint_older.h5")
        self.assertEqual(self.attempt(3)[1], [f"-friction 1 -restart {self.run_folder}"])
        self.assertEqual(self.attempt(3, "-friction", "2"), (1, ["-friction 2"]))
        os.utime(self.program, (time.time() + 100,) * 2)  # compiled since
        self.assertEqual(self.attempt(3, "-friction", "2"), (1, ["-friction 2"]))

    def test_what_does_not_fit_starts_anew(self):
        self.attempt(3)
        (self.folder / "refuses").touch()
        self.assertEqual(self.attempt(0), (0, [f"-friction 1 -restart {self.run_folder}", "-friction 1"]))
        self.assertIn("but the run has 1", (self.run_folder / "log.txt").read_text())
        self.assertEqual(self.attempt(2), (0, ["-friction 1"]))
        self.assertEqual(self.result()["status"], "failed")

    def test_the_limit_counts_what_is_behind_a_run(self):
        self.attempt(3)
        begun = {"command": f"{self.program} -friction 1", "wall_seconds": 100, "cpu_seconds": 50}
        (self.run_folder / "begun.yaml").write_text(yaml.safe_dump(begun))
        self.attempt(0, limit=("--limit", "100"))
        self.assertEqual(self.result()["reason"], "it took longer than 100 s")

    def test_within_a_job(self):
        job = {"SLURM_JOB_ID": "7", "SLURM_JOB_END_TIME": str(int(time.time() + 660))}
        words = self.attempt(3, **job)[1][0].split()
        self.assertEqual(words[:3], ["-friction", "1", "-time_wall"])
        self.assertTrue(9 < float(words[3]) <= 10, words)
        self.assertEqual(self.attempt(3, **job)[1][0].split()[-2:], ["-restart", str(self.run_folder)])
        self.assertEqual(self.attempt(0, **{**job, "SLURM_JOB_END_TIME": str(int(time.time() + 70))}), (1, []))
        self.assertFalse(self.outcome.exists())
        self.assertEqual(self.attempt(0)[1], [f"-friction 1 -restart {self.run_folder}"])

    def test_time_that_is_left(self):
        for said, seconds in (("5:07", 307), ("1:00:00", 3600), ("2-03:00:01", 183601), ("0:59", 59)):
            self.assertEqual(going_on.seconds_of(said), seconds)


if __name__ == "__main__":
    unittest.main()
