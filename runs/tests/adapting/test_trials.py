"""Repetitions of a made-up run: with which options, and that none is run twice."""

import sys
import tempfile
import unittest
from pathlib import Path

from slipscale.adapting.trials import Trials, changed, options_of, spelled_out, value_of
from slipscale.measuring.regime import friction_spectrum
from slipscale.reading import UnreadableRun
from tests import fake_slide

PROGRAM = [sys.executable, "-m", "tests.fake_slide"]
WINDOW = (5e-5, 1e-4)


class Options(unittest.TestCase):
    def test_a_time_takes_the_place_of_a_length(self):
        self.assertEqual(changed({"friction_length": "1.2e-6", "time_end": 1}, {"friction_time": 1e-6}),
                         {"time_end": 1, "friction_time": 1e-6})
        slip = changed({"friction_time": 1e-6}, {"friction_rate": "slip", "friction_rate_reference": 0.2,
                                                 "friction_length": 1e-6})
        self.assertEqual(slip, {"friction_rate": "slip", "friction_rate_reference": 0.2, "friction_length": 1e-6})

    def test_the_material_of_a_file(self):
        with tempfile.TemporaryDirectory() as folder:
            file = Path(folder) / "effective.yaml"
            file.write_text("stiffness: [3.0e+9, 3.0e+9, 1.0e+9, 1.0e+9, 0.0, 0.0]\ndensity: 1800.0\n")
            found = spelled_out({"material_file": str(file), "time_end": 1})
        self.assertEqual(found, {"time_end": 1, "material_all_density": 1800.0,
                                 "material_all_stiffness": [3e9, 3e9, 1e9, 1e9, 0.0, 0.0]})
        self.assertEqual(spelled_out({"time_end": 1}), {"time_end": 1})

    def test_the_time_of_a_length(self):
        self.assertAlmostEqual(value_of({"friction_length": "1.2e-6", "surface_speed": -2.0}, "friction_time"), 0.6e-6)
        with self.assertRaisesRegex(UnreadableRun, "no number damping_stiffness"):
            value_of({}, "damping_stiffness")


class Repetitions(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        (self.folder / "mesh with a blank.msh").touch()
        self.options = {"mesh_file": str(self.folder.resolve() / "mesh with a blank.msh"), "friction_time": 1e-6,
                        "friction_coefficient": 0.5}
        # What a run records is not asked of its trials: either way to space the rows of the contact would contradict theirs.
        fake_slide.write({**self.options, "contact_interval": 1e-7, "fields_times": [1e-5],
                          "output_folder": str(self.folder / "run")})
        self.spectrum = friction_spectrum(self.folder / "run", WINDOW)

    def trials(self, **changes):
        return Trials(PROGRAM, {**self.options, **changes}, self.folder / "trials", WINDOW, self.spectrum)

    def calls(self):
        return (self.folder / "trials" / "calls.txt").read_text().split()

    def test_options_of_a_run_without_its_output(self):
        self.assertEqual(options_of(self.folder / "run"), self.options)
        with self.assertRaisesRegex(UnreadableRun, "which mesh"):
            options_of(self.folder)

    def test_what_was_run_is_kept_until_its_options_change(self):
        found = self.trials().run(friction_time=2e-6)
        self.assertAlmostEqual(found["power_ratio"], fake_slide.power_ratio(2e-6))
        self.assertGreater(found["spectrum_distance"], 0.2)
        self.assertEqual(self.trials().run(friction_time=2e-6), found)
        self.assertEqual(self.calls(), ["2e-06"])
        self.trials(friction_coefficient=0.6).run(friction_time=2e-6)
        self.assertEqual(self.calls(), ["2e-06", "2e-06"])

    def test_a_failure_has_a_reason(self):
        found = self.trials().run(friction_coefficient=9)
        self.assertEqual((found["status"], found["reason"]), ("failed", "slide: this coefficient is too large"))


if __name__ == "__main__":
    unittest.main()
