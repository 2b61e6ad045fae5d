"""The folder of a run that is gone on with, or replaced: what is noticed there, and what is kept."""

import shutil
import signal
import subprocess
import time
import unittest
from pathlib import Path

import yaml
from running import SLIDE, InScratch, arguments_of, datasets, h5py, snapshot
from scenes import SQUEAL, block

SCENE = {**SQUEAL, "time_step": 2e-9, "time_end": 4e-6, "contact_every": 100, "history_every": 10, "fields_every": 400,
         "fields_quantities": "u,v,stress,strain,von_mises", "checkpoint_every": 900}
LONG = {**SCENE, "time_step": 1e-10, "history_every": 1000, "fields_every": 20000, "checkpoint_every": 9000}  # 40 000 steps
FIELDS = [f"frames/00001/{name}" for name in ("u", "v", "stress", "stress_zz", "strain", "von_mises")]
DATASETS = {
    "history.h5": ["time", "step", "energy/strain", "boundary/top/normal_force", "points/0/u", "points/1/stress"],
    "contact.h5": ["time", "u", "gap", "status", "x"],
    "fields.h5": ["time", "mesh/coordinates", "mesh/cells", "mesh/region", *FIELDS],
}


class InFolder(InScratch):
    def setUp(self):
        super().setUp()
        block(self.folder / "block.msh")

    def summary(self, folder="out"):
        return yaml.safe_load((self.folder / folder / "summary.yaml").read_text())

    def refused(self, *words, arguments=(), ranks=1):
        before = snapshot(self.folder / "out")
        outcome = self.slide("-restart", "out", *arguments, ranks=ranks)
        self.assert_refused("slide", outcome, words, ranks)
        self.assertEqual(snapshot(self.folder / "out"), before)


class Contents(InFolder):
    def test_that_were_changed_are_noticed(self):
        """One number of each kind of dataset, in the first or in the last row that counts; shapes stay."""
        self.run_scene(SCENE)
        shutil.copytree(self.folder / "out", self.folder / "kept")
        for file, names in DATASETS.items():
            for name in names:
                with self.subTest(file, name=name):
                    with h5py.File(self.folder / "out" / file, "r+") as data:
                        row = -2 if name in ("time", "gap") else 0
                        data[name][row] = data[name][row] + 1
                    self.refused(f"{file}' cannot be continued: '/", "put back the file that the interrupted run left",
                                 arguments=("-time_end", 6e-6), ranks=2 if name == "time" else 1)
                    shutil.copy(self.folder / "kept" / file, self.folder / "out" / file)

    def test_a_heap_without_end_is_refused(self):
        """What is free in a global heap, said to be of size 0: HDF5 would go round in it for ever (HDF5 File Format
        Specification 2.0, III.E)."""
        self.run_scene(SCENE)
        path = self.folder / "out" / "fields.h5"
        data = bytearray(path.read_bytes())
        heap = data.index(b"GCOL\1\0\0\0")
        at = heap + 16
        while number := int.from_bytes(data[at:at + 2], "little"):
            size = int.from_bytes(data[at + 8:at + 16], "little")
            at += 16 + (size + 7) // 8 * 8
        self.assertEqual((number, at < heap + int.from_bytes(data[heap + 8:heap + 16], "little")), (0, True))
        data[at + 8:at + 16] = bytes(8)
        path.write_bytes(data)
        self.refused("fields.h5' cannot be continued: it is cut short or damaged",
                     "put back the file that the interrupted run left", arguments=("-time_end", 6e-6))

    def test_behind_the_checkpoint_do_not_count(self):
        """Of a run that was killed, or whose last row lies between the others."""
        self.run_scene(SCENE, time_end=4.01e-6)
        shutil.copytree(self.folder / "out", self.folder / "whole")
        for file, last in (("history.h5", 2005), ("contact.h5", 2005), ("fields.h5", 2005)):
            with h5py.File(self.folder / "out" / file, "r+") as data:
                self.assertAlmostEqual(data["time"][-1] / 2e-9, last, places=6)
                data["time"][-1] = 0
        (self.folder / "out" / "checkpoint.h5").unlink()  # then what counts ends with step 1800
        outcome = self.slide("-restart", "out", ranks=2)
        self.assertEqual((outcome.codes, outcome.err), ([0, 0], ""), outcome.out)
        for file in DATASETS:
            one, two = datasets(self.folder / "whole" / file), datasets(self.folder / "out" / file)
            self.assertEqual({name: values.tobytes() for name, values in one.items()},
                             {name: values.tobytes() for name, values in two.items()})

    def test_that_are_cut_off_are_told_in_plain_words(self):
        self.run_scene(SCENE)
        for file in DATASETS:
            with self.subTest(file):
                whole = (self.folder / "out" / file).read_bytes()
                for size in (0, 100, len(whole) // 2, len(whole) - 8):
                    (self.folder / "out" / file).write_bytes(whole[:size])
                    self.refused(f"{file}' cannot be continued: it is ", "put back the file",
                                 arguments=("-time_end", 6e-6))
                (self.folder / "out" / file).write_bytes(whole)


class Folders(InFolder):
    def test_by_the_name_of_a_checkpoint_are_refused_at_the_start(self):
        for name in ("checkpoint.h5", "checkpoint_older.h5", "checkpoint_next.h5"):
            for ranks in (1, 2):
                with self.subTest(name, ranks=ranks):
                    shutil.rmtree(self.folder / "out", ignore_errors=True)
                    (self.folder / "out" / name).mkdir(parents=True)
                    outcome = self.slide(*arguments_of(SCENE), ranks=ranks)
                    self.assert_refused("slide", outcome, (f"holds a folder named {name}",), ranks)
        shutil.rmtree(self.folder / "out")
        self.run_scene(SCENE)
        (self.folder / "out" / "checkpoint_next.h5").mkdir()
        self.refused("checkpoint_next.h5' is a folder", arguments=("-time_end", 6e-6), ranks=2)

    def test_of_an_interrupted_run_keep_it_when_another_takes_its_place(self):
        self.run_scene(SCENE, output_folder="whole")
        for ranks in (1, 2):
            with self.subTest(ranks=ranks):
                shutil.rmtree(self.folder / "out", ignore_errors=True)
                self.interrupt()
                outcome = self.run_scene(SCENE, time_end=1e-6, ranks=ranks)
                self.assertIn("the interrupted run that was in 'out' is kept: slide -restart out/replaced goes on with it",
                              outcome.out)
                self.assertEqual(self.summary()["state"], "finished")
                outcome = self.slide("-restart", "out/replaced", ranks=ranks)
                self.assertEqual((outcome.codes, outcome.err), ([0] * ranks, ""), outcome.out)
                for file in DATASETS:
                    one = datasets(self.folder / "whole" / file)
                    two = datasets(self.folder / "out" / "replaced" / file)
                    self.assertEqual({name: values.tobytes() for name, values in one.items()},
                                     {name: values.tobytes() for name, values in two.items()})
        # A finished one is replaced.
        self.assertNotIn("is kept", self.run_scene(SCENE, time_end=1e-6).out)

    def interrupt(self):
        """What a kill behind step 1800 leaves."""
        self.run_scene(SCENE)
        (self.folder / "out" / "checkpoint.h5").unlink()
        (self.folder / "out" / "summary.yaml").unlink()

    def test_are_not_touched_by_a_scene_that_is_refused(self):
        self.run_scene(SCENE)
        before = snapshot(self.folder / "out")
        for wrong in ({"friction_coefficient": -1}, {"history_points": "1,1"}, {"fields_times": "9", "fields_every": None}):
            self.assert_refused("slide", self.slide(*arguments_of({**SCENE, **wrong})), (), 1)
        self.assertEqual(snapshot(self.folder / "out"), before)


class Cadence(InFolder):
    def rows(self):
        """The steps of the rows of contact.h5."""
        return [int(round(t / LONG["time_step"])) for t in datasets(self.folder / "out" / "contact.h5")["time"]]

    def run_facts(self):
        return yaml.safe_load((self.folder / "out" / "run.yaml").read_text())

    def test_of_contact_that_was_auto_stays_with_a_later_end(self):
        self.run_scene(LONG, contact_every="auto")
        self.assertEqual(self.run_facts()["run"]["contact_every"], 40)
        outcome = self.slide("-restart", "out", "-time_end", 8e-6)
        self.assertEqual(outcome.codes, [0])
        facts = self.run_facts()
        self.assertEqual((facts["contact_every"], facts["run"]["contact_every"]), ("auto", 40))
        self.assertEqual(self.rows(), list(range(0, 80001, 40)))

    def test_of_contact_that_is_auto_is_25_in_a_short_run(self):
        self.run_scene(SCENE, contact_every="auto")
        self.assertEqual(self.run_facts()["run"]["contact_every"], 25)

    def test_of_contact_that_is_made_auto_is_that_of_the_whole(self):
        self.run_scene(LONG, contact_every=50)
        outcome = self.slide("-restart", "out", "-time_end", 8e-6, "-contact_every", "auto")
        self.assertEqual(outcome.codes, [0])
        self.assertEqual(self.run_facts()["run"]["contact_every"], 80)
        self.assertEqual(self.rows(), [*range(0, 40000, 50), *range(40000, 80001, 80)])


class Elsewhere(InFolder):
    def test_restart_in_files_and_variables_of_petsc(self):
        self.run_scene(SCENE)
        (self.folder / "petsc.rc").write_text("-restart out\n")
        for ranks in (1, 2):
            for arguments, variable, place in (((), "-restart", "the variable PETSC_OPTIONS"),
                                               ((), "-restart out", "the variable PETSC_OPTIONS"),
                                               (("-options_file", "petsc.rc"), "", "'petsc.rc'")):
                with self.subTest(place, variable=variable, ranks=ranks):
                    self.variable = variable
                    outcome = self.slide(*arguments, ranks=ranks)
                    self.assert_refused("slide", outcome, (f"-restart stands in {place}", "give it on the command line"),
                                        ranks)

    def environment(self, **more):
        return super().environment(PETSC_OPTIONS=getattr(self, "variable", ""), **more)


class EarlySignal(InFolder):
    def test_leaves_the_folder_as_it_was(self):
        self.run_scene(SCENE)
        before = snapshot(self.folder / "out")
        block(self.folder / "large.msh", divisions=400)  # a second and more to read
        job = subprocess.Popen([SLIDE, *arguments_of({**SCENE, "mesh_file": "large.msh", "time_step": None})], cwd=self.folder,
                               env=self.environment(), stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                               stderr=subprocess.PIPE, text=True)
        self.wait_until_caught(job.pid, signal.SIGUSR1)
        job.send_signal(signal.SIGUSR1)
        _, err = job.communicate(timeout=60)
        self.assertEqual(job.returncode, 3, err)
        self.assertIn("interrupted by SIGUSR1 before the first step; no file was touched", err)
        self.assertEqual(snapshot(self.folder / "out"), before)

    def wait_until_caught(self, pid, number):
        """By the process's own handler, which is there before it reads the mesh."""
        deadline = time.monotonic() + 60
        while time.monotonic() < deadline:
            status = Path(f"/proc/{pid}/status").read_text()
            caught = next(line.split()[1] for line in status.splitlines() if line.startswith("SigCgt"))
            if int(caught, 16) >> (number - 1) & 1:
                return
            time.sleep(0.002)
        self.fail("the signal is not asked for within a minute")


if __name__ == "__main__":
    unittest.main()
