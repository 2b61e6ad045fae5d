"""What `relocalize` finds: at the tiles of a periodic cell, for one material, next to the contact, of a part of the
block, and in bounded memory. Its files and the comparison with the heterogeneous run: test_relocalize_comparison.py."""

import os
import subprocess
import unittest
from pathlib import Path

import numpy as np
from drawing import LAYERS
from homogenising import RUN as MICRO
from homogenising import SIDE as PERIOD
from relocalizing import (CELL, COMPARED, COMPONENTS, HOMOGENEOUS, MATERIALS, POINTS, RELOCALIZE, RUN, Relocalising,
                          apply, areas_of, centres_of, concentration_of, frames_of, macro_grid, write_fields)
from running import arguments_of
from scenes import SIDE, block

ROUNDING = 1e-11  # of the largest value; patch recovery extrapolates to the edges
SOLVER = 1e-9  # ten times homogenize's tolerance, relative
# Stiff and soft columns that end at the contact.
COLUMNS = {**LAYERS, "block_width": SIDE, "block_height": SIDE, "layer_period": SIDE / 2, "fraction": 0.5, "angle": 90,
           "size": SIDE / 16, "output_folder": "drawn"}


class MadeUpRuns(Relocalising):
    """The strain of the macro cells is known, and the tensors are those of a periodic cell of discs."""

    WIDTH, HEIGHT, COLUMNS, ROWS = 2.3e-3, 1.9e-3, 9, 7
    ORIGIN = np.array([0.37e-3, -0.21e-3])
    TIMES = np.array([1e-6, 2.5e-6, 3e-6])
    AT_ORIGIN = {"relocalize_origin": "0.37e-3,-0.21e-3"}
    CONSTANT, ALONG_X, ALONG_Y = np.array([[2, -5, 3], [300, 700, -900], [-800, 400, 500]]) * 1e-5

    def setUp(self):
        super().setUp()
        self.draw_cell(self.folder / "cell.msh")
        self.run_cell(MICRO, output_folder="cell")
        self.tensors = self.local("cell", "localization.h5")

    def linear(self, x):
        """[..., 3] at [..., 2] m."""
        return self.CONSTANT + x[..., :1] / PERIOD * self.ALONG_X + x[..., 1:] / PERIOD * self.ALONG_Y

    def write_run(self, strain):
        """A frame for each time, with the strain times the frame's number, from 1."""
        points, cells = macro_grid(self.WIDTH, self.HEIGHT, self.COLUMNS, self.ROWS)
        strains = strain(points[cells].mean(axis=1))
        write_fields(self.folder / "homogeneous", points, cells, self.TIMES,
                     [(k + 1) * strains for k in range(len(self.TIMES))])

    def micro_cells(self, x):
        """Those whose copies have their centres at x."""
        inner = np.mod(x - self.ORIGIN, PERIOD)
        distance = np.linalg.norm(inner[:, None] - centres_of(self.tensors)[None], axis=2)
        np.testing.assert_array_less(distance.min(axis=1), 1e-9 * PERIOD)
        return distance.argmin(axis=1)

    def test_are_those_of_numpy_at_the_tiles(self):
        self.write_run(self.linear)
        h = np.array([self.WIDTH / self.COLUMNS, self.HEIGHT / self.ROWS])
        for recovery in ("element", "nodal"):
            with self.subTest(recovery):
                self.run_relocalize(**self.AT_ORIGIN, relocalize_recovery=recovery)
                found = self.local()
                x = centres_of(found)
                micro = self.micro_cells(x)
                strain = self.linear((np.floor(x / h) + 0.5) * h if recovery == "element" else x)
                np.testing.assert_array_equal(found["time"], self.TIMES)
                np.testing.assert_array_equal(found["mesh/region"], self.tensors["cell/region"][micro])
                for k in range(len(self.TIMES)):
                    macro = (k + 1) * strain
                    expected = {"strain": apply(self.tensors["cell/localisation"][micro], macro),
                                "stress": apply(concentration_of(self.tensors)[micro], macro),
                                "homogeneous_stress": macro @ self.tensors["effective/stiffness"].T}
                    for name, rows in expected.items():
                        self.assert_close(found[f"frames/{k:05d}/{name}"], rows, ROUNDING, name)

    def test_tiles_are_clipped_to_the_block(self):
        self.write_run(self.linear)
        self.run_relocalize(**self.AT_ORIGIN)
        found = centres_of(self.local())
        shifts = self.ORIGIN + PERIOD * np.array([(i, j) for i in range(-2, 5) for j in range(-2, 5)])
        copies = (shifts[:, None] + centres_of(self.tensors)[None]).reshape(-1, 2)
        inside = copies[np.all((copies > 0) & (copies < [self.WIDTH, self.HEIGHT]), axis=1)]
        self.assertEqual(found.shape, inside.shape)
        by_place = [rows[np.lexsort(np.round(rows / (1e-6 * PERIOD)).T)] for rows in (found, inside)]
        self.assert_close(*by_place, 1e-12)

    def test_mean_over_a_whole_cell(self):
        """<σ> = C_eff : E."""
        self.write_run(lambda x: np.broadcast_to(self.CONSTANT, (len(x), 3)))
        self.run_relocalize(**self.AT_ORIGIN)
        found = self.local()
        tile = np.floor((centres_of(found) - self.ORIGIN) / PERIOD)
        whole = np.all(tile == [0, 1], axis=1)
        self.assertEqual(whole.sum(), len(self.tensors["cell/region"]))
        mean = np.average(found["frames/00000/stress"][whole], axis=0, weights=areas_of(found)[whole])
        self.assert_close(mean, self.tensors["effective/stiffness"] @ self.CONSTANT, SOLVER)
        self.assertGreater(np.ptp(found["frames/00000/stress"][whole, 1]), 0.1 * abs(mean[1]))


@unittest.skipIf(b"__asan_init" in Path(RELOCALIZE).read_bytes(), "the sanitizer keeps what was freed")
class Memory(Relocalising):
    """One frame is in memory at a time, also where it is compared."""

    PERIODS, FEW, MANY = 10, 4, 40

    def peak(self, **changes):
        """Of the resident memory of a run, bytes."""
        with subprocess.Popen([RELOCALIZE, *arguments_of({**RUN, **changes})], cwd=self.folder,
                              env=self.environment(), stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL) as running:
            _, status, usage = os.wait4(running.pid, 0)
            running.returncode = os.waitstatus_to_exitcode(status)
        self.assertEqual(running.returncode, 0)
        return 1024 * usage.ru_maxrss

    def test_frames_are_streamed(self):
        self.draw_cell(self.folder / "cell.msh")
        self.run_cell(MICRO, output_folder="cell")
        points, cells = macro_grid(self.PERIODS * PERIOD, self.PERIODS * PERIOD, 5, 5)
        for name, count in (("few", self.FEW), ("many", self.MANY)):
            write_fields(self.folder / name, points, cells, np.arange(count) * 1e-6,
                         1e-5 * np.random.default_rng(1).standard_normal((count, len(cells), 3)))
        # What was relocalised is laid out as a run's frames: it serves as the heterogeneous run.
        self.run_relocalize(relocalize_run="many")
        (self.folder / "out" / "relocalized.h5").rename(self.folder / "out" / "fields.h5")
        compared = {**COMPARED, "relocalize_reference": "out", "output_folder": "again", **POINTS}
        few, many = (self.peak(relocalize_run=name, **compared) for name in ("few", "many"))
        self.assertEqual(len(self.comparison("again")["frames"]["time"]), self.MANY)
        self.assertLess(self.comparison("again")["error"]["all"]["yy"]["relocalised"], 1e-12)
        frame = sum(self.local("again")[f"frames/00000/{name}"].nbytes
                    for name in ("stress", "strain", "homogeneous_stress"))
        self.assertGreater(frame, 1e6)  # beside which what the system does with memory is little
        self.assertLess(many - few, 4 * frame)


class OneMaterial(Relocalising):
    def test_is_the_run_itself(self):
        block(self.folder / "block.msh", cells="mixed", regions=("matrix", "inclusion"))
        same = {name: value for name, value in MATERIALS.items() if "matrix" in name}
        same = {**same, **{name.replace("matrix", "inclusion"): value for name, value in same.items()}}
        self.run_cell({**CELL, **same})
        self.run_scene({**HOMOGENEOUS, **same, "material_file": None})
        for ranks in (1, 2):
            self.run_relocalize(relocalize_recovery="element", ranks=ranks)
            found, run = self.local(), self.local("homogeneous", "fields.h5")
            np.testing.assert_array_equal(centres_of(found), centres_of(run))
            for quantity, source in (("stress", "stress"), ("strain", "strain"), ("homogeneous_stress", "stress")):
                self.assert_close(frames_of(found, quantity), frames_of(run, source), 1e-10, quantity)
            self.assertGreater(np.abs(frames_of(run, "stress")).max(), 1e6)


class Contact(Relocalising):
    """Columns: where they end at the rigid surface the tensors are wrong, and the correction helps."""

    STRIP = 3e-3  # of which the lower half is replaced

    def test_the_strip_comes_nearer(self):
        self.draw(COLUMNS)
        (self.folder / "drawn" / "mesh.msh").rename(self.folder / "block.msh")
        self.make_runs()
        self.run_relocalize(**COMPARED, output_folder="plain")
        self.run_relocalize(**COMPARED, relocalize_correction="strip", relocalize_strip=self.STRIP)
        plain, corrected = self.comparison("plain")["error"], self.comparison()["error"]
        for component in COMPONENTS:
            self.assertLess(corrected["layer"][component]["relocalised"], plain["layer"][component]["relocalised"])
        # Along the surface, of which the tensors know nothing, the error is largest.
        self.assertLess(corrected["layer"]["xx"]["relocalised"], 0.5 * plain["layer"]["xx"]["relocalised"])
        # The columns share the pressure as they are stiff, and that the tensors know.
        for part in ("layer", "bulk", "all"):
            self.assertLess(plain[part]["yy"]["relocalised"], 0.25 * plain[part]["yy"]["homogeneous"], part)
        self.assertEqual(corrected["layer"]["yy"]["homogeneous"], plain["layer"]["yy"]["homogeneous"])
        before, after = self.local("plain"), self.local()
        above = centres_of(after)[:, 1] > self.STRIP / 2
        for name in ("stress", "strain"):
            old, new = frames_of(before, name), frames_of(after, name)
            np.testing.assert_array_equal(new[:, above], old[:, above])
            self.assertTrue(np.any(new[-1, ~above] != old[-1, ~above]))


class OfAPart(Relocalising):
    """A homogeneous run that has saved a part of the block."""

    BOX = {"fields_box": "1e-3,0,4e-3,2e-3"}

    def relocalise_both(self, **changes):
        """Cells of the whole that lie in the box, and what the part gives."""
        self.run_relocalize(relocalize_recovery="element", **changes, output_folder="whole")
        self.run_relocalize(relocalize_recovery="element", **changes, relocalize_run="part", ranks=2)
        return ({file: self.local(folder, file) for file in ("relocalized.h5", "relocalized_statistics.h5")}
                for folder in ("whole", "out"))

    def check(self, whole, part):
        run = self.local("part", "fields.h5")
        low, high = (edge(corner, axis=0) for edge, corner in
                     ((np.min, run["mesh/coordinates"]), (np.max, run["mesh/coordinates"])))
        x = centres_of(whole["relocalized.h5"])
        inside = np.all((x > low) & (x < high), axis=1)
        self.assertTrue(0 < inside.sum() < len(inside))
        for file, names in (("relocalized.h5", [f"frames/00003/{name}" for name in ("stress", "strain")]),
                            ("relocalized_statistics.h5", ["statistics/stress/mean", "statistics/strain/covariance"])):
            order = [np.lexsort(np.round(centres_of(each[file]) / 1e-9).T) for each in (whole, part)]
            kept = order[0][inside[order[0]]]
            for name in names:
                np.testing.assert_array_equal(part[file][name][order[1]], whole[file][name][kept], err_msg=name)

    def test_is_relocalised_there(self):
        """By the tensors of the whole block, and of a cell that tiles it."""
        block(self.folder / "block.msh", regions=("matrix", "inclusion"), divisions=10)
        self.draw_cell(self.folder / "cell.msh")
        for tensors in ({"cell_boundary": "kubc"}, {"cell_boundary": "periodic", "mesh_file": "cell.msh"}):
            with self.subTest(**tensors):
                self.run_cell({**CELL, **tensors})
                self.run_scene(HOMOGENEOUS)
                self.run_scene(HOMOGENEOUS, **self.BOX, output_folder="part")
                self.check(*self.relocalise_both())

    def test_is_compared_there(self):
        """The layer and the bulk remain those of the whole block."""
        block(self.folder / "block.msh", regions=("matrix", "inclusion"), divisions=10)
        self.make_runs()
        self.run_scene(HOMOGENEOUS, **self.BOX, output_folder="part")
        self.run_relocalize(relocalize_run="part", **COMPARED)
        area = self.comparison()["area"]
        cells = len(self.local("part", "fields.h5")["mesh/cells"])
        self.assertEqual((cells, len(self.local()["mesh/cells"])), (24, 24))  # 6 columns, 4 rows
        # A row of cells is 0.5 mm high, and the sides are farther away than COMPARED's.
        self.assertAlmostEqual(area["layer"]["share"], 1 / 4)
        self.assertAlmostEqual(area["bulk"]["share"], 3 / 4)


if __name__ == "__main__":
    unittest.main()
