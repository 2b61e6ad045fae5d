"""Rows of momentum in history.h5: what the recorded forces give is what the body, and a plate on it, gain."""

import unittest

import numpy as np
from running import InScratch, datasets
from scenes import SQUEAL, block

RANKS = (1, 2)
STEP = 2e-8
SCENE = {**SQUEAL, "time_end": 8e-6, "time_step": STEP, "history_every": 1, "history_momentum": "true"}
# Held at the top only, where held nodes have no momentum of their own.
HELD = {**SCENE, "boundary_top_y": "fixed", "boundary_top_ramp": None, "initial_velocity": "0.1,-0.4"}
FORCE, RAMP, MASS = 3e4, 2e-6, 0.2
PLATE = {**SCENE, "boundary_top_x": None, "boundary_top_y": "rigid", "boundary_top_force": FORCE,
         "boundary_top_mass": MASS, "boundary_top_ramp": RAMP}


class Rows(InScratch):
    def setUp(self):
        super().setUp()
        block(self.folder / "block.msh", regions=("soft", "hard"))

    def history(self, scene, ranks, **changes):
        self.run_scene({**scene, "mesh_file": "block.msh", **changes}, ranks=ranks)
        return datasets(self.folder / "out" / "history.h5")

    def assert_gains(self, momentum, force):
        """v_{n+1} = v_n + Δt/2 (a_n + a_{n+1}) at each free node (beta2 = 1/2), so that the sums do so as well."""
        gained = np.concatenate([[0], np.cumsum(0.5 * STEP * (force[1:] + force[:-1]))])
        scale = np.abs(momentum).max()
        self.assertGreater(np.ptp(momentum), 0.1 * scale)
        np.testing.assert_allclose(momentum - momentum[0], gained, rtol=0, atol=1e-9 * scale)

    def test_a_held_body_gains_what_surface_and_support_give(self):
        for ranks in RANKS:
            with self.subTest(ranks=ranks):
                seen = self.history(HELD, ranks)
                momentum = seen["momentum/linear"]
                self.assertEqual(momentum.shape, (len(seen["time"]), 2))
                for axis, name in enumerate(("tangential_force", "normal_force")):
                    force = seen[f"surface/{name}"] - seen[f"boundary/top/{name}"]
                    self.assert_gains(momentum[1:, axis], force[1:])  # at t = 0 the support takes what its nodes had
                self.assertNotIn("plate", {name.split("/")[0] for name in seen})

    def test_a_plate_has_the_rest_of_its_force(self):
        for side, tilts in (("rigid", False), ("tilting", True)):
            for ranks in RANKS:
                with self.subTest(side=side, ranks=ranks):
                    seen = self.history(PLATE, ranks, boundary_top_y=side)
                    ramp = 0.5 * (1 - np.cos(np.pi * np.minimum(seen["time"] / RAMP, 1)))
                    self.assert_gains(seen["momentum/linear"][:, 1] + seen["plate/top/momentum"],
                                      seen["surface/normal_force"] - FORCE * ramp)
                    self.assert_gains(seen["momentum/linear"][:, 0], seen["surface/tangential_force"])
                    np.testing.assert_allclose(seen["plate/top/momentum"], MASS * seen["plate/top/velocity"], rtol=1e-14)
                    np.testing.assert_allclose(seen["plate/top/angular_momentum"],
                                               MASS * 5e-3**2 / 12 * seen["plate/top/tilt_rate"], rtol=1e-12)
                    self.assertEqual(np.any(seen["plate/top/tilt"] != 0), tilts)

    def test_a_free_body_keeps_both(self):
        free = {name: value for name, value in SCENE.items() if not name.startswith(("surface", "friction", "boundary"))}
        for ranks in RANKS:
            seen = self.history({**free, "damping_stiffness": None}, ranks, initial_rotation=40, initial_velocity="0.1,0.2")
            mass = 1800 * 5e-3**2
            np.testing.assert_allclose(seen["momentum/linear"], mass * np.array([[0.1, 0.2]] * len(seen["time"])), rtol=1e-12)
            angular = seen["momentum/angular"]
            np.testing.assert_allclose(angular, angular[0], rtol=1e-11)
            # Of a rigid square, a²/6, plus what lumping adds, h²/6 for squares of edge h (the corners stay nodes).
            edge = 5e-3 / 8
            self.assertAlmostEqual(angular[0] / (mass * (5e-3**2 / 6 + edge**2 / 3) * 40), 1, delta=1e-9)

    def test_nothing_where_it_is_not_asked_for(self):
        for value in (None, "false"):
            seen = self.history(PLATE, 1, history_momentum=value)
            self.assertFalse([name for name in seen if name.startswith(("momentum", "plate"))])


if __name__ == "__main__":
    unittest.main()
