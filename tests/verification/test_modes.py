"""`modes` against the dense reference, against `slide`, and on any number of ranks."""

import unittest

import numpy as np
import sliding_scenes
from dense_modes import Sliding
from finding import report
from modes_program import ModesCase

import slipscale
from slipscale.measuring.growth import seen

TO = 1.2e6  # Hz
TOPIC = "Modes of steady sliding"


class Dense(ModesCase):
    def test_all_modes_of_small_blocks(self):
        """Every mode that is reported is one of the reference's, and none that grows faster is left out."""
        worst = worst_scheme = 0.0
        for name in sliding_scenes.SCENES:
            with self.subTest(name):
                options = sliding_scenes.scene(self.folder, name)
                sliding = Sliding(options)
                found = self.modes(options, modes_to=TO, modes_count=12, modes_scheme="true")
                expected = sliding.modes()[0]
                expected = expected[(expected.imag <= 2 * np.pi * TO) & (expected.imag > 0)][:12]
                scheme = sliding.scheme_modes(options["time_step"], options.get("time_beta2", 0.5))[0]
                self.assertEqual(len(found.p), 12)
                self.assertEqual(len(found.scheme), 12)
                for p, one, step in zip(expected, found.p, found.scheme):
                    worst = max(worst, abs(one - p) / abs(p))
                    self.assert_close(one, p, 1e-8, name)
                    nearest = scheme[np.abs(scheme - step).argmin()]
                    worst_scheme = max(worst_scheme, abs(step - nearest) / abs(step))
                    self.assert_close(step, nearest, 1e-8, name)
                    self.assertLess(abs(step - one) / abs(one), 0.02, name)  # the same mode
                state = found.yaml["state"]
                self.assertEqual((int(state["nodes_in_contact"]), int(state["nodes_open"])),
                                 (len(sliding.closed), len(sliding.contact) - len(sliding.closed)), name)
                self.assertAlmostEqual(float(state["normal_force"]) / sliding.pressure_force.sum(), 1, delta=1e-9)
        report(TOPIC, f"all of {len(sliding_scenes.SCENES)} blocks of 10 x 10 cells, 12 modes each: largest "
                           "relative difference; of the scheme", "<= 1e-8; 1e-8",
                           "; ".join("< 1e-9" if error < 1e-9 else f"{error:.0e}" for error in (worst, worst_scheme)),
                           "dense eigenvalues, dense_modes.py")

    def test_without_friction_the_modes_are_the_real_ones(self):
        options = {**sliding_scenes.scene(self.folder, "partly open"), "friction_coefficient": 0, "damping_stiffness": 0}
        sliding = Sliding(options)
        scale = np.sqrt(sliding.m)
        expected = np.sqrt(np.linalg.eigvalsh(sliding.k / np.outer(scale, scale)))[:8]
        found = self.modes(options, modes_to=TO, modes_count=40)
        self.assertGreaterEqual(len(found.p), 8)
        for omega in expected:
            self.assert_close(found.nearest(1j * omega), 1j * omega, 1e-9)
        report(TOPIC, "coefficient 0, no damping: the first 8 real modes, relative error", "<= 1e-9", "< 1e-9",
                           "dense eigenvalues of the frictionless body")


class AnyNumberOfRanks(ModesCase):
    def test_the_same_to_ten_digits(self):
        options = sliding_scenes.scene(self.folder, "composite, partly open", divisions=20)
        one, *others = (self.modes(options, ranks, modes_to=TO, modes_count=8) for ranks in (1, 2, 3))
        self.assertLessEqual(one.residual.max(), 1e-10)
        worst = 0.0
        for other in others:
            self.assertEqual(len(other.p), len(one.p))
            worst = max(worst, (np.abs(other.p - one.p) / np.abs(one.p)).max())
        self.assertLessEqual(worst, 1e-10)
        report(TOPIC, "on 2 and 3 ranks against 1: largest relative difference of 8 modes", "<= 1e-10",
                           "< 1e-10", "the same")


class Slide(ModesCase):
    """On meshes for which no dense matrix is made: the strongest vibration of a run is a mode."""

    def test_growth_and_frequency_of_runs(self):
        for name in ("closed, periodic", "composite, partly open", "partly open"):
            with self.subTest(name):
                options = sliding_scenes.scene(self.folder, name, divisions=20)
                options["time_step"] = min(options["time_step"], 5e-9)
                out = self.folder / "run"
                sliding_scenes.run("slide", {**options, "contact_every": 40, "output_folder": out})
                found, _ = seen(slipscale.Run(out).contact, options.get("boundary_top_ramp", 0), most=600, noise=1e-7)
                modes = self.modes(options, modes_to=TO, modes_count=20, modes_scheme="true")
                k = np.abs(modes.scheme - found.p[0]).argmin()
                exact, near = modes.scheme[k], modes.p[k]
                self.assertGreater(near.real, 0)
                self.assertAlmostEqual(found.p[0].real / near.real, 1, delta=1e-2, msg=name)
                self.assertAlmostEqual(found.p[0].imag / near.imag, 1, delta=1e-3, msg=name)
                self.assertAlmostEqual(found.p[0].real / exact.real, 1, delta=1e-5, msg=name)
                self.assertAlmostEqual(found.p[0].imag / exact.imag, 1, delta=1e-5, msg=name)
                report(
                    TOPIC, f"{name}, 20 x 20, the strongest vibration of slide: growth, 1/s; frequency, Hz",
                    f"{exact.real:.6g}; {exact.imag / 2 / np.pi:.7g} within 1e-5 (continuous time {near.real:.5g}; "
                    f"{near.imag / 2 / np.pi:.6g} within 1 %, 0.1 %)",
                    f"{found.p[0].real:.6g}; {found.p[0].imag / 2 / np.pi:.7g}", "modes of the scheme against rows of slide")


if __name__ == "__main__":
    unittest.main()
