"""Options as words of a command line."""

import shlex
import unittest

from slipscale.running.commands import flat, settings, words


class Words(unittest.TestCase):
    def test_values_as_the_programs_read_them(self):
        self.assertEqual(words({"time_end": 4e-4, "history_points": [2.5e-3, 0], "cell_estimate_error": False}),
                         "-time_end 0.0004 -history_points 0.0025,0 -cell_estimate_error false")

    def test_nested_options_are_joined_as_in_a_scene(self):
        self.assertEqual(words({"material": {"matrix": {"young": 30e9, "poisson": 0.25}}, "boundary": {}}),
                         "-material_matrix_young 30000000000.0 -material_matrix_poisson 0.25")

    def test_flat(self):
        self.assertEqual(flat({"a": {"b": {"c": 1}, "d": [1, 2]}, "e": {}, "f": None}),
                         {"a_b_c": 1, "a_d": [1, 2], "f": None})

    def test_a_shell_reads_what_was_meant(self):
        options = {"output_folder": "my runs/$1", "image_levels": [0.5, 0.7]}
        self.assertEqual(shlex.split(words(options)),
                         ["-output_folder", "my runs/$1", "-image_levels", "0.5,0.7"])
        self.assertEqual(shlex.split(settings(options)), ["output_folder=my runs/$1", "image_levels=0.5,0.7"])
        self.assertEqual(settings({"mu": 0.5, "seed": 1}), "mu=0.5 seed=1")


if __name__ == "__main__":
    unittest.main()
