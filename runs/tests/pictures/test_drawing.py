"""Units of length and colour scales."""

import unittest

import numpy as np

from slipscale.pictures.drawing import colours_for, length_unit


class LengthUnit(unittest.TestCase):
    def test_by_the_size_of_the_body(self):
        square = np.array([[0.0, 0], [1, 0], [1, 1], [0, 1]])
        for size, unit in ((5.0, "m"), (1.0, "m"), (5e-3, "mm"), (2e-6, "µm"), (1e-10, "nm")):
            self.assertEqual(length_unit(square * size)[1], unit)
        self.assertEqual(length_unit(square * 5e-3)[0], 1e3)


class Colours(unittest.TestCase):
    def test_zero_is_in_the_middle_where_both_signs_matter(self):
        name, low, high = colours_for(np.linspace(-3, 1, 1001))
        self.assertEqual(name, "RdBu_r")
        self.assertEqual(low, -high)
        self.assertAlmostEqual(high, 2.96, delta=1e-12)  # 1 % lie outside

    def test_one_sign_is_shown_from_end_to_end(self):
        name, low, high = colours_for(np.linspace(-30, 1, 1001), cut=10)
        self.assertEqual(name, "cividis")
        np.testing.assert_allclose((low, high), (-26.9, -2.1), rtol=1e-12)

    def test_homogeneous_field_has_a_scale(self):
        _, low, high = colours_for(np.full(9, -15.0))
        self.assertLess(low, -15)
        self.assertGreater(high, -15)


if __name__ == "__main__":
    unittest.main()
