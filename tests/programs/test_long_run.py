"""Ten million steps: the clock, the energy balance and the motion do not wear off."""

import unittest

import numpy as np
from running import InScratch, datasets
from scenes import SQUEAL, block

STEP = 2e-9  # s
STEPS = 10_000_000
RARELY = {"time_step": STEP, "time_end": STEPS * STEP, "history_every": 1000, "checkpoint_minutes": 0,
          "history_points": None}
VIBRATING = {name: value for name, value in SQUEAL.items() if name.startswith(("mesh", "material"))}


class LongRun(InScratch):
    def history(self, scene):
        block(self.folder / "block.msh", divisions=6)
        self.run_scene({**scene, **RARELY})
        history = datasets(self.folder / "out" / "history.h5")
        self.assertEqual(int(history["step"][-1]), STEPS)
        self.assertEqual(history["time"].tobytes(), (history["step"] * STEP).tobytes())
        # Works are sums of ten million terms, whose rounding grows with the square root of their number.
        relative = np.abs(history["energy/residual"]) / history["energy/flowed"]
        self.assertLess(relative.max(), 1e-16 * np.sqrt(STEPS) * 10)
        return history

    def test_squeal(self):
        history = self.history({**SQUEAL, "contact_every": 100_000})
        self.assertGreater(history["contact/open"].max(), 0)
        half = len(history["time"]) // 2  # the limit cycle goes on as it was
        friction = history["boundary/top/tangential_force"]
        first, second = friction[half // 2:half], friction[half:]
        self.assertAlmostEqual(second.mean() / first.mean(), 1, delta=0.02)
        self.assertAlmostEqual(second.std() / first.std(), 1, delta=0.05)

    def test_free_vibration_neither_grows_nor_dies(self):
        history = self.history({**VIBRATING, "boundary_top_x": "fixed", "boundary_top_y": "fixed",
                                "initial_velocity": "0.3,-1"})
        stored = history["energy/kinetic"] + history["energy/strain"]
        np.testing.assert_allclose(stored, stored[0], rtol=1e-16 * np.sqrt(STEPS) * 10)


if __name__ == "__main__":
    unittest.main()
