"""What the proposed run will take, from two short ones."""

import tempfile
import unittest
from pathlib import Path
from types import SimpleNamespace
from unittest import mock

from slipscale.planning import answer

START, STEP = 0.1, 3e-5  # s


def short_run(planning, options, steps, storage, folder):
    """One whose step is longer than expected, so that it takes fewer of them."""
    folder.mkdir(parents=True)
    taken = int(0.73 * steps)
    (folder / "summary.yaml").write_text(f"steps: {taken}\n")
    return {"status": "ok", "cpu_seconds": START + STEP * taken}


class Seconds(unittest.TestCase):
    def test_of_a_step_by_the_steps_that_were_taken(self):
        with tempfile.TemporaryDirectory() as name, mock.patch.object(answer, "tried", short_run):
            start, slope, outcome, folder = answer.per_step(SimpleNamespace(out=Path(name)), {}, 1000, "double")
        self.assertAlmostEqual(start, START, delta=1e-9)
        self.assertAlmostEqual(slope / STEP, 1, delta=1e-9)
        self.assertEqual(folder.name, "double-4000")


if __name__ == "__main__":
    unittest.main()
