"""disc_arrays.py: its solution meets what is known exactly; its digits are those that the C++ tests compare with."""

import unittest
from pathlib import Path

import disc_arrays as arrays
from disc_arrays import HEXAGONAL, SQUARE, Solid

HERE = Path(__file__).parent


def of_moduli(bulk, shear):
    """From plane bulk modulus and shear modulus."""
    poisson = (bulk - shear) / (2 * bulk)
    return Solid(2 * shear * (1 + poisson), poisson)


class DiscArrays(unittest.TestCase):
    def test_hills_moduli(self):
        """R. Hill, J. Mech. Phys. Solids 12 (1964) 199: equal shear moduli, 1/(k + G) = Σ f/(k_i + G)."""
        expected = 1 / (0.7 / 30 + 0.3 / 110) - 10
        for periods in (SQUARE, HEXAGONAL):
            c11, c12, c66 = arrays.moduli(periods, 0.3, of_moduli(20, 10), of_moduli(100, 10), terms=20)
            self.assertAlmostEqual((c11 + c12) / 2, expected, delta=1e-8)
            self.assertAlmostEqual((c11 - c12) / 2, 10, delta=1e-8)
            self.assertAlmostEqual(c66, 10, delta=1e-8)

    def test_a_hexagonal_array_is_isotropic(self):
        c11, c12, c66 = arrays.moduli(HEXAGONAL, 0.4, Solid(30), Solid(80), terms=30)
        self.assertAlmostEqual((c11 - c12) / 2, c66, delta=1e-9)
        self.assert_listed("cells_arrays.cpp", (c11 + c12) / 2, c66)

    def test_moduli_of_square_arrays(self):
        for fraction, young in ((0.2, (30, 80)), (0.4, (30, 80)), (0.4, (1, 10))):
            self.assert_listed("cells_arrays.cpp",
                               *arrays.moduli(SQUARE, fraction, *map(Solid, young), terms=30))

    def test_local_values(self):
        array = SQUARE, 0.4, Solid(30), Solid(80)
        stretched = arrays.solve(*array, (1, 0, 0), terms=30)
        strain, stress = stretched.strain_and_stress([0, stretched.radius])
        sheared = arrays.solve(*array, (0, 0, 2), terms=30).strain_and_stress([0])[1][0, 2]  # E_xy = 1 is γ = 2
        self.assert_listed("cells_local.cpp", *strain[0, :2], digits=8)
        for file in ("cells_local.cpp", "relocalisation_local.cpp"):
            self.assert_listed(file, *stress[0, :2], sheared, digits=6)
            self.assert_listed(file, stress[1, 0], digits=5)

    def assert_listed(self, file, *values, digits=9):
        text = (HERE / file).read_text()
        for value in values:
            self.assertIn(f"{abs(value):.{digits}f}".lstrip("0"), text)


if __name__ == "__main__":
    unittest.main()
