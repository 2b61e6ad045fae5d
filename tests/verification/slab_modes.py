"""Modes of a slab that slides, from the determinant of its boundary conditions: another derivation than that of
slab_determinant.hpp (NumPy, unscaled potentials), for any anisotropy of the plane."""

import numpy as np


class Slab:
    """0 < y < H, top held, bottom sliding along +x. `stiffness` [3, 3] Pa, Voigt (xx, yy, xy); density kg/m³; k 1/m; b s."""

    def __init__(self, stiffness, density=1.0, height=2.0, wave_number=1.0, friction=0.5, time=0.2, damping=0.0):
        self.c, self.rho, self.height, self.k = np.array(stiffness, float), density, height, wave_number
        self.mu, self.time, self.b = friction, time, damping

    def determinant(self, p):
        """Zero where exp(ikx + pt) is a mode. With u = d exp(kηy): four η from Christoffel's equation with the inertia
        ρ p²/(1 + bp); u = 0 at the top, u_y = 0 and σ_xy = μ/(1 + pT) σ_yy at the bottom."""
        (c11, c12, c16), (_, c22, c26), (_, _, c66) = self.c
        inertia = self.rho * p**2 / (1 + self.b * p) / self.k**2
        xx = np.array([c66, 2j * c16, -c11 - inertia])
        xy = np.array([c26, 1j * (c12 + c66), -c16])
        yy = np.array([c22, 2j * c26, -c66 - inertia])
        eta = np.roots(np.polysub(np.polymul(xx, yy), np.polymul(xy, xy)))
        d = np.array([np.polyval(xy, eta), -np.polyval(xx, eta)])
        strain = np.array([1j * d[0], eta * d[1], eta * d[0] + 1j * d[1]])
        stress = self.c @ strain
        at_top = np.exp(eta * self.k * self.height)
        matrix = np.array([d[0] * at_top, d[1] * at_top, d[1], stress[2] - self.mu / (1 + p * self.time) * stress[1]])
        apart = np.prod([eta[i] - eta[j] for i in range(4) for j in range(i)])
        return np.linalg.det(matrix) / apart  # the same for any order of the four

    def mode(self, start):
        """The exponent p near `start`, by secants."""
        one, two = complex(start), complex(start) * (1 + 1e-4)
        f = self.determinant(one)
        for _ in range(60):
            g = self.determinant(two)
            step = g * (two - one) / (g - f)
            one, two, f = two, two - step, g
            if abs(step) < 1e-13 * abs(two):
                return two
        raise RuntimeError(f"no mode near {start}")


def isotropic(poisson, shear=1.0):
    lame = 2 * shear * poisson / (1 - 2 * poisson)
    return [[lame + 2 * shear, lame, 0], [lame, lame + 2 * shear, 0], [0, 0, shear]]


def turned(c, angle):
    """A stiffness [3, 3] in axes turned by an angle."""
    a, b = np.cos(angle), np.sin(angle)
    bond = np.array([[a * a, b * b, -2 * a * b], [b * b, a * a, 2 * a * b], [a * b, -a * b, a * a - b * b]])
    return bond @ np.array(c, float) @ bond.T
