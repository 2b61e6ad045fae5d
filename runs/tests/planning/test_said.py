"""What the answer says besides its numbers."""

import unittest
from types import SimpleNamespace

from slipscale.planning.said import otherwise, size_in_words
from slipscale.planning.wishes import wishes_of


class Said(unittest.TestCase):
    def test_other_morphologies_that_do_otherwise(self):
        def pilot(regime, frequency):
            return SimpleNamespace(regime=regime, frequency=frequency)

        of = {"size": [pilot("steady", 0), pilot("slip", 300e3)],
              "morphology": [pilot("slip", 310e3), pilot("slip", 900e3), pilot("steady", 300e3)]}
        planning = SimpleNamespace(cells=["grid"], wishes=wishes_of("friction:1%"), of=lambda cell, role="size": of[role])
        self.assertEqual(otherwise(planning), of["morphology"][1:])
        planning.wishes = wishes_of("trajectory_velocity:1%")
        self.assertEqual(otherwise(planning), [])

    def test_sizes_in_words(self):
        self.assertEqual([size_in_words(number, "B") for number in (12, 1234, 3.16e6, 2e9)],
                         ["12 B", "1.23 kB", "3.16 MB", "2 GB"])


if __name__ == "__main__":
    unittest.main()
