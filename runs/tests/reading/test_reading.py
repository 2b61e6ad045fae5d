"""Reading of complete, growing and broken output folders."""

import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import h5py
import numpy as np

from slipscale.reading import ContactHistory, Fields, History, Summary, UnreadableRun
from tests import fake_run

# Grows /time alone, keeps the file open and locked, says so, and waits to be told to go.
WRITER = """
import sys, h5py
with h5py.File(sys.argv[1], "r+") as file:
    file["time"].resize(len(file["time"]) + 7, axis=0)
    file.flush()
    print("open", flush=True)
    sys.stdin.read()
"""


class Folder(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)


class CompleteRun(Folder):
    def setUp(self):
        super().setUp()
        fake_run.write_run(self.folder, end=1e-4)

    def test_history(self):
        history = History(self.folder)
        rows = len(history.time)
        self.assertEqual(rows, 2000)
        self.assertEqual(history.friction.shape, (rows,))
        self.assertEqual(set(history.boundary), {"top"})
        self.assertEqual(set(history.boundary["top"]), {"normal_force", "tangential_force"})
        self.assertIn("drive_power", history.surface)
        self.assertIn("impact_loss", history.energy)
        self.assertEqual(len(history.points), 1)
        self.assertEqual(history.points[0].stress.shape, (rows, 3))
        self.assertEqual(list(history.points[0].x), [fake_run.SIDE / 2, 0])

    def test_mean_friction_is_the_ratio_of_means(self):
        history, rows = History(self.folder), slice(1000, 2000)
        forces = history.boundary["top"]
        expected = forces["tangential_force"][rows].mean() / forces["normal_force"][rows].mean()
        self.assertEqual(history.mean_friction("top", rows), expected)

    def test_contact(self):
        with ContactHistory(self.folder) as contact:
            self.assertEqual(contact.x.shape, (121,))
            self.assertEqual(contact.read("status", slice(10, 50, 4)).shape, (10, 121))
            self.assertEqual(contact.read("u").shape, (2000, 121, 2))
            with self.assertRaisesRegex(UnreadableRun, "no dataset wear"):
                contact.read("wear")

    def test_summary(self):
        summary = Summary(self.folder)
        self.assertEqual(summary.number("friction_coefficient"), 0.5)
        self.assertIsNone(summary.number("history_boundary"))
        self.assertEqual(summary.measured_boundary(History(self.folder)), "top")
        self.assertEqual(summary.headline["friction_mean"], fake_run.FRICTION)

    def test_load_is_measured_at_the_top_unless_told_otherwise(self):
        with h5py.File(self.folder / "history.h5", "a") as file:
            file.copy("boundary/top", "boundary/bottom")  # comes first
        summary, history = Summary(self.folder), History(self.folder)
        summary.options.pop("history_boundary")
        self.assertEqual(summary.measured_boundary(history), "top")
        summary.options["history_boundary"] = "bottom"
        self.assertEqual(summary.measured_boundary(history), "bottom")

    def test_number_that_yaml_takes_for_text(self):
        (self.folder / "run.yaml").write_text("material_matrix_young: 30e9\n")
        self.assertEqual(Summary(self.folder).number("material_matrix_young"), 30e9)


class Meshes(Folder):
    def test_all_kinds_of_cells_cover_the_block(self):
        for kind in ("triangles", "quadrilaterals", "mixed"):
            with self.subTest(kind):
                fake_run.write_fields(self.folder, [0.0, 1e-4], kind)
                with Fields(self.folder) as fields:
                    a, b, c = (fields.coordinates[fields.triangles[:, k]] for k in range(3))
                    area = 0.5 * np.cross(b - a, c - a)
                    self.assertGreater(area.min(), 0)
                    self.assertAlmostEqual(area.sum() / fake_run.SIDE**2, 1, delta=1e-12)
                    self.assertEqual(fields.cell_of_triangle.max() + 1, len(fields.region))
                    self.assertEqual(fields.read("stress").shape, (len(fields.region), 3))


class GrowingRun(Folder):
    def test_file_held_open_and_locked_by_its_writer(self):
        fake_run.write_history(self.folder, np.arange(100) * 5e-8)
        locked = dict(os.environ, HDF5_USE_FILE_LOCKING="TRUE")
        with subprocess.Popen([sys.executable, "-c", WRITER, str(self.folder / "history.h5")], env=locked, text=True,
                              stdin=subprocess.PIPE, stdout=subprocess.PIPE) as writer:
            try:
                self.assertEqual(writer.stdout.readline(), "open\n")
                history = History(self.folder)
            finally:
                writer.communicate()
        self.assertEqual(len(history.time), 100)  # the rows that all datasets have
        self.assertEqual(len(history.points[0].u), 100)

    def test_contact_rows_of_the_shortest_dataset(self):
        fake_run.write_contact(self.folder, np.arange(100) * 5e-8)
        with h5py.File(self.folder / "contact.h5", "r+") as file:
            file["status"].resize(64, axis=0)
        with ContactHistory(self.folder) as contact:
            self.assertEqual((contact.rows, len(contact.time), len(contact.read("u"))), (64, 64, 64))

    def test_frame_without_its_time(self):
        fake_run.write_fields(self.folder, [0.0, 1e-4], "triangles")
        with h5py.File(self.folder / "fields.h5", "r+") as file:
            del file["time"]
            file["time"] = [0.0]
        with Fields(self.folder) as fields:
            self.assertEqual(list(fields.time), [0.0])
            fields.read("stress")

    def test_no_summary_yet(self):
        self.assertEqual(Summary(self.folder).headline, {})


class BrokenRun(Folder):
    def test_each_says_what_is_wrong(self):
        for reader, file in ((History, "history.h5"), (ContactHistory, "contact.h5"), (Fields, "fields.h5")):
            with self.subTest(file):
                with self.assertRaisesRegex(UnreadableRun, f"There is no {file} in"):
                    reader(self.folder)
                (self.folder / file).write_bytes(b"not HDF5")
                with self.assertRaisesRegex(UnreadableRun, "cannot be read"):
                    reader(self.folder)

    def test_history_without_rows(self):
        fake_run.write_history(self.folder, np.empty(0))
        with self.assertRaisesRegex(UnreadableRun, "no rows yet"):
            History(self.folder)


if __name__ == "__main__":
    unittest.main()
