"""Tractions along interfaces compared: errors, times and what debonds, of made-up files."""

import tempfile
import unittest
from pathlib import Path

import h5py
import numpy as np

from relocalisation.comparison import row
from relocalisation.interfaces import Interfaces, compare_interfaces, same_times
from slipscale.reading import UnreadableRun

TIMES = np.array([0, 1e-6, 2e-6, 3e-6])


def write(path, order, times, tractions, variants=("",)):
    """Two inclusions of four nodes each, in another order; `tractions` [n, 8] normal, shear half of it; index (t/2)²."""
    angle = np.tile(np.arange(4) * np.pi / 2, 2)
    centre = np.repeat([[1e-3, 1e-3], [3e-3, 2e-3]], 4, axis=0)
    path.mkdir(parents=True, exist_ok=True)
    with h5py.File(path / "interfaces.h5", "w") as file:
        file["time"] = times
        file["x"], file["y"] = (centre + 5e-4 * np.column_stack([np.cos(angle), np.sin(angle)]))[order].T
        file["length"], file["outer"] = np.full(8, 1e-4), np.zeros(8)
        file["inclusion"] = np.repeat([0.0, 1.0], 4)[order]
        for variant, factor in zip(variants, (1, 0.5), strict=False):
            at = variant and variant + "/"
            values = factor * tractions[:, order]
            file[f"{at}normal_traction"], file[f"{at}shear_traction"], file[f"{at}index"] = values, values / 2, (values / 2)**2


class Compared(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        self.true = np.outer([0, 1, 2, 3], np.r_[np.ones(4), 0.5 * np.ones(4)])
        write(self.folder / "slide", np.arange(8), TIMES, self.true)
        write(self.folder / "relocalize", np.array([3, 2, 1, 0, 7, 6, 5, 4]), TIMES[1:], 1.1 * self.true[1:],
              ("", "homogeneous"))

    def compared(self):
        rows = compare_interfaces(self.folder / "relocalize", self.folder / "slide", 1.2e-3, 0.4e-3, row)
        return {(each["measure"], each["part"], each["component"]): each for each in rows}

    def test_errors_are_those_of_the_same_nodes_and_times(self):
        found = self.compared()
        for component in ("normal", "shear"):
            for part in ("all", "layer", "bulk"):
                each = found["interface_error", part, component]
                self.assertAlmostEqual(each["relocalised"], 0.1, delta=1e-12)
                self.assertAlmostEqual(each["homogeneous"], 0.45, delta=1e-12)

    def test_the_first_inclusion_and_what_debonds(self):
        """Index (t/2)²: the reference reaches 1 at t = 2 in the first inclusion alone, 1.1 times it at the same time; half
        of that only at the end."""
        found = self.compared()
        first = found["first_inclusion", "all", "index"]
        self.assertEqual((first["reference"], first["relocalised"], first["homogeneous"]), (0, 0, None))
        self.assertEqual(found["first_time", "all", "index"]["reference"], 2e-6)
        self.assertEqual(found["debonded", "all", "index"]["reference"], 1)
        self.assertEqual(found["same_inclusion", "all", "index"]["relocalised"], 1)
        self.assertAlmostEqual(found["interface_index", "all", "index"]["relocalised"], (3.3 / 2)**2, delta=1e-12)

    def test_interfaces_that_differ_are_refused(self):
        write(self.folder / "slide", np.arange(7), TIMES, self.true)
        with self.assertRaisesRegex(UnreadableRun, "different nodes"):
            self.compared()

    def test_times(self):
        self.assertEqual(same_times(np.array([1.0, 2.0]), np.array([0, 1.01, 1.99, 3])), [(0, 1), (1, 2)])
        self.assertEqual(same_times(np.arange(0, 1, 0.1), np.array([0.0, 0.5])), [(0, 0), (5, 1)])

    def test_reading(self):
        found = Interfaces(self.folder / "relocalize", "homogeneous", "relocalize")
        self.assertEqual((found.normal.shape, found.inner.sum()), ((3, 8), 8))


if __name__ == "__main__":
    unittest.main()
