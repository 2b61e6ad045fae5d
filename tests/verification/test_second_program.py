"""second_program.py has the digits that the C++ tests compare slipscale with; the finer meshes by hand: README.md."""

import unittest

from second_program import cycle, readings, scene_r, strip


class SecondProgram(unittest.TestCase):
    def test_scene_r_before_saturation(self):
        """scene_r.cpp."""
        found = readings(scene_r(0.25e-3), (10e-6, 30e-6))
        self.assert_digits(found[10e-6], (3.716186611e-7, 0.06998790387, 4476.373474, 10365.76611), 1e-9)
        self.assert_digits(found[30e-6], (2.461864355e-6, 0.09284393237, 29911.02442, 60767.82014), 1e-9)
        self.assert_digits(readings(scene_r(0.125e-3), [30e-6])[30e-6][:1], (2.467210660e-6,), 1e-9)

    def test_limit_cycle(self):
        """limit_cycle.cpp, on the coarsest mesh."""
        friction, frequency, velocity, stick, separated = cycle(scene_r(0.25e-3))
        self.assert_digits((friction, velocity), (0.4340, 1.239), 5e-4)
        self.assertAlmostEqual(frequency, 380.8e3, delta=0.3e3)
        self.assertAlmostEqual(stick, 0.125, delta=6e-4)
        self.assertAlmostEqual(separated, 0.264, delta=6e-4)

    def test_sustained_instability(self):
        """sustained.cpp, on the coarsest mesh."""
        for regime, expected in (("S1", (0.4444, 1.1234, 0.2280, 0.541)),
                                 ("S2", (0.4277, 1.0992, 0.6742, 0.520, 0.125))):
            for found, value in zip(strip(regime, 32), expected):
                self.assertAlmostEqual(found, value, delta=6e-4, msg=regime)

    def assert_digits(self, found, expected, relative):
        for value, digits in zip(found, expected, strict=True):
            self.assertAlmostEqual(value / digits, 1, delta=relative, msg=f"{value} {digits}")


if __name__ == "__main__":
    unittest.main()
