"""A run that was stopped goes on: the same bytes as one that was not, on any number of ranks, or a refusal."""

import shutil
import signal
import subprocess
import time
import unittest
from pathlib import Path

import numpy as np
import yaml
from running import MPIEXEC, SLIDE, InScratch, arguments_of, datasets, h5py
from scenes import SIDE, SQUEAL, block

SHORT = {**SQUEAL, "time_end": 60e-6, "time_step": 2e-9, "contact_every": 500, "history_every": 20}  # 30 000 steps
# 600 000 steps, two seconds of a fast machine, for a signal to come in time: rows are seen after half a second.
LONG = {**SHORT, "time_step": 1e-10, "contact_every": 7500, "history_every": 300}
EVERYTHING = {
    **LONG, "time_beta2": 0.6, "damping_mass": 100, "body_acceleration": "0,-9.81", "statistics_from": 3e-6,
    "fields_interval": 4e-6, "fields_quantities": "u,v,stress,strain,von_mises,damping_work",
    "fields_box": "0,0,3e-3,2e-3", "history_momentum": "yes", "statistics_damping": "yes",
}
# What a scene may have, and what it leaves from one step to the next.
SCENES = {
    "everything at once": EVERYTHING,
    "Coulomb, single storage": {
        **LONG, "friction_law": "coulomb", "friction_time": None, "friction_threshold": None,
        "stiffness_storage": "single", "statistics_from": 0, "statistics_quantile": 0.9, "contact_sums": "false"},
    "slip rate, a plate that tilts": {
        **LONG, "friction_time": None, "friction_rate": "slip", "friction_length": 1.2e-6,
        "friction_rate_reference": 0.1, "boundary_top_y": "tilting", "boundary_top_force": -60e3,
        "boundary_top_mass": 2e-3, "time_beta2": 0.8, "fields_times": "1e-6,20e-6,59e-6",
        "fields_quantities": "u,damping_work"},
    "no damping, traction": {**LONG, "damping_stiffness": None, "friction_threshold": "instantaneous",
                             "boundary_top_y": None, "boundary_top_pressure": 10e6},
}
FILES = ("history.h5", "contact.h5", "fields.h5", "statistics.h5", "interfaces.h5")


class InBlock(InScratch):
    def setUp(self):
        super().setUp()
        block(self.folder / "block.msh", divisions=8)

    def begin(self, *arguments, ranks=1):
        command = [SLIDE] if ranks == 1 else [MPIEXEC, "-n", str(ranks), SLIDE]
        job = subprocess.Popen([*command, *map(str, arguments)], cwd=self.folder, env=self.environment(), text=True,
                               stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.addCleanup(lambda: (job.poll() is None and job.kill(), job.communicate()))
        return job

    def stop(self, job, number, steps=1, folder="out"):
        """Sends the signal once the run has so many rows more than before; returns exit code and messages."""
        before, deadline = self.rows(folder), time.monotonic() + 60
        while self.rows(folder) < before + steps and job.poll() is None:
            self.assertLess(time.monotonic(), deadline, "no row for a minute")
            time.sleep(0.02)
        job.send_signal(number)
        out, err = job.communicate(timeout=60)
        return job.returncode, out + err

    def rows(self, folder):
        try:
            with h5py.File(self.folder / folder / "history.h5") as file:
                return len(file["time"])
        except (OSError, KeyError):
            return 0

    def assert_same(self, left, right):
        for file in FILES:
            path, other = self.folder / left / file, self.folder / right / file
            self.assertEqual(path.exists(), other.exists(), file)
            if not path.exists():
                continue
            one, two = datasets(path), datasets(other)
            self.assertEqual(one.keys(), two.keys(), file)
            for name, values in one.items():
                self.assertEqual(values.tobytes(), two[name].tobytes(), f"{file}: {name} differs")
        self.assertEqual(self.summary(left), self.summary(right))
        for file in ("fields.xdmf", "statistics.xdmf"):
            if (self.folder / left / file).exists():
                self.assertEqual((self.folder / left / file).read_text(), (self.folder / right / file).read_text())

    def summary(self, folder):
        found = yaml.safe_load((self.folder / folder / "summary.yaml").read_text())
        del found["cost"]
        return found


class SameBytes(InBlock):
    def test_over_one_two_and_three_ranks(self):
        for name, scene in SCENES.items():
            with self.subTest(name):
                self.run_scene(scene, output_folder="whole")
                job = self.begin(*arguments_of({**scene, "output_folder": "out"}))
                code, said = self.stop(job, signal.SIGTERM)
                self.assertEqual(code, 3, said)
                self.assertRegex(said, r"slide: interrupted by SIGTERM after step \d+ of 600000 .*; "
                                       r"go on with: slide -restart out")
                summary = self.summary("out")
                self.assertEqual((summary["state"], summary["interrupted_by"]), ("interrupted", "SIGTERM"))
                self.assertEqual(summary["go_on_with"], "slide -restart out")
                job = self.begin("-restart", "out", ranks=2)
                code, said = self.stop(job, signal.SIGUSR1, steps=100)
                self.assertEqual(code, 3, said)
                self.assertIn("go on with: mpirun -n 2 slide -restart out", said)
                outcome = self.slide("-restart", "out", ranks=3)
                self.assertEqual((outcome.codes, outcome.err), ([0] * 3, ""), outcome.out)
                self.assert_same("whole", "out")
                shutil.rmtree(self.folder / "out")
                shutil.rmtree(self.folder / "whole")

    def test_after_kills(self):
        """From the last checkpoint, whose step comes before the rows that the file has by then."""
        scene = {**EVERYTHING, "checkpoint_every": 20000}
        self.run_scene(scene, output_folder="whole")
        job = self.begin(*arguments_of({**scene, "output_folder": "out"}))
        for ranks in (2, 1, 2):
            self.wait_for_checkpoint(job)
            self.stop(job, signal.SIGKILL, steps=30)
            subprocess.run(["pkill", "-9", "-f", f"{SLIDE} .*{self.folder.name}"], check=False)
            self.wait_for_lock()
            job = self.begin("-restart", self.folder / "out", ranks=ranks)
        out, err = job.communicate(timeout=400)
        self.assertEqual((job.returncode, err), (0, ""), out)
        self.assert_same("whole", "out")

    def wait_for_checkpoint(self, job):
        path, deadline = self.folder / "out" / "checkpoint.h5", time.monotonic() + 60
        while not path.exists() and job.poll() is None and time.monotonic() < deadline:
            time.sleep(0.02)

    def wait_for_lock(self):
        time.sleep(1)  # ranks that lost their launcher end by themselves

    def test_with_a_later_end(self):
        """The last row of the shorter run lies between those of the longer one, and is taken back."""
        scene = {**EVERYTHING, "time_step": 2e-9, "statistics_to": 10e-6, "history_every": 7, "contact_every": 130}
        self.run_scene(scene, output_folder="whole", time_end=30e-6)
        self.run_scene(scene, output_folder="out", time_end=20e-6)
        outcome = self.slide("-restart", "out", "-time_end", 30e-6, ranks=2)
        self.assertEqual((outcome.codes, outcome.err), ([0, 0], ""), outcome.out)
        self.assert_same("whole", "out")

    def test_of_a_finished_run(self):
        self.run_scene(SHORT, time_end=1e-6)
        before = {path.name: path.read_bytes() for path in (self.folder / "out").iterdir()}
        outcome = self.slide("-restart", "out")
        self.assertEqual((outcome.codes, outcome.err), ([0], ""))
        self.assertIn("the run in 'out' is finished (t = 1e-06 s); a later -time_end would make it longer", outcome.out)
        self.assertEqual(before, {path.name: path.read_bytes() for path in (self.folder / "out").iterdir()})

    def test_with_another_kernel_and_a_massless_plate(self):
        """Both promise the same bits; a plate without mass has the momentum +0 on any number of ranks."""
        scene = {**SHORT, "boundary_top_y": "tilting", "boundary_top_force": -60e3, "history_momentum": "yes"}
        self.run_scene(scene, output_folder="whole", time_end=2e-6)
        self.run_scene(scene, output_folder="out", time_end=1e-6, ranks=2)
        outcome = self.slide("-restart", "out", "-time_end", 2e-6, "-stiffness_kernel", "pairs", "-stiffness_instructions",
                             "base", ranks=2)
        self.assertEqual((outcome.codes, outcome.err), ([0, 0], ""), outcome.out)
        self.assert_same("whole", "out")

    def test_within_its_wall_time(self):
        start = time.monotonic()
        outcome = self.slide(*arguments_of({**LONG, "time_end": 1, "time_wall": 0.06}))
        self.assertLess(time.monotonic() - start, 0.06 * 60)
        self.assertEqual(outcome.codes, [3])
        self.assertIn("interrupted by -time_wall 0.06 min after step", outcome.err)


class Sparser(InBlock):
    def test_rows_and_frames_from_there_on(self):
        self.run_scene(SHORT, time_end=2e-6, fields_every=100)
        outcome = self.slide("-restart", "out", "-time_end", 4e-6, "-history_every", 50, "-contact_every", 1000,
                             "-fields_every", 500)
        self.assertEqual((outcome.codes, outcome.err), ([0], ""), outcome.out)
        history = datasets(self.folder / "out" / "history.h5")
        self.assertEqual([int(n) for n in history["step"]], [*range(0, 1000, 20), *range(1000, 2001, 50)])
        fields = datasets(self.folder / "out" / "fields.h5")
        np.testing.assert_allclose(fields["time"] / 2e-9, [*range(0, 1000, 100), *range(1000, 2001, 500)])
        self.assertGreaterEqual(self.summary("out")["averages_from"], 1000 * 2e-9)
        # And once more, when nothing has kept what the first half of the run would have needed.
        outcome = self.slide("-restart", "out", "-time_end", 4.2e-6, ranks=2)
        self.assertEqual((outcome.codes, outcome.err), ([0, 0], ""), outcome.out)


class Refusals(InBlock):
    def setUp(self):
        super().setUp()
        self.run_scene(SHORT, time_end=1e-6, checkpoint_every=300)

    def refused(self, *words, arguments=(), ranks=1):
        outcome = self.slide("-restart", "out", *arguments, ranks=ranks)
        self.assert_refused("slide", outcome, words, ranks)

    def test_of_other_options(self):
        for arguments, words in {
            ("-friction_coefficient", "0.4"): ("-friction_coefficient is 0.4", "the run in 'out' has 0.5", "leave it"),
            ("-damping_mass", "3"): ("-damping_mass is 3", "'out' has 0"),
            ("-boundary_left_x", "fixed"): ("-boundary_left_x is fixed", "'out' has none"),
            ("-output_folder", "elsewhere"): ("-output_folder is elsewhere", "has out"),
            ("-time_end", "1e300"): ("-time_end is 1e+300 s, which takes", "give an earlier -time_end"),
            ("-nonsense", "3"): ("-nonsense is not an option of slide",),
            ("-time_end", "5e-7"): ("-time_end is 5e-07 s", "can only go further"),
        }.items():
            with self.subTest(arguments):
                self.refused(*words, arguments=arguments)
        (self.folder / "more.yaml").write_text("friction: {coefficient: 0.4}\n")
        self.refused("-friction_coefficient is 0.4", arguments=("-options_file_yaml", "more.yaml"), ranks=2)
        # What is the same in other words is no change, and the command line has the last word.
        outcome = self.slide("-restart", "out", "-options_file_yaml", "more.yaml", "-friction_coefficient", "5e-1",
                             "-history_points", "2.50e-3,0.0,1.3e-3,2.2e-3", "-output_folder", "./out/",
                             "-history_momentum", "no", "-time_end", "1.2e-6")
        self.assertEqual((outcome.codes, outcome.err), ([0], ""))

    def test_of_another_mesh(self):
        block(self.folder / "block.msh", divisions=10)
        self.refused("the mesh 'block.msh' has the checksum fnv1a:", "start a new run",
                     arguments=("-time_end", "2e-6"), ranks=2)
        block(self.folder / "moved.msh", divisions=8)
        outcome = self.slide("-restart", "out", "-time_end", "1.2e-6", "-mesh_file", "moved.msh")
        self.assertEqual((outcome.codes, outcome.err), ([0], ""))

    def test_of_a_folder_without_a_checkpoint(self):
        (self.folder / "empty").mkdir()
        for folder in ("empty", "absent"):
            self.assert_refused("slide", self.slide("-restart", folder, ranks=2), ("no checkpoint in '" + folder,), 2)
        (self.folder / "scene.yaml").write_text("restart: out\n")
        outcome = self.slide("-options_file_yaml", "scene.yaml")
        self.assert_refused("slide", outcome, ("give -restart on the command line",), 1)

    def test_of_damaged_checkpoints(self):
        newer, older = (self.folder / "out" / name for name in ("checkpoint.h5", "checkpoint_older.h5"))
        damaged = bytearray(newer.read_bytes())
        damaged[len(damaged) // 2] ^= 1
        newer.write_bytes(damaged)
        self.run_scene(SHORT, time_end=1e-6, output_folder="whole")
        outcome = self.slide("-restart", "out", ranks=2)
        self.assertEqual((outcome.codes, outcome.err), ([0, 0], ""))
        self.assertIn("note: 'out/checkpoint.h5' is damaged; going on from 'out/checkpoint_older.h5', which is older",
                      outcome.out)
        self.assert_same("whole", "out")
        for path in (newer, older):
            path.write_bytes(path.read_bytes()[:-7])
        self.refused("the checkpoints in 'out' are damaged", arguments=("-time_end", "2e-6"), ranks=2)

    def test_of_files_of_another_run(self):
        """Of the same mesh and the same length, so that only the run tells them apart."""
        self.run_scene(SHORT, time_end=1e-6, friction_coefficient=0.4, output_folder="other", fields_every=100)
        self.run_scene(SHORT, time_end=1e-6, output_folder="out", fields_every=100)
        for file in ("history.h5", "contact.h5", "fields.h5"):
            with self.subTest(file):
                shutil.copytree(self.folder / "out", self.folder / "kept")
                shutil.copy(self.folder / "other" / file, self.folder / "out" / file)
                self.refused(file, "run", arguments=("-time_end", "2e-6"), ranks=2)
                shutil.rmtree(self.folder / "out")
                (self.folder / "kept").rename(self.folder / "out")
        (self.folder / "out" / "contact.h5").unlink()
        self.refused("was finished, but its contact.h5 is gone")

    def test_of_files_that_are_not_what_they_were(self):
        for file, spoil in {
            "history.h5": lambda path: path.unlink(),
            "contact.h5": lambda path: path.write_bytes(b"nothing"),
        }.items():
            with self.subTest(file):
                shutil.copytree(self.folder / "out", self.folder / "kept")
                spoil(self.folder / "out" / file)
                self.refused(file, arguments=("-time_end", "2e-6"), ranks=2)
                shutil.rmtree(self.folder / "out")
                (self.folder / "kept").rename(self.folder / "out")
        with h5py.File(self.folder / "out" / "history.h5", "r+") as history:
            history["time"].resize((3,))
        self.refused("history.h5", arguments=("-time_end", "2e-6"))


if __name__ == "__main__":
    unittest.main()
