"""Limits of the system, and folders that are taken away, shared, or not to be written to."""

import os
import resource
import shutil
import subprocess
import time
import unittest

from faulty import SCENE, Faults, block

RANKS = (1, 2)


class WhileRunning(Faults):
    def wait_for(self, path):
        deadline = time.monotonic() + 60
        while not path.exists():
            self.assertLess(time.monotonic(), deadline, f"no {path.name} for a minute")
            time.sleep(0.02)


class Limits(WhileRunning):
    """Set while the job runs, on the rank that writes."""

    def limited(self, scene, ranks, limit, value):
        job = self.start(scene, ranks)
        self.wait_for(self.folder / "out" / "fields.xdmf")
        process = self.processes()[0]
        resource.prlimit(process, limit, (value, resource.prlimit(process, limit)[1]))
        return self.finish(job)

    def check(self, limit, value, words):
        for ranks in RANKS:
            whole = self.reference(SCENE, ranks)
            code, err = self.limited(SCENE, ranks, limit, value)
            self.assertEqual(code, 1, err)
            self.assertRegex(err, rf"\Aslide: out/\S+ cannot be written: [^\n]*{words}; see that -output_folder")
            self.check_left(self.folder / "out", whole)
            shutil.rmtree(self.folder / "out")

    def test_of_file_size(self):
        self.check(resource.RLIMIT_FSIZE, 300000, "File too large")

    def test_of_handles(self):
        self.check(resource.RLIMIT_NOFILE, 5, "Too many open files")


class Folders(WhileRunning):
    def test_removed_while_running(self):
        for ranks in RANKS:
            job = self.start(SCENE, ranks)
            self.wait_for(self.folder / "out" / "fields.xdmf")
            (self.folder / "out").rename(self.folder / "gone")
            shutil.rmtree(self.folder / "gone")
            code, err = self.finish(job)
            self.assertEqual(code, 1, err)
            self.assertRegex(err, r"slide: out/\S+ cannot be written: [^\n]*No such file or directory; ")
            self.assertFalse((self.folder / "out").exists())

    def test_another_in_its_place(self):
        """What lies there is left alone."""
        job = self.start(SCENE)
        self.wait_for(self.folder / "out" / "fields.xdmf")
        (self.folder / "out").rename(self.folder / "gone")
        (self.folder / "out").mkdir()
        (self.folder / "out" / "notes").write_text("mine")
        code, err = self.finish(job)
        self.assertEqual((self.folder / "out" / "notes").read_text(), "mine")
        self.assertEqual(code, 1, err)

    def test_two_runs_at_the_same_moment(self):
        whole = self.reference(SCENE)
        for _ in range(3):
            jobs = [self.start(SCENE) for _ in range(2)]
            ends = sorted(self.finish(job) for job in jobs)
            self.assertEqual([code for code, _ in ends], [0, 2])
            self.assertEqual(ends[0][1], "")
            self.assertRegex(ends[1][1], r"\Aslide: -output_folder 'out' belongs to a run that still goes on")
            self.check_left(self.folder / "out", whole)
            shutil.rmtree(self.folder / "out")

    def test_input_changed_while_running(self):
        """It was read once, at the start."""
        whole = self.reference(SCENE)
        job = self.start(SCENE)
        self.wait_for(self.folder / "out" / "history.h5")
        block(self.folder / "block.msh", divisions=4)
        self.assertEqual(self.finish(job), (0, ""))
        self.check_left(self.folder / "out", whole)

    def test_read_only(self):
        disk = self.folder / "disk"
        disk.mkdir()
        mount = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=2m", "tmpfs", disk], capture_output=True)
        if mount.returncode != 0:
            self.skipTest("no disk can be mounted here")
        self.addCleanup(subprocess.run, ["umount", "-l", disk], check=True)
        subprocess.run(["mount", "-o", "remount,ro", disk], check=True)
        for ranks in RANKS:
            code, err = self.run_job({**SCENE, "output_folder": "disk/out"}, ranks)
            self.assertEqual(code, 2, err)
            self.assertRegex(err, r"\Aslide: -output_folder 'disk/out' cannot be [^\n]*Read-only file system[^\n]*\n")

    def test_read_only_from_some_moment_on(self):
        if os.geteuid() == 0 and subprocess.run(["setpriv", "--version"], capture_output=True).returncode != 0:
            self.skipTest("root may write everywhere")
        for path in (self.folder, self.folder / "block.msh"):
            os.chmod(path, 0o777)
        as_nobody = ["setpriv", "--reuid=65534", "--clear-groups"] if os.geteuid() == 0 else []
        job = self.start(SCENE, before=as_nobody)
        self.wait_for(self.folder / "out" / "fields.xdmf")
        os.chmod(self.folder / "out", 0o555)
        self.addCleanup(os.chmod, self.folder / "out", 0o777)
        code, err = self.finish(job)
        self.assertEqual(code, 1, err)
        self.assertRegex(err, r"\Aslide: out/\S+ cannot be written: [^\n]*Permission denied; see that -output_folder")


if __name__ == "__main__":
    unittest.main()
