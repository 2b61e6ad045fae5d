"""Ten million steps: the clock, the energy balance and the motion do not wear off."""

import unittest

import numpy as np
from running import InScratch, datasets
from scenes import SQUEAL, block

STEP = 2e-9  # s
STEPS = 10_000_000
# Without friction and damping nothing is supplied or lost once the top has come down.
SCENE = {**SQUEAL, "friction_law": "none", "friction_coefficient": None, "friction_time": None, "friction_threshold": None,
         "damping_stiffness": None, "boundary_top_ramp": 0, "time_step": STEP, "time_end": STEPS * STEP,
         "history_every": 1000, "history_points": "2.5e-3,2.5e-3", "contact_every": 100_000, "checkpoint_minutes": 0}


class LongRun(InScratch):
    def test_clock_energy_and_drift(self):
        block(self.folder / "block.msh", divisions=6)
        self.run_scene(SCENE)
        history = datasets(self.folder / "out" / "history.h5")
        steps = history["step"]
        self.assertEqual(int(steps[-1]), STEPS)
        self.assertEqual(history["time"].tobytes(), (steps * STEP).tobytes())
        # Works are sums of ten million terms: rounding makes a random walk of 1e-16 times its square root.
        relative = np.abs(history["energy/residual"]) / history["energy/flowed"]
        self.assertLess(relative.max(), 1e-12)
        stored = history["energy/kinetic"] + history["energy/strain"]
        half = len(stored) // 2
        self.assertLess(abs(stored[half:].mean() / stored[1:half].mean() - 1), 1e-9)
        u = history["points/0/u"][:, 1]
        self.assertLess(abs(u[half:].mean() / u[1:half].mean() - 1), 1e-3)


if __name__ == "__main__":
    unittest.main()
