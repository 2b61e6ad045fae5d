"""dense_modes.py against `slide` itself: the same exponents from eigenvalues and from the rows of a run."""

import tempfile
import unittest
from pathlib import Path

import numpy as np
import sliding_scenes
from dense_modes import Sliding, rates
from finding import report

import slipscale
from slipscale.measuring.growth import linear_stretch, seen

DIGITS = 1e-5  # relative, of growth and of frequency


class DenseModes(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.temporary.cleanup)
        cls.folder = Path(cls.temporary.name)

    def compared(self, name):
        """The two largest exponents that `slide` shows agree with those of the scheme; gives what they are, and how
        many nodes are closed and open."""
        options = sliding_scenes.scene(self.folder, name)
        out = self.folder / "run"
        sliding_scenes.run("slide", {**options, "contact_every": sliding_scenes.EVERY, "output_folder": out})
        sliding = Sliding(options)
        expected, _ = sliding.scheme_modes(float(options["time_step"]), float(options.get("time_beta2", 0.5)))
        contact = slipscale.Run(out).contact
        found, rows = seen(contact, options.get("boundary_top_ramp", 0), most=600, noise=1e-7)
        # The static solution by an active set has the nodes open that the run has.
        closed = np.isin(sliding.contact, sliding.closed)[np.argsort(sliding.body.x[sliding.contact, 0])]
        self.assertEqual(list(contact.status[rows.start] == slipscale.SLIP), list(closed), name)
        largest = found.p[0]
        nearest = expected[np.abs(expected - largest).argmin()]
        self.assertGreater(nearest.real, 0, name)
        self.assertAlmostEqual(largest.real / nearest.real, 1, delta=DIGITS, msg=name)
        self.assertAlmostEqual(largest.imag / nearest.imag, 1, delta=DIGITS, msg=name)
        self.assertLess(sliding.reduced_residual(nearest, float(options["time_step"]),
                                                 float(options.get("time_beta2", 0.5))), 1e-9, name)
        return nearest, largest, closed

    def test_slide_has_the_exponents_of_the_scheme(self):
        for name in sliding_scenes.SCENES:
            with self.subTest(name):
                expected, found, closed = self.compared(name)
                report(
                    "Growth of small vibration of a 10 x 10 block that slides, from rows of slide",
                    f"{name} ({closed.sum()} of {len(closed)} nodes closed): growth, 1/s; frequency, Hz",
                    f"{expected.real:.6g}; {expected.imag / 2 / np.pi:.7g} within 1e-5",
                    f"{found.real:.6g}; {found.imag / 2 / np.pi:.7g}", "dense eigenvalues of one step, dense_modes.py")


if __name__ == "__main__":
    unittest.main()
