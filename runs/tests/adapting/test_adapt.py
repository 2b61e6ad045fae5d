"""slipscale.adapting.adapt with a made-up `slide` whose power falls with the relaxation time, and where it has to
fail."""

import contextlib
import io
import os
import sys
import tempfile
import unittest
from pathlib import Path

import h5py
import yaml

from slipscale import command
from slipscale.adapting import adapt
from tests import fake_slide

RUNS = Path(__file__).parents[2]
TRUTH = 0.7e-6


class Adapt(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)
        os.environ["PYTHONPATH"] = str(RUNS)
        (self.folder / "mesh.msh").touch()  # beside the runs: found from a folder above them
        for name, time in (("truth", TRUTH), ("own", 2e-6)):
            fake_slide.write({"mesh_file": "mesh.msh", "friction_length": 2 * time, "friction_time": time,
                              "surface_speed": 2.0, "friction_coefficient": 0.5,
                              "output_folder": str(self.folder / name)})

    def run_adapt(self, *words):
        """The exit code, what adapt.yaml says, and what was said."""
        said = io.StringIO()
        with contextlib.redirect_stdout(said), contextlib.redirect_stderr(said):
            code = command.main(["adapt", str(self.folder / "truth"), str(self.folder / "own"), "--output",
                               str(self.folder / "adapted"), "--program", f"{sys.executable} -m tests.fake_slide",
                               "--window", "5e-5", "1e-4", *words])
        file = self.folder / "adapted" / "adapt.yaml"
        return code, yaml.safe_load(file.read_text()) if file.is_file() else None, said.getvalue()

    def change(self, name, dataset, factor):
        with h5py.File(self.folder / name / "history.h5", "a") as file:
            file[dataset][:] = factor * file[dataset][:]

    def test_the_search_finds_the_time_and_is_resumed(self):
        code, found, _ = self.run_adapt("--level", "search")
        level = found["levels"]["search"]
        self.assertEqual((code, level["match"], level["crossings"]), (0, "power", 1))
        self.assertAlmostEqual(level["value"] / TRUTH, 1, delta=0.02)
        self.assertLess(level["after"]["spectrum_distance"], 0.05 * found["before"]["spectrum_distance"])
        self.assertAlmostEqual(found["before"]["power"],
                               fake_slide.power_ratio(2e-6) / fake_slide.power_ratio(TRUTH) - 1, places=6)
        calls = self.folder / "adapted" / "trials" / "calls.txt"
        before = calls.read_text()
        self.assertEqual(self.run_adapt("--level", "search")[1], found)
        self.assertEqual(calls.read_text(), before)

    def test_modes_of_the_same_growth_give_the_time(self):
        words = ("--level", "modes", "--modes-program", f"{sys.executable} -m tests.fake_modes", "--most-modes", "12")
        code, found, _ = self.run_adapt(*words)
        level = found["levels"]["modes"]
        self.assertEqual((code, found["best"]), (0, "modes"))
        self.assertAlmostEqual(level["value"] / TRUTH, 1, delta=0.01)
        self.assertGreater(level["misfit_before"], 0.5)
        self.assertLess(level["misfit_after"], 0.01)
        self.assertEqual([row["frequency"] for row in level["paired"]], [row["partner_frequency"] for row in level["paired"]])
        _, found, _ = self.run_adapt(*words, "--most-modes", "2", "--free", "friction_coefficient")
        self.assertEqual(set(found["levels"]["modes"]["changes"]), {"friction_time", "friction_coefficient"})

    def test_modes_that_do_not_grow_give_no_time(self):
        (self.folder / "truth" / "run.yaml").write_text(
            (self.folder / "truth" / "run.yaml").read_text().replace("friction_coefficient: 0.5", "friction_coefficient: 0"))
        code, found, _ = self.run_adapt("--level", "modes", "--modes-program", f"{sys.executable} -m tests.fake_modes")
        self.assertEqual(code, 1)
        self.assertIn("no mode of the heterogeneous block grows up to 1e+06 Hz", found["reason"])

    def test_scaling_keeps_frequency_times_time(self):
        _, found, _ = self.run_adapt("--level", "scaling")  # both runs have one frequency
        self.assertAlmostEqual(found["levels"]["scaling"]["value"] / TRUTH, 1, delta=1e-3)

    def test_power_that_is_out_of_reach_gives_way_to_what_is_not(self):
        self.change("truth", "surface/power_into_body", 3.0)
        code, found, _ = self.run_adapt("--level", "search", "--match", "power")
        self.assertEqual(code, 1)
        self.assertRegex(found["reason"], "not bracketed: power")
        code, found, _ = self.run_adapt("--level", "search", "--match", "amplitude")
        self.assertEqual(code, 0)
        self.assertAlmostEqual(found["levels"]["search"]["after"]["amplitude"], 0, delta=0.02)

    def test_without_contact_rows_the_level_of_one_frequency_fails_alone(self):
        _, found, said = self.run_adapt("--level", "frequency", "scaling")
        self.assertEqual(found["levels"]["frequency"]["status"], "failed")
        self.assertRegex(found["levels"]["frequency"]["reason"], "contact.h5")
        self.assertEqual(found["best"], "scaling")
        self.assertIn("frequency: ", said)

    def test_values_as_small_as_nanoseconds_are_told_apart(self):
        _, found, _ = self.run_adapt("--parameter", "damping_stiffness", "--start", "2e-9", "--set",
                                     "friction_time=1e-6", "--points", "3")
        values = [row["damping_stiffness"] for row in found["levels"]["search"]["scan"]]
        self.assertEqual(values, [1e-9, 2e-9, 4e-9])
        self.assertEqual(len((self.folder / "adapted" / "trials" / "calls.txt").read_text().split()), 3)
        self.assertRegex(found["reason"], "not bracketed: power")  # the made-up run has no damping

    def test_nearer_than_a_block_at_rest(self):
        self.assertIsNone(adapt.not_adapted(1.4, 0.4, 1.0))
        self.assertRegex(adapt.not_adapted(4.3, 0.98, 1.0), "block at rest")
        self.assertRegex(adapt.not_adapted(0.4, 0.5, 1.0), "not nearer")

    def test_an_adaptation_goes_on_from_another(self):
        self.run_adapt("--level", "search")
        left = adapt.adapted_before(self.folder / "adapted")
        self.assertIn("/trials/friction_time_", left)
        self.assertEqual(adapt.adapted_before(self.folder / "own"), self.folder / "own")

    def test_a_missing_program_is_the_only_message(self):
        code, found, said = self.run_adapt("--program", "build/nowhere/slide")
        self.assertEqual((code, found, said.count("\n")), (2, None, 1))
        self.assertIn("there is no program build/nowhere/slide", said)
        code, _, said = self.run_adapt("--program", f"{sys.executable} build/nowhere/slide")
        self.assertEqual((code, said.count("\n")), (2, 1))

    def test_a_scan_of_which_no_run_ends_says_why(self):
        _, found, _ = self.run_adapt("--level", "search", "--set", "friction_coefficient=9")
        self.assertIn("no run of the scan came to its end: slide: this coefficient is too large", found["reason"])

    def test_a_missing_mesh_is_named(self):
        (self.folder / "mesh.msh").unlink()
        code, _, said = self.run_adapt()
        self.assertEqual((code, said.count("\n")), (2, 1))
        self.assertIn("names mesh.msh, which is neither here nor in a folder above the run", said)

    def test_what_cannot_be_read(self):
        code, found, said = self.run_adapt("--parameter", "damping_stiffness")
        self.assertEqual((code, found), (2, None))
        self.assertIn("no number damping_stiffness", said)


if __name__ == "__main__":
    unittest.main()
