"""Scatter, modes and verdicts of made-up runs, whose answers are known."""

import tempfile
import unittest
from pathlib import Path

import numpy as np

from equivalence.verdict import (ALIKE, AMPLITUDE, COMPETE, EQUIVALENT, FREQUENCY, ONE_ONLY, SCALARS, STABLE, UNLIKE,
                                 UNSETTLED, Run, compared, judge, modes, points, read_run, verdict)
from slipscale.reading import UnreadableRun
from tests import fake_run

STEP = 1e4  # Hz
BINS = np.arange(201) * STEP


def spectrum(*lines):
    """Lines (Hz, height), as wide as a Hann window makes them."""
    height = np.full(len(BINS), 1e-6)
    for at, size in lines:
        height += size * np.exp(-((BINS - at) / (0.7 * STEP))**2)
    return BINS, height


def run(*lines, amplitude=0.4, shift=0.0, **values):
    angle = np.linspace(0, 40 * np.pi, 4000)
    return Run(spectrum(*lines), np.array([np.cos(angle) + shift, np.sin(angle)]),
               {**dict.fromkeys(SCALARS, 0.0), "settled": True, "amplitude_ratio": 1.0, "amplitude": amplitude,
                **values})


class Criterion(unittest.TestCase):
    def test_each_morphology_against_the_mean_of_the_others(self):
        composites = [run(friction=value) for value in (0.40, 0.42, 0.47)]
        judged = judge("friction", composites, [run(friction=value) for value in (0.50, 0.43, 0.44)])
        np.testing.assert_allclose(judged.composites, [0.045, 0.015, 0.06])
        np.testing.assert_allclose(judged.homogenised, [0.07, 0.0, 0.01], atol=1e-12)
        self.assertAlmostEqual(judged.scatter, 0.06)
        self.assertAlmostEqual(judged.typical, 0.01)  # the median: one block that strays decides nothing
        self.assertTrue(judged.within)
        self.assertFalse(judge("friction", composites, [run(friction=0.50)]).within)

    def test_equal_morphologies_have_no_scatter_but_a_run_is_known_only_so_well(self):
        composites = [run(friction=0.4)] * 3
        self.assertTrue(judge("friction", composites, [run(friction=0.404)]).within)
        self.assertFalse(judge("friction", composites, [run(friction=0.41)]).within)

    def test_spectra_and_portraits(self):
        composites = [run((4e5, size)) for size in (1.0, 1.2)]
        judged = judge("spectrum", composites, [run((4e5, 1.1)), run((4e5, 2.2))])
        np.testing.assert_allclose(judged.composites, [1 - 1 / 1.2, 0.2], rtol=1e-4)
        np.testing.assert_allclose(judged.homogenised, [0, 1], atol=1e-4)
        shifted = judge("portrait", [run(), run(shift=0.2), run(shift=-0.2)], [run(shift=1), run(shift=0.01)])
        self.assertGreater(shifted.homogenised[0], shifted.scatter)
        self.assertLess(shifted.homogenised[1], shifted.scatter)

    def test_one_morphology_has_no_scatter(self):
        with self.assertRaisesRegex(ValueError, "two morphologies"):
            judge("friction", [run()], [run()])


class Modes(unittest.TestCase):
    def test_harmonics_are_no_modes_of_their_own(self):
        np.testing.assert_allclose(modes(spectrum((3.55e5, 1), (7.1e5, 0.9), (1.065e6, 0.5))), [3.55e5], atol=2e3)

    def test_a_harmonic_may_be_the_higher_peak(self):
        np.testing.assert_allclose(modes(spectrum((3.55e5, 0.7), (7.1e5, 1))), [3.55e5], atol=2e3)

    def test_competing_modes_strongest_first(self):
        np.testing.assert_allclose(modes(spectrum((4e5, 0.6), (5.25e5, 1), (8e5, 0.5))), [5.25e5, 4e5], atol=2e3)

    def test_what_is_low_or_slow_does_not_count(self):
        np.testing.assert_allclose(modes(spectrum((1e4, 5), (4e5, 1), (5.25e5, 0.3))), [4e5], atol=2e3)

    def test_nothing_without_a_peak(self):
        self.assertEqual(modes((BINS, np.zeros(len(BINS)))), [])


class Verdict(unittest.TestCase):
    composites = [run((3.5e5, size)) for size in (1.0, 1.1, 1.2)]

    def test_verdicts(self):
        still = run(amplitude=1e-4)
        for wanted, composites, homogenised in (
                (EQUIVALENT, self.composites, [run((3.5e5, 1.05))]),
                (AMPLITUDE, self.composites, [run((3.5e5, 2.0))]),
                (FREQUENCY, self.composites, [run((4.2e5, 1.1))]),
                (COMPETE, self.composites, [run((3.5e5, 1.1), (4.6e5, 1.0))]),
                (COMPETE, [run((3.5e5, 1)), run((4.6e5, 1))], [run((3.5e5, 1))]),
                (UNLIKE, [run((3.5e5, 1)), run((3.5e5, 1 + 2 * ALIKE))], [run((3.5e5, 1.3))]),
                (UNSETTLED, self.composites, [run((4.2e5, 1.1), settled=False)]),
                (UNSETTLED, [still, still], [run(amplitude=1e-4, settled=False)]),  # an instability begins so
                (EQUIVALENT, self.composites, [run((3.5e5, 1.05), settled=False)]),
                (ONE_ONLY, self.composites, [still]),
                (ONE_ONLY, [still, self.composites[0]], [still]),
                (STABLE, [still, still], [still])):
            self.assertEqual(verdict(composites, homogenised), wanted)

    def test_columns(self):
        row = compared(self.composites, [run((3.5e5, 2.0), amplitude_ratio=1 / 1.2),
                                         run((3.5e5, 2.0), amplitude_ratio=1.1)])
        self.assertEqual((row["verdict"], row["composites"], row["homogenised"]), (AMPLITUDE, 3, 2))
        self.assertEqual(row["homogenised_modes"], "350000; 350000")
        self.assertIs(row["settled"], True)
        self.assertAlmostEqual(row["amplitude_ratio"], 1 / 1.2)  # furthest from 1, falling or growing
        self.assertFalse(row["spectrum_within"])
        self.assertTrue(row["frequency_within"])


class Points(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = Path(cls.temporary.name)
        fake_run.write_run(cls.folder)

    @classmethod
    def tearDownClass(cls):
        cls.temporary.cleanup()

    def row(self, model, seed, mu, status="ok"):
        return {"model": model, "seed": seed, "coefficient": mu, "window": "cycle", "status": status, "reason": None}

    def test_a_point_is_what_both_models_were_run_at(self):
        rows = [self.row("composite", 1, 0.5), self.row("composite", 2, 0.5), self.row("homogenised", 1, 0.5),
                self.row("composite", 1, 0.3), self.row("composite", 2, 0.3, "failed"), self.row("homogenised", 1, 0.3),
                self.row("composite", 1, 0.1)]
        found = points(rows, [self.folder] * len(rows), {"cycle": (2.5e-4, 3.9e-4)})
        self.assertEqual([(row["coefficient"], row["status"]) for row in found], [(0.5, "ok"), (0.3, "failed")])
        self.assertEqual(found[0]["verdict"], EQUIVALENT)
        self.assertAlmostEqual(found[0]["spectrum_apart"], 0, places=12)
        self.assertIn("ran to the end", found[1]["reason"])

    def test_a_run_without_the_point(self):
        with self.assertRaisesRegex(UnreadableRun, "-history_points"):
            read_run(self.folder, (2.5e-4, 3.9e-4), point=1)


if __name__ == "__main__":
    unittest.main()
