"""Pairs of modes by the likeness of their shapes."""

import tempfile
import unittest
from pathlib import Path

import numpy as np

from slipscale.measuring.pairing import likeness, matched, pairs_of
from slipscale.reading.modes import Modes
from tests import fake_modes


class Pairing(unittest.TestCase):
    def test_likeness_knows_neither_phase_nor_size(self):
        one = np.array([[1, 2j, 0], [0, 0, 1]], complex)
        found = likeness(one, np.array([3j * one[0], [1, -2j, 0]]))
        np.testing.assert_allclose(found, [[1, 9 / 25], [0, 0]], atol=1e-15)

    def test_best_pairs_first_and_none_below_the_least(self):
        self.assertEqual(matched(np.array([[0.9, 0.8], [0.95, 0.2], [0.3, 0.7]])), {1: 0, 0: 1})
        self.assertEqual(matched(np.array([[0.4]])), {})
        self.assertEqual(matched(np.zeros((0, 3))), {})

    def test_modes_in_another_order_find_their_partners(self):
        with tempfile.TemporaryDirectory() as folder:
            one, other = Path(folder) / "one", Path(folder) / "other"
            fake_modes.write_modes(one)
            fake_modes.write_modes(other, [(400e3, 1e4)] * 2, shift=0.1)
            pairs = pairs_of(Modes(one), Modes(other))
        self.assertEqual(len(pairs), 3)
        self.assertEqual([pair.other is None for pair in pairs], [False, False, True])
        self.assertTrue(all(pair.likeness > 0.9 for pair in pairs[:2]))
        self.assertLess(pairs[2].likeness, 0.3)


if __name__ == "__main__":
    unittest.main()
