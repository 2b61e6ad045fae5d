"""`slipscale wear`: depths, phases, flash temperature and refusals."""

import contextlib
import csv
import io
import math
import tempfile
import unittest
from pathlib import Path

import h5py
import numpy as np

from slipscale.command import main
from slipscale.run import Run
from slipscale.wearing import flash
from tests import fake_run

HEAT = ("--conductivity", "30", "--density", "2400", "--heat-capacity", "800", "--share", "0.5")


class Wear(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(temporary.cleanup)
        cls.folder = Path(temporary.name)
        fake_run.write_run(cls.folder / "run")

    def wear(self, *words, run="run"):
        """Exit code, what was said and what went wrong."""
        out, err = io.StringIO(), io.StringIO()
        with contextlib.redirect_stdout(out), contextlib.redirect_stderr(err):
            try:
                code = main(["wear", str(self.folder / run), str(self.folder / "wear"), *words])
            except SystemExit as end:
                code = end.code
        return code, out.getvalue(), err.getvalue()

    def found(self):
        with h5py.File(self.folder / "wear/wear.h5") as file:
            names = []
            file.visititems(lambda name, item: names.append(name) if isinstance(item, h5py.Dataset) else None)
            return {name: file[name][()] for name in names}

    def test_depths_are_the_laws(self):
        code, said, wrong = self.wear("--archard", "1e-4", "--hardness", "2e9", "--energy", "1e-14")
        self.assertEqual((code, wrong), (0, ""))
        found, contact = self.found(), Run(self.folder / "run").contact
        np.testing.assert_allclose(found["depth/archard"], 1e-4 / 2e9 * contact.sums["pressure_slip"], rtol=1e-14)
        np.testing.assert_allclose(found["depth/energy"], 1e-14 * contact.sums["friction_work"], rtol=1e-14)
        self.assertRegex(said, r"depth, Archard.*: mean .* m per m of slip")
        self.assertRegex(said, r"\n  inclusion: .* % of the length, mean .* % of the volume")
        self.assertNotIn("flash", said)
        self.assertTrue((self.folder / "wear/wear.png").stat().st_size > 10000)
        with open(self.folder / "wear/wear.csv", newline="") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual(len(rows), len(contact.x))
        np.testing.assert_array_equal([float(row["depth_archard [m]"]) for row in rows], found["depth/archard"][-1])

    def test_each_phase_has_its_constants(self):
        self.wear("--energy", "matrix=2e-14,inclusion=1e-15")
        found, contact = self.found(), Run(self.folder / "run").contact
        inside = contact.region_share["inclusion"] == 1
        work = contact.sums["friction_work"][-1]
        np.testing.assert_allclose(found["depth/energy"][-1], np.where(inside, 1e-15, 2e-14) * work, rtol=1e-14)

    def test_a_window_counts_from_its_first_row(self):
        self.wear("--energy", "1e-14", "--window", "1e-4", "2e-4")
        found, contact = self.found(), Run(self.folder / "run").contact
        rows = np.searchsorted(contact.time, [1e-4 - 1e-12, 2e-4 - 1e-12])
        self.assertEqual((found["time"][0], found["time"][-1]), tuple(contact.time[rows]))
        work = contact.sums["friction_work"]
        np.testing.assert_allclose(found["depth/energy"][-1], 1e-14 * (work[rows[1]] - work[rows[0]]), rtol=1e-12)

    def test_what_a_window_and_a_run_lack_is_said(self):
        """A window that is cut, a run that was interrupted; nothing where both are whole."""
        self.assertNotIn("note", self.wear("--energy", "1e-14", "--window", "1e-4", "4e-4")[1])
        code, said, _ = self.wear("--energy", "1e-14", "--window", "1e-4", "9e-4")
        self.assertEqual(code, 0)
        self.assertIn("note: the window 0.0001 to 0.0009 s reaches beyond what is recorded, 0 to 0.00039995 s, and is cut", said)
        fake_run.write_run(self.folder / "stopped")
        for state, words in (("", "still running, or stopped early"),
                             ("state: interrupted\ninterrupted_by: SIGTERM\n", "interrupted by SIGTERM")):
            (self.folder / "stopped/summary.yaml").write_text(state)
            (self.folder / "stopped/run.yaml").write_text("time_end: 8e-4\n")
            self.assertIn(f"note: the run has reached 399.9 µs of 800 µs: {words}\n",
                          self.wear("--energy", "1e-14", run="stopped")[1])

    def test_flash_temperature_is_that_of_the_heat(self):
        code, said, _ = self.wear(*HEAT)
        self.assertEqual(code, 0)
        self.assertRegex(said, "flash temperature: highest")
        found, contact = self.found(), Run(self.folder / "run").contact
        effusive = math.sqrt(30 * 2400 * 800)
        expected = flash.temperature(contact.time, 0.5 * contact.sums["friction_work"], effusive)
        np.testing.assert_allclose(found["temperature"], expected, rtol=0, atol=1e-12 * expected.max())

    def test_refusals(self):
        for words, sentence in {
            (): "nothing is asked for: give --archard",
            ("--archard", "1"): "--archard without --hardness",
            ("--hardness", "1"): "--hardness without --archard",
            ("--energy", "-1"): "--energy is '-1': give a number above 0, in m\\^3/J",
            ("--energy", "steel=1"): "the region 'steel', .* there are matrix, inclusion",
            ("--energy", "matrix=1"): "nothing for the region 'inclusion'",
            ("--energy", "matrix=1,matrix=2"): "names the region 'matrix' twice",
            ("--energy", "matrix=1,2"): "give one number, or one for each region",
            HEAT[:4]: "--conductivity without --heat-capacity",
            (*HEAT[:-1], "1.5"): "--share is 1.5",
            ("--energy", "1", "--window", "1", "2"): "has 0 rows between 1 and 2 s",
            ("--energy", "1", "--window", "2e-4", "1e-4"): "--window: goes from 0.0002 to 0.0001 s: give the earlier time first",
            ("--energy", "1", "--window", "nan", "1e-4"): "--window: goes from nan to 0.0001 s",
        }.items():
            with self.subTest(words):
                code, _, wrong = self.wear(*words)
                self.assertEqual(code, 2)
                self.assertRegex(wrong, rf"^slipscale wear: [^\n]*{sentence}[^\n]*\n$")

    def test_of_a_run_without_sums(self):
        fake_run.write_run(self.folder / "older")
        with h5py.File(self.folder / "older/contact.h5", "a") as file:
            del file["sums"]
        code, _, wrong = self.wear("--energy", "1", run="older")
        self.assertEqual(code, 2)
        self.assertRegex(wrong, r"contact.h5 has no sums/friction_work: .* -contact_sums true")


class FlashTemperature(unittest.TestCase):
    def test_of_a_constant_flux_is_exact_at_every_row(self):
        """2 q √(t/(π k ρ c)), rows evenly spaced or not, few or many."""
        q, effusive = 3e7, 7589.0
        for time in (np.linspace(0, 1e-3, 101), np.linspace(0, 1e-3, 101) ** 2, np.linspace(0, 1e-3, 5001)):
            found = flash.temperature(time, q * time[:, None], effusive)[:, 0]
            exact = 2 * q * np.sqrt(time / math.pi) / effusive
            np.testing.assert_allclose(found, exact, rtol=1e-12, atol=1e-12 * exact.max())

    def test_of_a_flux_that_grows_converges(self):
        """q = a t makes (4/3) a t^(3/2)/√(π k ρ c)."""
        errors = []
        for rows in (50, 100, 200):
            time = np.linspace(0, 1, rows + 1)
            found = flash.temperature(time, 0.5 * time[:, None] ** 2, 1.0)[-1, 0]
            errors.append(abs(found / (4 / 3 / math.sqrt(math.pi)) - 1))
        order = math.log2(errors[-2] / errors[-1])
        self.assertGreater(order, 1.4)
        self.assertLess(errors[-1], 2e-4)

    def test_both_ways_agree(self):
        rng = np.random.default_rng(2)
        time = np.linspace(0, 1e-3, flash.AT_ONCE + 100)
        heat = np.cumsum(rng.uniform(0, 1, (len(time), 3)), axis=0)
        fast = flash.temperature(time, heat, 1.0)
        uneven = time.copy()
        uneven[-1] += 1e-7 * time[1]  # no longer even, by next to nothing
        np.testing.assert_allclose(flash.temperature(uneven, heat, 1.0)[:-1], fast[:-1], rtol=0,
                                   atol=1e-11 * fast.max())


if __name__ == "__main__":
    unittest.main()
