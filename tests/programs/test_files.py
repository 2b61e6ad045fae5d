"""What a user finds in the output folder, what `-help` says, and that a run can be repeated from what it left."""

import os
import signal
import subprocess
import sys
import time
import unittest
from pathlib import Path

sys.path.append(str(Path(__file__).parents[2] / "runs"))

import meshio
import numpy as np
import yaml
from running import MPIEXEC, SLIDE, InScratch, arguments_of, datasets, h5py, yaml_of
from scenes import SQUEAL, block
from slipscale.reading.recovery import make_good

SCENE = {**SQUEAL, "time_end": 4e-6, "time_step": 2e-8}  # 200 steps
RECORDS = {"contact_every": 20, "fields_every": 50}


class Terminal(InScratch):
    """What is said, without and with a run."""

    def test_help(self):
        for word in ("-help", "-h"):
            outcome = self.slide(word)
            self.assertEqual((outcome.codes, outcome.err), ([0], ""))
            groups = [line for line in outcome.out.splitlines() if line and line[0].isalpha() and " " not in line]
            for group in ("mesh", "material", "surface", "friction", "boundary", "body", "initial", "damping", "time",
                          "stiffness", "history", "contact", "fields", "output", "progress"):
                self.assertIn(group, groups)
            self.assertIn("-friction_coefficient", outcome.out)
            self.assertIn("-material_<region>_young", outcome.out)
        self.assertEqual(list(self.folder.iterdir()), [])

    def test_version(self):
        self.assertRegex(self.slide("-version").out,
                         r"\Aslide \d+\.\d+\.\d+( \(commit [0-9a-f]{12}(-dirty)?\))?, "
                         r"PETSc 3\.\d+\.\d+, .*MPI.*, HDF5 1\.\d+\.\d+\n\Z")

    def test_log_view_has_the_stages(self):
        block(self.folder / "block.msh")
        outcome = self.slide(*arguments_of(SCENE), "-log_view", ranks=2)
        self.assertEqual((outcome.codes, outcome.err), ([0, 0], ""))
        self.assertRegex(outcome.out, r"\d:\s+Set-up:")
        self.assertRegex(outcome.out, r"\d:\s+Steps:")

    def test_what_is_printed_before_the_first_step(self):
        block(self.folder / "block.msh")
        out = self.run_scene(SCENE).out
        for words in ("block 5.000 mm x 5.000 mm", "waves along y", "crossing the height in", "stable step:",
                      "step used: 20.00 ns", "boundary top: x fixed", "surface below bottom"):
            self.assertIn(words, out)
        self.assertNotIn("\r", out)  # the line of progress is for terminals


class Output(InScratch):
    def setUp(self):
        super().setUp()
        block(self.folder / "block.msh", regions=("matrix", "inclusion"))

    def test_complete(self):
        self.run_scene({**SCENE, **RECORDS}, ranks=2)
        out = self.folder / "out"
        self.assertEqual({file.name for file in out.iterdir()},
                         {"run.yaml", "summary.yaml", "history.h5", "contact.h5", "fields.h5", "fields.xdmf",
                          "checkpoint.h5"})
        history = datasets(out / "history.h5")
        np.testing.assert_allclose(history["time"], 2e-8 * np.arange(0, 201, 5), rtol=1e-12)
        for name in ("boundary/top/normal_force", "surface/friction_heat", "friction/global", "energy/residual",
                     "contact/stick", "points/1/stress"):
            self.assertEqual(len(history[name]), 41, name)
        contact = datasets(out / "contact.h5")
        self.assertEqual(contact["u"].shape, (11, 9, 2))
        self.assertTrue(np.all(np.diff(contact["x"]) > 0))
        self.assertLessEqual(set(np.unique(contact["status"])), {0, 1, 2})
        with self.subTest("every dataset says what it is"):
            for file in ("history.h5", "contact.h5", "fields.h5"):
                self.check_attributes(out / file)

    def check_attributes(self, path):
        def check(name, item):
            if isinstance(item, h5py.Dataset):
                for attribute in ("units", "description"):
                    self.assertTrue(item.attrs.get(attribute), f"{path.name}: {name} has no {attribute}")

        with h5py.File(path, "r") as file:
            file.visititems(check)

    def test_fields_open_in_other_programs(self):
        self.run_scene({**SCENE, **RECORDS}, ranks=2)
        with meshio.xdmf.TimeSeriesReader(self.folder / "out" / "fields.xdmf") as reader:
            points, cells = reader.read_points_cells()
            times = []
            for frame in range(reader.num_steps):
                moment, on_points, on_cells = reader.read_data(frame)
                times.append(moment)
        np.testing.assert_allclose(times, [0, 1e-6, 2e-6, 3e-6, 4e-6], rtol=1e-12, atol=1e-20)
        self.assertEqual(len(points), 81)
        self.assertEqual(sum(len(block_of_cells.data) for block_of_cells in cells), 64)
        self.assertLess(on_points["u"][:, 1].min(), -1.3e-6)
        self.assertEqual(set(np.concatenate(on_cells["region"]).ravel()), {0, 1})

    def test_summary_and_run(self):
        self.run_scene({**SCENE, "friction_coefficient": 0.25}, ranks=2)
        run = yaml.safe_load((self.folder / "out" / "run.yaml").read_text())
        self.assertEqual(run["friction_coefficient"], 0.25)
        self.assertEqual(run["time_beta2"], 0.5)  # a default
        self.assertEqual((run["run"]["ranks"], run["run"]["nodes"], run["run"]["cells"]), (2, 81, 64))
        for fact in ("version", "mesh_checksum", "stable_step", "step", "wave_speeds_matrix", "wave_speeds_inclusion"):
            self.assertIn(fact, run["run"])
        summary = yaml.safe_load((self.folder / "out" / "summary.yaml").read_text())
        self.assertEqual(summary["steps"], 200)
        self.assertLess(summary["energy"]["largest_relative_residual"], 1e-12)
        self.assertAlmostEqual(sum(summary["contact"][state] for state in ("stick", "slip", "open")), 1, places=5)
        self.assertGreater(summary["cost"]["ns_per_node_and_step"], 0)

    def test_an_older_run_is_replaced_and_other_files_are_kept(self):
        self.run_scene({**SCENE, **RECORDS})
        (self.folder / "out" / "notes.txt").write_text("mine")
        self.run_scene(SCENE)
        self.assertEqual({file.name for file in (self.folder / "out").iterdir()},
                         {"run.yaml", "summary.yaml", "history.h5", "contact.h5", "checkpoint.h5", "notes.txt"})

    def test_without_a_surface(self):
        scene = {name: value for name, value in SCENE.items() if not name.startswith(("surface_", "friction_"))}
        self.run_scene(scene)
        self.assertFalse((self.folder / "out" / "contact.h5").exists())
        self.assertNotIn("contact/stick", datasets(self.folder / "out" / "history.h5"))


class Repeated(InScratch):
    """The options a run leaves behind are the scene."""

    def setUp(self):
        super().setUp()
        block(self.folder / "block.msh")

    def options_of(self, folder):
        return yaml.safe_load((self.folder / folder / "run.yaml").read_text())

    def test_run_yaml_is_a_scene(self):
        self.run_scene({**SQUEAL, **RECORDS, "fields_times": None, "history_boundary": "bottom"}, output_folder="first")
        self.run_scene({"options_file_yaml": "first/run.yaml", "output_folder": "second"}, ranks=2)
        for file in ("contact.h5", "fields.h5", "history.h5"):
            first, second = (datasets(self.folder / folder / file) for folder in ("first", "second"))
            self.assertEqual(first.keys(), second.keys())
            for name in first:
                if not name.startswith("energy/"):  # sums over the bulk, on another number of ranks
                    self.assertEqual(first[name].tobytes(), second[name].tobytes(), name)
        self.run_scene({"options_file_yaml": "first/run.yaml", "output_folder": "third"})
        first, third = (datasets(self.folder / folder / "history.h5") for folder in ("first", "third"))
        for name in first:
            self.assertEqual(first[name].tobytes(), third[name].tobytes(), name)
        options, again = self.options_of("first"), self.options_of("third")
        self.assertEqual({**options, "output_folder": "third"}, again)

    def test_a_file_is_the_same_as_the_command_line(self):
        (self.folder / "scene.yaml").write_text(yaml_of(SCENE))
        self.run_scene(SCENE, output_folder="typed")
        self.run_scene({"options_file_yaml": "scene.yaml", "output_folder": "read"})
        typed, read = (datasets(self.folder / folder / "history.h5") for folder in ("typed", "read"))
        for name in typed:
            self.assertEqual(typed[name].tobytes(), read[name].tobytes(), name)

    def test_the_command_line_wins(self):
        (self.folder / "scene.yaml").write_text(yaml_of(SCENE))
        self.run_scene({"options_file_yaml": "scene.yaml", "friction_coefficient": 0.1})
        self.assertEqual(self.options_of("out")["friction_coefficient"], 0.1)
        self.run_scene({"friction_coefficient": 0.2, "options_file_yaml": "scene.yaml"})
        self.assertEqual(self.options_of("out")["friction_coefficient"], 0.2)


class Running(InScratch):
    """A job that still runs can be plotted, and one that is killed leaves what it had written."""

    def setUp(self):
        super().setUp()
        block(self.folder / "block.msh")

    def start(self, ranks):
        """A job that would run for hours, and the processes of its ranks."""
        scene = {**SQUEAL, "time_end": 100, "history_every": 20, "contact_every": 1000}
        script = 'echo $$ > pid.$OMPI_COMM_WORLD_RANK; exec "$0" "$@"'
        command = [MPIEXEC, "-n", str(ranks), "bash", "-c", script, SLIDE, *arguments_of(scene)]
        job = subprocess.Popen(command, cwd=self.folder, env=self.environment(), stdin=subprocess.DEVNULL,
                               stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.addCleanup(self.kill, job, ranks)
        return job

    def kill(self, job, ranks):
        for rank in range(ranks):
            file = self.folder / f"pid.{rank}"
            if file.exists() and file.read_text().strip():
                try:
                    os.kill(int(file.read_text()), signal.SIGKILL)
                except ProcessLookupError:
                    pass
                file.unlink()
        job.kill()
        job.wait()

    def rows(self, job, more_than):
        """Waits until the file has more rows, and returns how many."""
        deadline = time.monotonic() + 60
        path = self.folder / "out" / "history.h5"
        while time.monotonic() < deadline:
            self.assertIsNone(job.poll(), "the job ended")
            try:
                with h5py.File(path, "r") as file:
                    if len(file["time"]) > more_than:
                        return len(file["time"])
            except (OSError, KeyError):
                self.assertEqual(more_than, 0, "the file could be read before, and now it cannot")
            time.sleep(0.1)
        self.fail("no new rows for a minute")

    def check(self, ranks):
        job = self.start(ranks)
        first = self.rows(job, 0)
        second = self.rows(job, first)
        self.kill(job, ranks)
        for file in ("history.h5", "contact.h5"):
            make_good(self.folder / "out" / file)  # killed as soon as the new rows show, which is while they change it
        history = datasets(self.folder / "out" / "history.h5")
        rows = min(len(values) for name, values in history.items() if not name.endswith("/x"))
        self.assertGreaterEqual(rows, second)
        step = history["time"][1] / history["step"][1]
        np.testing.assert_array_equal(history["step"][:rows], 20 * np.arange(rows))
        np.testing.assert_allclose(history["time"][:rows], step * history["step"][:rows], rtol=1e-12)
        np.testing.assert_allclose(sum(history["contact/" + state][:rows] for state in ("stick", "slip", "open")), 1,
                                   rtol=1e-12)
        self.assertTrue(np.all(history["energy/flowed"][1:rows] > 0))
        self.assertTrue(datasets(self.folder / "out" / "contact.h5")["time"].size)
        self.assertTrue((self.folder / "out" / "run.yaml").exists())
        self.assertFalse((self.folder / "out" / "summary.yaml").exists())

    def test_alone(self):
        self.check(ranks=1)

    def test_on_two_ranks(self):
        self.check(ranks=2)


if __name__ == "__main__":
    unittest.main()
