"""Options as words of a command line."""

import unittest

from analysis.commands import words


class Words(unittest.TestCase):
    def test_values_as_the_programs_read_them(self):
        self.assertEqual(words({"time_end": 4e-4, "history_points": [2.5e-3, 0], "cell_estimate_error": False}),
                         "-time_end 0.0004 -history_points 0.0025,0 -cell_estimate_error false")

    def test_nested_options_are_joined_as_in_a_scene(self):
        self.assertEqual(words({"material": {"matrix": {"young": 30e9, "poisson": 0.25}}, "boundary": {}}),
                         "-material_matrix_young 30000000000.0 -material_matrix_poisson 0.25")


if __name__ == "__main__":
    unittest.main()
