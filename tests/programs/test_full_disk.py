"""A full disk ends a run with exit code 1 on all ranks, and what was written stays readable."""

import resource
import shutil
import subprocess
import unittest

import numpy as np
from long_runs import FOR_HOURS, RANKS, SCENE, InBlock
from running import MPIEXEC, SECONDS, SLIDE, arguments_of, datasets
from scenes import block


class FullDisk(InBlock):
    """A limit on the size of files, set while the job runs (Open MPI itself would not start under it)."""

    def limited(self, scene, ranks, limited):
        """What becomes of the job once the rank of that number may write no file of more than 2 MB."""
        script = 'echo $$ > pid.${OMPI_COMM_WORLD_RANK:-0}; exec "$0" "$@"'
        command = [] if ranks == 1 else [MPIEXEC, "-n", str(ranks)]
        job = subprocess.Popen([*command, "bash", "-c", script, SLIDE, *arguments_of(scene)], cwd=self.folder,
                               env=self.environment(), text=True, stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                               stderr=subprocess.PIPE)
        self.addCleanup(self.end, job)
        self.wait_for(self.folder / "out" / "history.h5")
        process = int((self.folder / f"pid.{limited}").read_text())
        resource.prlimit(process, resource.RLIMIT_FSIZE, (2000000, resource.RLIM_INFINITY))
        return job

    def assert_stopped(self, job, file):
        _, err = job.communicate(timeout=SECONDS)
        self.assertEqual(job.returncode, 1, err)
        self.assertRegex(err, rf"slide: out/{file} cannot be written: (flushing: )?File too large; "
                              r"see that -output_folder is writable")
        for noise in ("PETSC ERROR", "what():", "Segmentation", "exited on signal", "MPI_ABORT"):
            self.assertNotIn(noise, err)

    def test_frames(self):
        block(self.folder / "fine.msh", divisions=32)
        scene = {**FOR_HOURS, "mesh_file": "fine.msh", "history_every": 1000, "fields_every": 20}
        for ranks in RANKS:
            self.assert_stopped(self.limited(scene, ranks, 0), "fields.h5")
            frames = len(datasets(self.folder / "out" / "fields.h5")["time"])
            shown = (self.folder / "out" / "fields.xdmf").read_text()
            self.assertEqual(shown.count("<Time "), frames)
            self.assertFalse((self.folder / "out" / "summary.yaml").exists())
            shutil.rmtree(self.folder / "out")

    def test_rows(self):
        for ranks in RANKS:
            job = self.limited({**FOR_HOURS, "history_every": 1000, "contact_every": 2}, ranks, 0)
            self.assert_stopped(job, "(history|contact).h5")
            contact = datasets(self.folder / "out" / "contact.h5")
            rows = len(contact["time"])
            self.assertTrue(np.all(np.diff(contact["time"]) > 0))
            self.assertEqual({len(contact[name]) for name in ("u", "gap", "status", "strength")}, {rows})
            shutil.rmtree(self.folder / "out")

    def test_of_another_rank_than_the_first(self):
        """Only the first writes; the limit of the other must not leave both waiting."""
        job = self.limited({**FOR_HOURS, "time_end": 60e-6, "fields_every": 10}, 2, 1)
        _, err = job.communicate(timeout=SECONDS)
        self.assertEqual((job.returncode, err), (0, ""))


class SmallDisk(InBlock):
    """Real ones, where this machine lets us mount them: tmpfs reserves room, ext2 without extents cannot."""

    def mounted(self, kind, kilobytes):
        disk = self.folder / kind
        disk.mkdir()
        if kind == "ext2":
            image = self.folder / "image"
            image.write_bytes(bytes(1024 * kilobytes))
            subprocess.run(["mkfs.ext2", "-q", "-F", image], capture_output=True, check=False)
            command = ["mount", "-o", "loop", image, disk]
        else:
            command = ["mount", "-t", kind, "-o", f"size={kilobytes}k", kind, disk]
        try:
            done = subprocess.run(command, capture_output=True)
        except FileNotFoundError as error:
            self.skipTest(str(error))
        if done.returncode != 0:
            self.skipTest(f"no {kind} can be mounted here")
        self.addCleanup(subprocess.run, ["umount", "-l", disk], check=True)
        return disk

    def check(self, kind):
        disk = self.mounted(kind, 1500)
        for ranks in RANKS:
            for scene in ({"fields_every": 1},
                          {"history_every": 1, "contact_every": 1, "contact_sums": "false", "time_end": 80e-6}):
                with self.subTest(kind=kind, ranks=ranks, **scene):
                    outcome = self.slide(*arguments_of({**SCENE, **scene, "output_folder": f"{kind}/out"}), ranks=ranks)
                    self.assertEqual(outcome.codes, [1] * ranks, outcome.err)
                    self.assertRegex(outcome.err, r"slide: \S+ cannot be written: No space left on device; see that "
                                                  "-output")
                    self.assertNotIn("egmentation", outcome.err)
                    contact = datasets(disk / "out" / "contact.h5")
                    self.assertEqual(len({len(contact[name]) for name in ("time", "u", "gap", "status")}), 1)
                    history = datasets(disk / "out" / "history.h5")
                    every = scene.get("history_every", SCENE["history_every"])
                    np.testing.assert_array_equal(history["step"], every * np.arange(len(history["step"])))
                    # Of a batch that does not fit the first rows are kept: one file or the other fills the disk.
                    self.assertGreater(len(history["step"]) + len(contact["time"]), 2)
                    if "fields_every" in scene:
                        frames = len(datasets(disk / "out" / "fields.h5")["time"])
                        shown = (disk / "out" / "fields.xdmf").read_text().count("<Time ")
                        self.assertIn(shown, (frames - 1, frames))  # none that is not there
                    shutil.rmtree(disk / "out")

    def test_that_reserves(self):
        self.check("tmpfs")

    def test_that_cannot_reserve(self):
        self.check("ext2")


if __name__ == "__main__":
    unittest.main()
