"""What becomes of a run whose output folder fails it: a full disk, a folder in use, taken away or with a long name."""

import re
import resource
import shutil
import signal
import subprocess
import time
import unittest

import numpy as np
import yaml
from running import MPIEXEC, SLIDE, InScratch, arguments_of, datasets, h5py
from scenes import SQUEAL, block

SCENE = {**SQUEAL, "time_end": 4e-6, "time_step": 2e-8}  # 200 steps
FOR_HOURS = {**SQUEAL, "time_end": 100, "history_every": 20, "contact_every": 1000}
RANKS = (1, 2)


class InBlock(InScratch):
    def setUp(self):
        super().setUp()
        block(self.folder / "block.msh")

    def start(self, scene, ranks):
        command = [SLIDE] if ranks == 1 else [MPIEXEC, "-n", str(ranks), SLIDE]
        job = subprocess.Popen([*command, *arguments_of(scene)], cwd=self.folder, env=self.environment(), text=True,
                               stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.addCleanup(self.end, job)
        return job

    def end(self, job):
        if job.poll() is None:
            job.send_signal(signal.SIGTERM)  # mpiexec then ends the ranks
        job.communicate()

    def wait_for(self, path):
        deadline = time.monotonic() + 60
        while not path.exists():
            self.assertLess(time.monotonic(), deadline, f"no {path.name} for a minute")
            time.sleep(0.05)


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
        _, err = job.communicate(timeout=60)
        self.assertEqual(job.returncode, 1, err)
        self.assertRegex(err, rf"slide: out/{file} cannot be written: (flushing: )?File too large; see that -output_folder is writable")
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
        """It once left both ranks waiting; only the first writes."""
        job = self.limited({**FOR_HOURS, "time_end": 60e-6, "fields_every": 10}, 2, 1)
        _, err = job.communicate(timeout=60)
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
            for scene in ({"fields_every": 1}, {"history_every": 1, "contact_every": 1, "time_end": 80e-6}):
                with self.subTest(kind=kind, ranks=ranks, **scene):
                    outcome = self.slide(*arguments_of({**SCENE, **scene, "output_folder": f"{kind}/out"}), ranks=ranks)
                    self.assertEqual(outcome.codes, [1] * ranks, outcome.err)
                    self.assertRegex(outcome.err, r"slide: \S+ cannot be written: No space left on device; see that -output")
                    self.assertNotIn("egmentation", outcome.err)
                    contact = datasets(disk / "out" / "contact.h5")
                    self.assertEqual(len({len(contact[name]) for name in ("time", "u", "gap", "status")}), 1)
                    history = datasets(disk / "out" / "history.h5")
                    every = scene.get("history_every", SCENE["history_every"])
                    np.testing.assert_array_equal(history["step"], every * np.arange(len(history["step"])))
                    # Of a batch that does not fit the first rows are kept, so that one file or the other fills the disk.
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


class InUse(InBlock):
    def test_a_second_run_is_refused_and_a_killed_one_is_in_nobodys_way(self):
        for ranks in RANKS:
            job = self.start(FOR_HOURS, ranks)
            self.wait_for(self.folder / "out" / "history.h5")
            outcome = self.slide(*arguments_of(SCENE), ranks=ranks)
            self.assert_refused("slide", outcome, ["-output_folder 'out' belongs to a run that still goes on (process ",
                                                   "; wait for it or give another folder"], ranks)
            if ranks == 1:
                job.kill()
            else:
                holder = int(re.search(r"process (\d+)", outcome.err)[1])
                subprocess.run(["kill", "-9", str(holder)], check=True)
            job.communicate()
            self.assertTrue((self.folder / "out" / ".slipscale-lock").exists())
            self.run_scene(SCENE, ranks=ranks)
            self.assertFalse((self.folder / "out" / ".slipscale-lock").exists())
            shutil.rmtree(self.folder / "out")

    def test_removed_while_running(self):
        for ranks in RANKS:
            job = self.start(FOR_HOURS, ranks)
            self.wait_for(self.folder / "out" / "history.h5")
            shutil.rmtree(self.folder / "out", ignore_errors=True)
            shutil.rmtree(self.folder / "out", ignore_errors=True)
            _, err = job.communicate(timeout=60)
            self.assertNotEqual(job.returncode, 0)
            self.assertRegex(err, r"slide: out/(history|contact).h5 cannot be written: .*No such file or directory; ")
            if ranks == 1:
                self.assertEqual(job.returncode, 1)


class LongNames(InBlock):
    def test_a_path_of_500_characters(self):
        folder = "/".join(letter * 120 for letter in "abcd")
        for ranks in RANKS:
            self.run_scene({**SCENE, "fields_every": 50}, ranks=ranks, output_folder=folder)
            self.assertEqual(len(datasets(self.folder / folder / "fields.h5")["time"]), 5)


class Contents(InBlock):
    def test_every_file_says_where_it_comes_from(self):
        self.run_scene({**SCENE, "fields_every": 50, "statistics_from": 1e-6}, ranks=2)
        facts = yaml.safe_load((self.folder / "out" / "run.yaml").read_text())["run"]
        for name in ("history.h5", "contact.h5", "fields.h5", "statistics.h5"):
            with h5py.File(self.folder / "out" / name) as file:
                said = {key: value.decode() if isinstance(value, bytes) else value for key, value in file.attrs.items()}
            self.assertEqual((said["program"], said["version"], said["ranks"]), ("slide", str(facts["version"]), 2), name)
            self.assertEqual(said["mesh_checksum"], facts["mesh_checksum"], name)
            self.assertRegex(said["date"], r"\A\d{4}-\d\d-\d\dT\d\d:\d\d:\d\dZ\Z")

    def test_contact(self):
        """Gap, vertical velocity and strength, against what the run itself says elsewhere."""
        self.run_scene({**SCENE, "contact_every": 1})
        contact = datasets(self.folder / "out" / "contact.h5")
        self.assertEqual(np.abs(contact["y"]).max(), 0)
        np.testing.assert_array_equal(contact["gap"], contact["u"][:, :, 1])  # the surface is at the bottom
        # v_n = (u_{n+1} - u_{n-1})/2Δt to the order of the scheme (beta2 = 1/2), where nothing hits the surface.
        centred = (contact["u"][2:, :, 1] - contact["u"][:-2, :, 1]) / (2 * 2e-8)
        stays = (contact["status"][:-2] == 0) & (contact["status"][1:-1] == 0) & (contact["status"][2:] == 0)
        self.assertGreater(stays.sum(), 20)
        np.testing.assert_allclose(contact["v_y"][1:-1][stays], centred[stays], rtol=0,
                                   atol=0.02 * np.abs(centred).max())
        touching = contact["status"] > 0
        self.assertTrue(np.all(contact["strength"][~touching] == 0))
        slipping = contact["status"] == 2
        self.assertTrue(np.any(slipping))
        # Regularised threshold: in slip the traction is the strength.
        np.testing.assert_allclose(np.abs(contact["tangential_traction"][slipping]), contact["strength"][slipping],
                                   rtol=1e-12)

    def test_stress_across_the_plane(self):
        """Regions with different Poisson's ratio: zz, von Mises and the principal stresses from the components."""
        block(self.folder / "two.msh", regions=("matrix", "inclusion"))
        self.run_scene({**SCENE, "mesh_file": "two.msh", "material_inclusion_young": 80e9,
                        "material_inclusion_poisson": 0.4, "material_inclusion_density": 1800, "fields_times": "4e-6",
                        "fields_quantities": "stress,von_mises,principal"}, ranks=2)
        fields = datasets(self.folder / "out" / "fields.h5")
        frame = {name[len("frames/00000/"):]: values for name, values in fields.items() if name.startswith("frames")}
        with h5py.File(self.folder / "out" / "fields.h5") as file:
            names = [name.decode() for name in file["mesh/region"].attrs["names"]]
        poisson = np.array([0.4 if name == "inclusion" else 0.25 for name in names])[fields["mesh/region"]]
        xx, yy, xy = frame["stress"].T
        zz = poisson * (xx + yy)
        np.testing.assert_allclose(frame["stress_zz"], zz, rtol=1e-12)
        tensor = np.zeros((len(xx), 3, 3))
        tensor[:, 0, 0], tensor[:, 1, 1], tensor[:, 2, 2] = xx, yy, frame["stress_zz"]
        tensor[:, 0, 1] = tensor[:, 1, 0] = xy
        np.testing.assert_array_equal(frame["stress_tensor"], tensor)
        deviator = tensor - np.trace(tensor, axis1=1, axis2=2)[:, None, None] * np.eye(3) / 3
        scale = np.abs(tensor).max()
        np.testing.assert_allclose(frame["von_mises"], np.sqrt(1.5 * np.sum(deviator**2, axis=(1, 2))), atol=1e-12 * scale)
        low, high = np.linalg.eigvalsh(tensor[:, :2, :2]).T
        np.testing.assert_allclose(frame["principal_high"], high, atol=1e-12 * scale)
        np.testing.assert_allclose(frame["principal_low"], low, atol=1e-12 * scale)
        shown = (self.folder / "out" / "fields.xdmf").read_text()
        self.assertIn('Name="stress" AttributeType="Tensor"', shown)

    def test_thousands_of_points(self):
        """They start in seconds, and the size that is forecast is that of the file."""
        rng = np.random.default_rng(1)
        points = np.round(rng.uniform(0, 5e-3, (3000, 2)), 7)
        (self.folder / "points.yaml").write_text(f"history_points: [{','.join(f'{x:.7f}' for x in points.ravel())}]\n")
        scene = {"options_file_yaml": "points.yaml", **SCENE, "history_points": None}
        before = resource.getrusage(resource.RUSAGE_CHILDREN)
        outcome = self.run_scene(scene)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        self.assertLess(after.ru_utime - before.ru_utime + after.ru_stime - before.ru_stime, 20)  # s of work
        number, unit = re.search(r"output ([\d.]+) (kB|MB|GB)", outcome.out).groups()
        size = sum(file.stat().st_size for file in (self.folder / "out").iterdir() if file.suffix == ".h5")
        self.assertAlmostEqual(float(number) * {"kB": 1e3, "MB": 1e6, "GB": 1e9}[unit] / size, 1, delta=0.25)


class Cadences(InBlock):
    def test_in_seconds(self):
        outcome = self.run_scene({**SCENE, "history_every": None, "history_interval": 1.01e-7, "contact_interval": 4e-7,
                                  "fields_interval": 1e-6})
        self.assertIn("a row of history.h5 every 5 steps (100.0 ns), of contact.h5 every 20 steps (400.0 ns), a frame "
                      "of fields.h5 every 50 steps (1.000 µs)", outcome.out)
        for file, step in (("history.h5", 1e-7), ("contact.h5", 4e-7), ("fields.h5", 1e-6)):
            times = datasets(self.folder / "out" / file)["time"]
            np.testing.assert_allclose(times, step * np.arange(len(times)), rtol=1e-12, atol=1e-20)
            self.assertAlmostEqual(times[-1], 4e-6, delta=1e-15)
        # What the run leaves is a scene.
        self.run_scene({"options_file_yaml": "out/run.yaml", "output_folder": "again"})
        self.assertEqual(len(datasets(self.folder / "again" / "history.h5")["time"]), 41)

    def test_averages_of_the_second_half_have_errors(self):
        self.run_scene(SCENE, history_every=1)
        history = datasets(self.folder / "out" / "history.h5")
        summary = yaml.safe_load((self.folder / "out" / "summary.yaml").read_text())
        late = history["time"] >= 0.5 * history["time"][-1]
        normal, tangential = (history[f"boundary/top/{kind}_force"][late] for kind in ("normal", "tangential"))
        self.assertAlmostEqual(summary["averages_from"], history["time"][late][0], delta=1e-12)
        self.assertEqual(summary["averages_rows"], late.sum())
        load = summary["load"]
        self.assertAlmostEqual(load["mean_friction"] / (tangential.mean() / normal.mean()), 1, delta=1e-5)

        def error(values, blocks):
            length = len(values) // blocks
            means = values[len(values) - blocks * length:].reshape(blocks, length).mean(axis=1)
            return means.std(ddof=1) / np.sqrt(blocks)

        rest = (tangential - tangential.mean() / normal.mean() * normal) / normal.mean()
        self.assertAlmostEqual(load["mean_friction_error"] / max(error(rest, 5), error(rest, 10)), 1, delta=1e-5)
        self.assertAlmostEqual(load["mean_normal_force_error"] / max(error(normal, 5), error(normal, 10)), 1, delta=1e-5)
        self.assertIs(load["settled"], False)  # four microseconds of a block that is being pressed down
        self.assertIn(summary["contact"]["regime"], ("slip", "stick-slip", "slip-separated", "stick-slip-separated"))

    def test_rows_too_sparse_are_noticed(self):
        """Rows further apart than half a period of the strongest vibration."""
        scene = {**SCENE, "time_end": 1e-3, "history_points": None, "contact_every": 1000}
        dense = self.run_scene(scene, history_every=1).out
        self.assertNotIn("alias", dense)
        summary = yaml.safe_load((self.folder / "out" / "summary.yaml").read_text())
        strongest = summary["spectrum_peaks"][0]
        every = int(np.ceil(0.8 / strongest / 2e-8))  # less than two rows in a period
        self.run_scene(scene, history_every=every, output_folder="sparse")
        summary = yaml.safe_load((self.folder / "sparse" / "summary.yaml").read_text())
        self.assertIn("may be an alias of", summary["aliases"])


if __name__ == "__main__":
    unittest.main()
