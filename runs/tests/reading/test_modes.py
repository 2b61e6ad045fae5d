"""What `modes` left in a made-up folder."""

import tempfile
import unittest
from pathlib import Path

import numpy as np

from slipscale.reading import UnreadableRun
from slipscale.reading.modes import Modes
from tests import fake_modes

SWEEP = """sweeps:
  coefficient:
    values: [0.2, 0.4]
    becomes_unstable:
      - value: 0.3
        frequency: 400000
        path: 1
        beyond: grows
    paths:
      - growth_rate: [-1e4, 1e4]
        frequency: [4e5, 4.1e5]
      - growth_rate: [.nan, -2e4]
        frequency: [.nan, 5e5]
"""


class ReadModes(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)

    def test_modes_and_shapes(self):
        fake_modes.write_modes(self.folder, scheme=True)
        modes = Modes(self.folder)
        self.assertEqual([(mode.frequency, mode.growth_rate) for mode in modes.modes], fake_modes.MODES)
        self.assertEqual(len(modes.growing), 2)
        self.assertAlmostEqual(modes.modes[0].p, 5.6e4 + 2j * np.pi * 372.6e3)
        self.assertAlmostEqual(modes.modes[0].scheme_p.real, 5.6056e4)
        self.assertEqual(modes.modes[0].friction_work, {"matrix": 0.1})
        self.assertEqual(modes.state["nodes_open"], 2)
        self.assertEqual(modes.sweeps, [])
        with modes.shapes as shapes:
            self.assertEqual(shapes.count, 3)
            shape = shapes.shape(1)
            self.assertEqual(shape.shape, (len(shapes.coordinates), 2))
            np.testing.assert_allclose(shape[:, 1], 0.5j * shape[:, 0])
            x, normal, tangential = shapes.tractions(2)
            self.assertEqual(len(x), fake_modes.NODES)
            np.testing.assert_allclose(tangential, (0.4 - 0.2j) * normal)

    def test_a_sweep(self):
        fake_modes.write_modes(self.folder, more=SWEEP)
        (sweep,) = Modes(self.folder).sweeps
        self.assertEqual((sweep.name, list(sweep.values), sweep.limits), ("coefficient", [0.2, 0.4], [(0.3, 4e5)]))
        np.testing.assert_equal(sweep.growth_rate, [[-1e4, 1e4], [np.nan, -2e4]])
        self.assertEqual(sweep.frequency[0, 1], 4.1e5)

    def test_what_is_missing_is_said(self):
        with self.assertRaisesRegex(UnreadableRun, "no modes.yaml in .*: give the output folder of a `modes` run"):
            Modes(self.folder)
        (self.folder / "modes.yaml").write_text("state: {nodes_open: 1}\n")
        with self.assertRaisesRegex(UnreadableRun, "lacks modes or the state"):
            Modes(self.folder)


if __name__ == "__main__":
    unittest.main()
