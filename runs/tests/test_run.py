"""`slipscale.Run` and `slipscale.slide`: what a script sees of a run, units and shapes included."""

import sys
import tempfile
import unittest
from pathlib import Path
from unittest import mock

import h5py
import numpy as np

import slipscale
from slipscale.mistakes import Mistake
from slipscale.pictures import picture
from tests import fake_run


class OfARun(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(temporary.cleanup)
        fake_run.write_run(temporary.name, cells="mixed")
        cls.run_ = slipscale.Run(temporary.name)

    def test_rows(self):
        run, n = self.run_, 8000
        self.assertEqual((len(run.time), len(run.friction)), (n, n))
        self.assertEqual(run.boundary["top"]["normal_force"].shape, (n,))
        self.assertEqual(run.surface["drive_power"].shape, (n,))
        self.assertEqual(run.energy["kinetic"].shape, (n,))
        self.assertEqual(run.points[0].u.shape, (n, 2))
        np.testing.assert_allclose(run.states["stick"] + run.states["slip"] + run.states["open"], 1, rtol=1e-12)

    def test_contact(self):
        contact = self.run_.contact
        self.assertEqual(contact.status.shape, (len(contact.time), len(contact.x)))
        self.assertTrue(np.all(contact.normal_traction[contact.status == slipscale.OPEN] == 0))

    def test_fields(self):
        frame = self.run_.fields(2e-4)
        self.assertEqual(frame.time, 2e-4)
        self.assertEqual(frame.stress.shape[1], 3)
        self.assertEqual(frame.u.shape, (len(frame.coordinates), 2))
        self.assertIsNone(frame.strain)
        self.assertEqual(frame.region_names, ["matrix", "inclusion"])
        self.assertEqual(self.run_.fields().time, 4e-4)
        with self.assertRaisesRegex(slipscale.UnreadableRun, "no frame at 0.0003 s"):
            self.run_.fields(3e-4)

    def test_spectrum_finds_the_line_and_the_variance(self):
        found = self.run_.spectrum(from_=1e-4)
        self.assertAlmostEqual(found.dominant / fake_run.FREQUENCY, 1, delta=2e-3)
        # A wave of amplitude .03 and noise of deviation .004, over the mean normal force.
        self.assertAlmostEqual(found.density.sum() * found.frequency[1], 0.03**2 / 2 + 0.004**2, delta=2e-5)

    def test_options_and_facts(self):
        self.assertEqual(self.run_.options["friction_coefficient"], 0.5)
        self.assertEqual(self.run_.summary["friction_mean"], fake_run.FRICTION)

    def test_measures(self):
        found = self.run_.measures(from_=1e-4)
        self.assertAlmostEqual(found["friction"], fake_run.FRICTION, delta=1e-3)
        self.assertEqual(found["regime"], "stick-slip-separated")

    def test_a_window_that_is_too_short(self):
        with self.assertRaisesRegex(slipscale.UnreadableRun, "a spectrum needs 32"):
            self.run_.spectrum(from_=3.9995e-4)

    def test_rounding_has_no_frequency(self):
        with tempfile.TemporaryDirectory() as folder:
            fake_run.write_run(folder)
            for size, frequency in ((1e-6, 1e5), (1e-10, 0)):
                with h5py.File(Path(folder) / "history.h5", "r+") as file:
                    wave = np.cos(2 * np.pi * 1e5 * file["time"][:])
                    file["boundary/top/normal_force"][:] = 7.5e4
                    file["boundary/top/tangential_force"][:] = 3e4 * (1 + size * wave)
                run = slipscale.Run(folder)
                self.assertAlmostEqual(run.spectrum().dominant, frequency, delta=100)
                self.assertAlmostEqual(run.measures()["frequency"], frequency, delta=100)
                figure = picture.draw(folder)
                said = " ".join(" ".join(text.get_text() for text in figure.axes[2].texts).split())
                self.assertEqual("does not vary in the window" in said, not frequency)
                picture.plt.close(figure)

    def test_no_folder(self):
        with self.assertRaisesRegex(slipscale.UnreadableRun, "no folder nowhere"):
            slipscale.Run("nowhere")

    def test_a_name_that_is_none(self):
        with self.assertRaisesRegex(AttributeError, "it has .*Run.*slide"):
            slipscale.Rum


    def test_a_table_without_pandas(self):
        with mock.patch.dict(sys.modules, {"pandas": None}):
            with self.assertRaisesRegex(Mistake, r"^run\.table\(\) needs pandas, which .* has not: install [^\n]*$"):
                self.run_.table()


class Started(unittest.TestCase):
    """With a stand-in for `slide`."""

    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)

    def program(self, text):
        path = self.folder / "slide"
        path.write_text(f"#!{sys.executable}\nimport sys\n"
                        f"sys.path.insert(0, {str(Path(__file__).parents[1])!r})\n{text}")
        path.chmod(0o755)
        return path

    def test_from_a_dict(self):
        program = self.program(
            "import yaml\nfrom tests import fake_run\nwords = sys.argv[1:]\n"
            "given = dict(zip(words[::2], words[1::2]))\n"
            "scene = yaml.safe_load(open(given['-options_file_yaml']))\n"
            "assert scene['friction']['coefficient'] == 0.4 and given['-time_end'] == '0.0001', given\n"
            "fake_run.write_run(given['-output_folder'])\n")
        run = slipscale.slide({"friction": {"coefficient": 0.4}}, folder=self.folder / "out of it", program=program,
                              time_end=1e-4)
        self.assertEqual(len(run.time), 8000)

    def test_its_own_sentence(self):
        program = self.program("print('slide: -mesh_file is missing', file=sys.stderr)\nsys.exit(2)\n")
        with self.assertRaisesRegex(slipscale.RunFailed, "^slide: -mesh_file is missing$"):
            slipscale.slide({}, folder=self.folder / "out", program=program)

    def test_nowhere_to_go(self):
        with self.assertRaisesRegex(slipscale.RunFailed, "names no folder"):
            slipscale.slide({})


if __name__ == "__main__":
    unittest.main()
