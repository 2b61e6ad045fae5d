"""bench_step on a small mesh: it runs to its end, and every figure it prints is one. What crashes after its last line
has not passed."""

import os
import re
import subprocess
import unittest

FIGURE = re.compile(r"^  (\S.*?) +([\d.]+) ns per node \(least +([\d.]+)\) +([\d.]+) x MATBAIJ$", re.M)


def figures(*command):
    """{variant: (median, least) in ns per node, ratio to MATBAIJ} of a command; AssertionError when it fails."""
    done = subprocess.run(command, capture_output=True, text=True, timeout=100)
    assert done.returncode == 0, f"exit code {done.returncode}\n{done.stdout}{done.stderr}"
    return {name: tuple(map(float, values)) for name, *values in FIGURE.findall(done.stdout)}


class Step(unittest.TestCase):
    def test_figures(self):
        for shape in ("general", "quadrilaterals"):
            found = figures(os.environ["BENCH_STEP"], "-nodes", "1000", "-repetitions", "3", "-shape", shape)
            self.assertEqual(len(found), 10, found)
            self.assertEqual(found["MATBAIJ product"][2], 1)
            for name, (median, least, ratio) in found.items():
                self.assertTrue(0 < least <= median and ratio > 0, name)

    def test_a_crash_at_the_end_is_seen(self):
        line = "  step    1.00 ns per node (least   1.00)   0.900 x MATBAIJ"
        self.assertEqual(figures("bash", "-c", f"echo '{line}'"), {"step": (1, 1, 0.9)})
        for end in ("exit 1", "kill -SEGV $$"):
            with self.assertRaisesRegex(AssertionError, "exit code"):
                figures("bash", "-c", f"echo '{line}'; {end}")


if __name__ == "__main__":
    unittest.main()
