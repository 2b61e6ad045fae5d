"""The model of scale.py: what it reads, what a step costs by hand, and what it says."""

import contextlib
import io
import tempfile
import unittest
from pathlib import Path

import scale

STEP = """100 nodes, 81 cells, 3 repetitions, base; 100.0 % of the nodes gathered, 37.0 % repeat; 238 bytes a node
  MATBAIJ product             9.00 ns per node (least   8.00)   1.000 x MATBAIJ
  step                       21.00 ns per node (least  20.00)   2.390 x MATBAIJ
  step, pairs                31.00 ns per node (least  30.00)   2.420 x MATBAIJ
10000 nodes, 9801 cells, 3 repetitions, base; 100.0 % of the nodes gathered, 99.0 % repeat; 1 bytes a node
  step                        5.00 ns per node (least   4.00)   0.500 x MATBAIJ
  step, pairs                11.00 ns per node (least  10.00)   1.000 x MATBAIJ
"""
HEADER = "nodes,way,parts,owned,border,ghosts,needed,sent,senders,mean_ghosts,stretch,seconds\n"


def lines(nodes, parts, length):
    """Squares that lie in a grid: the same for all ways."""
    return "".join(f"{nodes},{way},{parts},{nodes // parts},{4 * length},{6 * length},{4 * length},{6 * length},8,0,0,0\n"
                   for way in ("metis", "strips", "rectangles"))


def machine(**more):
    return scale.Machine(*scale.read_rates(STEP), **{**dict(latency=2e-6, overhead=0.5e-6, bandwidth=1e9, memory=None,
                                                            cache=2e6, moved=100), **more})


class Scale(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        (self.folder / "step.txt").write_text(STEP)
        (self.folder / "parts.csv").write_text(HEADER + lines(160000, 16, 100) + lines(160000, 4096, 6)
                                               + lines(16000000, 16, 1000).replace("metis", "other"))

    def test_rates(self):
        at = machine()
        for nodes, nanoseconds in ((100, 20), (10000, 4), (1000, 12), (10, 200), (1e6, 4)):
            self.assertAlmostEqual(at.rate(nodes, at.repeat), 1e-9 * nanoseconds, delta=1e-15)
        shared = machine(memory=5e9)
        self.assertAlmostEqual(shared.rate(1e6, shared.repeat), 20e-9)  # 100 B at 5 GB/s
        self.assertAlmostEqual(shared.rate(10000, shared.repeat), 4e-9)  # in the cache

    def test_a_step_by_hand(self):
        cut = scale.read_cuts([self.folder / "parts.csv"])[0]
        step = scale.step_of(cut, machine())
        self.assertAlmostEqual(step.inner, 9600 * 4e-9)
        self.assertAlmostEqual(step.border, 400 * 10e-9)
        self.assertAlmostEqual(step.exchange(), 16 * 0.5e-6 + 2e-6 + 600 * 16e-9)
        self.assertAlmostEqual(step.hidden(), 9600 * 4e-9 + 400 * 10e-9 + 8e-6)
        self.assertAlmostEqual(scale.efficiency(cut, machine(), step.total()), 160000 * 4e-9 / (16 * step.total()))

    def test_what_metis_would_do_to_a_larger_grid(self):
        cuts = scale.completed(scale.read_cuts([self.folder / "parts.csv"]))
        cut = next(cut for cut in cuts if cut.scaled and cut.parts == 16)
        self.assertEqual((cut.nodes, cut.owned, cut.ghosts, cut.senders), (16e6, 1e6, 6000, 8))

    def test_text_and_picture(self):
        out = io.StringIO()
        with contextlib.redirect_stdout(out):
            scale.main(["--step", str(self.folder / "step.txt"), "--parts", str(self.folder / "parts.csv"),
                        "--picture", str(self.folder / "picture.png")])
        self.assertIn("| 0.16 M | 16 | 10000 | 1.00 / 1.00 / 1.00 | 8 / 8 / 8 | 600 / 600 / 600 |", out.getvalue())
        self.assertGreater((self.folder / "picture.png").stat().st_size, 10000)


if __name__ == "__main__":
    unittest.main()
