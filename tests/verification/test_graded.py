"""Graded bodies, exactly: a column under pressure and one that vibrates, with constants that vary along it.

nu = 0, so that nothing happens along x. Under a pressure p the top of a column of C22 = E0 (1 + s), s = y/H, sinks by
p H ln 2/E0. A column of C22 = E0 (1 + s)^2 and uniform density, held at both ends, vibrates as u = (1 + s)^(-1/2) sin(k ln(1 + s))
with k ln 2 = pi, at the frequency (c0/H) sqrt(k^2 + 1/4), c0^2 = E0/rho, which solves (E u')' + rho w^2 u = 0. A graded density shows in
what a body that falls gains: its mass is the integral of rho.
"""

import sys
import unittest
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "programs"))
from finding import report  # noqa: E402
from running import InScratch, datasets  # noqa: E402
from scenes import SIDE, block  # noqa: E402

E0, RHO, P = 40e9, 2000.0, 1e6
BODY = {"mesh_file": "block.msh", "material_block_poisson": 0, "material_block_density": RHO, "boundary_bottom_y": "fixed",
        "history_points": f"{SIDE / 2},{SIDE},{SIDE / 2},{SIDE / 2}", "checkpoint_minutes": 0}
CROSSING = SIDE / np.sqrt(E0 / RHO)
MEASURED = (8, 16, 32)


class Graded(InScratch):
    def ended(self, divisions, **scene):
        block(self.folder / "block.msh", divisions=divisions)
        self.run_scene({**BODY, **scene, "output_folder": "out"}, ranks=2)
        return datasets(self.folder / "out" / "history.h5")

    def order_of(self, errors):
        orders = np.log2(np.abs(errors[:-1]) / np.abs(errors[1:]))
        self.assertGreater(orders.min(), 1.9, errors)
        return orders[-1]

    def test_a_column_under_pressure(self):
        exact = -P * SIDE / E0 * np.log(2)
        errors = []
        for n in MEASURED:
            seen = self.ended(n, material_block_young=f"{E0}*(1 + y/H)", boundary_top_pressure=P, damping_mass=1.5 / CROSSING,
                              time_end=60 * CROSSING, history_every=100)
            errors.append(seen["points/0/u"][-1, 1] / exact - 1)
            np.testing.assert_allclose(seen["points/0/stress"][-1], [0, -P, 0], rtol=0, atol=1e-9 * P)
        self.assertLess(abs(errors[-1]), 1e-4)
        report("Graded column, C22 = E0 (1 + y/H), 32 elements, under pressure", "sinking of the top over p H ln 2/E0", "1 +- 1e-4",
               f"{1 + errors[-1]:.6f}", "exact solution", f"{self.order_of(np.array(errors)):.2f}")

    def test_a_column_that_vibrates(self):
        k = np.pi / np.log(2)
        omega = np.sqrt(E0 / RHO) / SIDE * np.sqrt(k**2 + 0.25)
        shape = "sin(pi*log2(1 + y/H))/sqrt(1 + y/H)"
        middle = np.sin(k * np.log(1.5)) / np.sqrt(1.5)
        end = 9 * np.pi / 2 / omega  # through zero, where the phase shows most
        errors = []
        for n in MEASURED:
            step = end / (24 * n)
            seen = self.ended(n, material_block_young=f"{E0}*(1 + y/H)^2", boundary_top_y="fixed", history_every=1,
                              initial_displacement=f"0, 1e-8*{shape}", time_step=step, time_end=end)
            self.assertLess(np.abs(seen["energy/residual"] / seen["energy/flowed"])[1:].max(), 1e-10)
            errors.append(-seen["points/1/u"][-1, 1] / (1e-8 * middle) / (4.5 * np.pi))
        self.assertLess(abs(errors[-1]), 1e-3)
        report("Graded column, C22 = E0 (1 + y/H)^2, 32 elements, held at both ends", "first frequency over the exact one", "1 +- 1e-3",
               f"{1 + errors[-1]:.6f}", "exact solution", f"{self.order_of(np.array(errors)):.2f}")

    def test_a_graded_density(self):
        """Of mass rho H^2 ∫ (1 + s^2) dA: what falls freely gains that times g t."""
        errors = []
        for n in MEASURED:
            seen = self.ended(n, material_block_young=E0, material_block_density=f"{RHO}*(1 + y^2/H^2)", boundary_bottom_y=None,
                              body_acceleration="0,-10", history_momentum="true", time_end=CROSSING, history_every=1)
            errors.append(seen["momentum/linear"][-1, 1] / (-10 * seen["time"][-1] * RHO * SIDE**2 * 4 / 3) - 1)
        report("Graded body, density rho (1 + (y/H)^2), 32 elements", "mass over 4/3 rho H^2", "1 +- 1e-4", f"{1 + errors[-1]:.6f}",
               "exact integral", f"{self.order_of(np.array(errors)):.2f}")
        self.assertLess(abs(errors[-1]), 1e-4)


if __name__ == "__main__":
    unittest.main()
