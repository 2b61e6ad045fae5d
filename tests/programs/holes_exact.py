"""Effective stiffness of a square array of circular holes in plane strain, without finite elements."""

import numpy as np


class SquareArrayOfHoles:
    """Collocation with Kolosov's and Muskhelishvili's potentials (Muskhelishvili, Some Basic Problems of the
    Mathematical Theory of Elasticity, Noordhoff 1953, secs. 32 and 41):

        2 G (u + iv) = k phi - z conj(phi') - conj(psi),   k = 3 - 4 nu,
        s_xx + s_yy = 4 Re phi',   s_yy - s_xx + 2i s_xy = 2 (conj(z) phi'' + psi').

    phi is a Laurent series in odd powers of z, and psi follows from it so that the edge |z| = a of the hole is free
    exactly: psi = -conj(phi)(a^2/z) - (a^2/z) phi'. The coefficients are those that fit the conditions of the cell's
    symmetry on its sides best; the error falls with each order.
    """

    def __init__(self, fraction, young, poisson, order=41, points=400):
        self.a = np.sqrt(fraction / np.pi)  # the cell is 1 m wide
        self.shear, self.kappa = young / (2 * (1 + poisson)), 3 - 4 * poisson
        nodes, self.weights = np.polynomial.legendre.leggauss(points)
        along = 0.25 * (1 + nodes)
        self.weights = 0.25 * self.weights
        self.right, self.top = 0.5 + 1j * along, along + 0.5j
        self.powers = np.arange(-order, order + 1, 2)

    def fields(self, z, factor):
        """u, v and s_xx, s_yy, s_xy [points, coefficients] of each coefficient, real times `factor`."""
        a, n = self.a, self.powers
        z = z[:, None]
        scale = np.where(n > 0, 0.75 ** (-1.0 * n), (0.75 / a ** 2) ** (1.0 * n))  # of phi or psi, whichever is larger
        c = factor * scale
        phi, d, dd = c * z ** n, c * n * z ** (n - 1), c * n * (n - 1) * z ** (n - 2)
        conjugate = np.conj(c)
        psi = -conjugate * (a * a / z) ** n - a * a / z * d
        d_psi = conjugate * n * (a * a / z) ** n / z + a * a / z ** 2 * d - a * a / z * dd
        w = (self.kappa * phi - z * np.conj(d) - np.conj(psi)) / (2 * self.shear)
        total, other = 4 * d.real, 2 * (np.conj(z) * dd + d_psi)
        return w.real, w.imag, (total - other.real) / 2, (total + other.real) / 2, other.imag / 2

    def solve(self, rows, values):
        """Least squares; displacements and stresses get one size."""
        size = [1 if unit == "m" else 1 / self.shear for unit, _ in rows]
        matrix = np.concatenate([s * row for s, (_, row) in zip(size, rows)])
        right = np.concatenate([s * np.full(len(row), value) for s, (_, row), value in zip(size, rows, values)])
        return np.linalg.lstsq(matrix, right, rcond=None)[0]

    def stiffness(self):
        """C11, C12, C66, Pa."""
        u, _, s_xx, _, s_xy = self.fields(self.right, 1)
        _, v, _, s_yy, s_yx = self.fields(self.top, 1)
        found = self.solve([("m", u), ("Pa", s_xy), ("m", v), ("Pa", s_yx)], [0.5, 0, 0, 0])
        c11, c12 = 2 * self.weights @ (s_xx @ found), 2 * self.weights @ (s_yy @ found)
        _, v, s_xx, _, s_xy = self.fields(self.right, 1j)
        u, _, _, s_yy, _ = self.fields(self.top, 1j)
        found = self.solve([("m", v), ("Pa", s_xx), ("m", u), ("Pa", s_yy)], [0.25, 0, 0.25, 0])
        return np.array([c11, c12, 2 * self.weights @ (s_xy @ found)])


if __name__ == "__main__":
    for fraction in (1e-4, 0.2, 0.4):
        print(fraction, *(SquareArrayOfHoles(fraction, 1, 0.3, order).stiffness() for order in (21, 31, 41, 51)))
