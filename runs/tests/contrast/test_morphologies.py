"""Pairs and groups of a made-up table, their spread, and the picture of them."""

import tempfile
import unittest
from pathlib import Path

import numpy as np

from contrast import scatter_picture
from contrast.morphologies import fold, groups_of, paired, rank_correlation, spread
from slipscale.running.table import write_csv


def row(young, diameter, seed, model, status="ok", size=0.125):
    return {"young": young, "diameter": diameter, "size": size, "seed": seed, "model": model, "status": status,
            "amplitude": 0.1 * seed, "frequency": 4e5, "friction": 0.44, "regime": "slip-separated"}


def both(*options, **more):
    return [row(*options, model, **more) for model in ("heterogeneous", "homogeneous")]


ROWS = [*both(300, 1.0, 1), *both(300, 1.0, 2), *both(80, 1.0, 1), *both(300, 2.0, 1), *both(300, 1.0, 1, size=0.0625),
        row(80, 1.0, 2, "heterogeneous"), row(80, 1.0, 2, "homogeneous", status="failed")]


class Morphologies(unittest.TestCase):
    def test_only_whole_pairs_count(self):
        self.assertEqual(len(paired(ROWS)), 5)

    def test_groups_on_the_usual_mesh_from_large_to_small(self):
        groups = groups_of(paired(ROWS))
        self.assertEqual(list(groups), [(2.0, 300), (1.0, 80), (1.0, 300)])
        self.assertEqual([(own["seed"], own["size"]) for own, _ in groups[1.0, 300]], [(1, 0.125), (2, 0.125)])

    def test_spread(self):
        self.assertAlmostEqual(spread([1.0, 2.0, 3.0]), 0.5)
        self.assertEqual(spread([4.0]), 0)
        self.assertEqual(fold([2.0, 8.0, 4.0]), 4)

    def test_rank_correlation(self):
        self.assertAlmostEqual(rank_correlation([1, 2, 3, 4], [1, 8, 27, 64]), 1)
        self.assertAlmostEqual(rank_correlation([1, 2, 3], [3, 2, 1]), -1)
        self.assertAlmostEqual(rank_correlation([1, 2, 3, 4, 5], [2, 1, 4, 3, 5]), 0.8)  # 1 - 6·4/(5·24)
        self.assertTrue(np.isnan(rank_correlation([1, 2], [1, 2])))

    def test_the_picture(self):
        with tempfile.TemporaryDirectory() as folder:
            write_csv(Path(folder) / "table.csv", ROWS)
            picture = Path(folder) / "scatter.png"
            self.assertEqual(scatter_picture.main([str(Path(folder) / "table.csv"), str(picture)]), 0)
            self.assertGreater(picture.stat().st_size, 20000)


if __name__ == "__main__":
    unittest.main()
