"""Exact fields of square and hexagonal arrays of discs in plane strain: where the moduli and local values come from
that `homogenize` and `relocalize` are held to.

    python3 tests/verification/disc_arrays.py

Method: complex potentials (N. I. Muskhelishvili, Some Basic Problems of the Mathematical Theory of Elasticity,
Noordhoff 1953, chapter 5), a Laurent series φ, ψ in the matrix and a power series in the disc of one Voronoi cell. They
meet all conditions at once in the sense of least squares, at points: displacement and traction continuous at the
interface, displacement E·d + periodic and traction periodic over opposite sides d apart. No mesh, no time, no code of
slipscale; the digits printed are the same with 30, 40 and 50 terms.
"""

from dataclasses import dataclass

import numpy as np

SQUARE = (1, 1j)
HEXAGONAL = (1, 0.5 + 0.5j * 3**0.5, -0.5 + 0.5j * 3**0.5)  # opposite sides of the Voronoi cell are these apart


@dataclass
class Solid:
    """E in any unit, Poisson's ratio; plane strain."""

    young: float
    poisson: float = 0.3

    @property
    def shear(self):
        return self.young / (2 * (1 + self.poisson))

    @property
    def kappa(self):
        return 3 - 4 * self.poisson


def potentials(z, powers, scale):
    """[potential, derivative, second derivative] of (z/scale)^n, each [points, powers]."""
    n, w = np.array(powers), np.asarray(z)[:, None] / scale
    # n(n − 1) is 0 where n − 2 would be a negative power of the centre
    return w**n, n * w ** (n - 1) / scale, n * (n - 1) * w ** np.where(n == 1, 0, n - 2) / scale**2


def rows(z, powers, scale, solid):
    """Displacement u + iv and resultant F (traction (t_x + i t_y) ds = -i dF, normal to the right) as real rows
    [2 points] over the real unknowns: real and imaginary parts of the coefficients of φ, then of ψ."""
    f, df, _ = potentials(z, powers, scale)
    z = np.asarray(z)[:, None]
    columns = []
    for unit in (1, 1j):  # φ = unit (z/scale)^n
        bent = z * np.conj(unit * df)
        columns.append(((solid.kappa * unit * f - bent) / (2 * solid.shear), unit * f + bent))
    for unit in (1, 1j):  # ψ
        columns.append((-np.conj(unit * f) / (2 * solid.shear), np.conj(unit * f)))
    u, force = (np.hstack([column[k] for column in columns]) for k in (0, 1))
    return np.vstack([u.real, u.imag]), np.vstack([force.real, force.imag])


@dataclass
class Field:
    """What one mean strain brings about in an array of distance 1."""

    mean_stress: np.ndarray  # xx, yy, xy
    inside: np.ndarray  # coefficients of φ, ψ in the disc
    powers: range
    radius: float
    disc: Solid

    def strain_and_stress(self, z):
        """(ε_xx, ε_yy, γ_xy), (σ_xx, σ_yy, σ_xy) at points z of the disc, counted from its centre; [points, 3] each."""
        z = np.asarray(z, complex)
        a, b = self.inside
        _, df, ddf = potentials(z, self.powers, self.radius)
        trace = 4 * (df @ a).real
        deviator = 2 * (np.conj(z) * (ddf @ a) + df @ b)
        stress = np.stack([(trace - deviator.real) / 2, (trace + deviator.real) / 2, deviator.imag / 2], 1)
        e, nu = self.disc.young / (1 - self.disc.poisson**2), self.disc.poisson / (1 - self.disc.poisson)
        strain = np.stack([(stress[:, 0] - nu * stress[:, 1]) / e, (stress[:, 1] - nu * stress[:, 0]) / e,
                           stress[:, 2] / self.disc.shear], 1)
        return strain, stress


def solve(periods, fraction, matrix, disc, strain, terms=40):
    """The array of discs under the mean strain (ε_xx, ε_yy, γ_xy). `terms`: odd powers of each sign (the fields are odd
    in z by symmetry)."""
    sides = len(periods)
    area, length = (1, 1) if sides == 2 else (3**0.5 / 2, 3**-0.5)  # of the cell, of a side
    radius, corner = np.sqrt(fraction * area / np.pi), 0.5 * np.hypot(1, length)
    outer, inner = range(1, 2 * terms, 2), range(-2 * terms + 1, 0, 2)
    stiff = matrix.shear

    circle = radius * np.exp(1j * np.pi * (np.arange(4 * terms) + 0.5) / (4 * terms))  # half of it: odd fields
    along = np.cos(np.pi * (np.arange(3 * terms) + 0.5) / (3 * terms)) * length / 2
    sides_at = [(-d / 2 + 1j * d * along, d) for d in periods]

    def in_matrix(z):
        high, low = rows(z, outer, corner, matrix), rows(z, inner, radius, matrix)
        return np.hstack([high[0], low[0]]), np.hstack([high[1], low[1]])

    u, force = in_matrix(circle)
    u_disc, force_disc = rows(circle, outer, radius, disc)
    matrix_unknowns, disc_unknowns = u.shape[1], u_disc.shape[1]
    pad = np.zeros((u.shape[0], 2 * sides))
    system = [np.hstack([stiff * u, -stiff * u_disc, pad]), np.hstack([force, -force_disc, pad])]
    right = [np.zeros(u.shape[0])] * 2
    exx, eyy, gamma = strain
    for k, (z, d) in enumerate(sides_at):
        (u0, f0), (u1, f1) = in_matrix(z), in_matrix(z + d)
        n = len(z)
        jump = complex(exx * d.real + gamma / 2 * d.imag, gamma / 2 * d.real + eyy * d.imag)
        blank = np.zeros((2 * n, disc_unknowns))
        step = np.zeros((2 * n, 2 * sides))  # the resultant over a side is not known beforehand
        step[:n, 2 * k], step[n:, 2 * k + 1] = -1, -1
        system += [np.hstack([stiff * (u1 - u0), blank, 0 * step]), np.hstack([f1 - f0, blank, step])]
        right += [stiff * np.repeat([jump.real, jump.imag], n), np.zeros(2 * n)]
    x, *_ = np.linalg.lstsq(np.vstack(system), np.concatenate(right), rcond=1e-15)

    # ⟨σ⟩ = Σ over pairs of sides of (force over the side at +d/2) ⊗ d / area
    stress = np.zeros((2, 2))
    for d in periods:
        ends = d / 2 + 1j * d * np.array([-1, 1]) * length / 2
        resultant = in_matrix(ends)[1] @ x[:matrix_unknowns]
        across = -1j * complex(resultant[1] - resultant[0], resultant[3] - resultant[2])
        stress += np.outer([across.real, across.imag], [d.real, d.imag]) / area
    inside = x[matrix_unknowns:matrix_unknowns + disc_unknowns].reshape(4, -1)
    return Field(np.array([stress[0, 0], stress[1, 1], (stress[0, 1] + stress[1, 0]) / 2]),
                 np.array([inside[0] + 1j * inside[1], inside[2] + 1j * inside[3]]), outer, radius, disc)


def moduli(periods, fraction, matrix, disc, terms=40):
    """C11, C12, C66 of the array; k = (C11 + C12)/2 and G = C66 where it is hexagonal."""
    along = solve(periods, fraction, matrix, disc, (1, 0, 0), terms).mean_stress
    sheared = solve(periods, fraction, matrix, disc, (0, 0, 1), terms).mean_stress
    return along[0], along[1], sheared[2]


def main():
    for periods, fraction, young in ((SQUARE, 0.2, (30, 80)), (SQUARE, 0.4, (30, 80)), (SQUARE, 0.4, (1, 10)),
                                     (HEXAGONAL, 0.4, (30, 80))):
        c11, c12, c66 = moduli(periods, fraction, *map(Solid, young))
        name = "square" if periods == SQUARE else "hexagonal"
        print(f"{name}, f {fraction:g}, {young[0]}/{young[1]} GPa: C11 {c11:.9f} C12 {c12:.9f} C66 {c66:.9f} GPa"
              f", k {(c11 + c12) / 2:.9f}, (C11 - C12)/2 {(c11 - c12) / 2:.9f}")
    array = SQUARE, 0.4, Solid(30), Solid(80)
    stretched, sheared = solve(*array, (1, 0, 0)), solve(*array, (0, 0, 2))
    strain, stress = stretched.strain_and_stress([0, stretched.radius])
    print("square, f 0.4, 30/80 GPa, E_xx = 1, centre: strain", *(f"{x:.8f}" for x in strain[0]),
          "stress", *(f"{x:.6f}" for x in stress[0]), "GPa")
    print(f"the same, interface at 0 degrees: stress xx {stress[1, 0]:.5f} GPa")
    print(f"E_xy = 1, centre: stress xy {sheared.strain_and_stress([0])[1][0, 2]:.6f} GPa")


if __name__ == "__main__":
    main()
