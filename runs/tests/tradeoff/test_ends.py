"""What a knob changes from one end to the other, told from rows of the table."""

import unittest

from tradeoff.ends import changes, ends_of

ROW = {"case": "plain", "knob": "steps", "frequency": 1e5, "friction": 0.4, "stick": 1e-3, "open": 0.2, "displacement": 1e-6,
       "frequency_scatter": 50, "friction_scatter": 4e-3, "open_scatter": 0.0, "seconds": 2.0, "model": "whole"}


class Ends(unittest.TestCase):
    def test_largest_change_and_what_is_more_than_scatter(self):
        other = {**ROW, "safety": 0.2}
        row = {**ROW, "safety": 0.9, "frequency": 1.01e5, "friction": 0.396, "displacement": 1.02e-6, "stick": 2e-3, "seconds": 1.0}
        (end,) = ends_of([other, row])
        self.assertEqual((end["from"], end["to"]), (0.2, 0.9))
        self.assertAlmostEqual(end["frequency"], 0.01)
        self.assertAlmostEqual(end["bulk"], 0.02)
        self.assertEqual(end["beyond"], "frequency +1")  # friction's -1 % is within its scatter
        self.assertAlmostEqual(end["seconds"], 0.5)
        # A part that hardly any node has is none, whatever it is multiplied by.
        self.assertNotIn("stick", [name for _, name, _, _ in changes(row, other, ("stick", "open"))])

    def test_only_moduli_are_compared_of_the_models(self):
        rows = [{**ROW, "knob": "models", "model": model, "open": of} for model, of in
                (("whole", 0.2), ("homogeneous-kubc", 0.3), ("homogeneous-subc", 0.33), ("strip-1", 0.4))]
        (end,) = ends_of(rows)
        self.assertEqual((end["to"], end["most"]), ("homogeneous-subc", "open"))
        self.assertAlmostEqual(end["change"], 0.1)


if __name__ == "__main__":
    unittest.main()
