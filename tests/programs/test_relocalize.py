"""What `relocalize` finds and leaves behind: against numpy, the runs it comes from and the heterogeneous run, on any
number of ranks, as files."""

import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

import meshio
import numpy as np
from drawing import LAYERS
from homogenising import RUN as MICRO
from homogenising import SIDE as PERIOD
from relocalizing import (CELL, COMPARED, FILES, FRAMES, HETEROGENEOUS, HOMOGENEOUS, MATERIALS, RELOCALIZE, RUN,
                          Relocalising, areas_of, centres_of, concentration_of, frames_of, macro_grid, write_fields)
from running import arguments_of, datasets, snapshot
from scenes import SIDE, block

ROUNDING = 1e-11  # of the largest value; patch recovery extrapolates to the edges
PRINTED = 1e-5  # six digits
SOLVER = 1e-9  # ten times homogenize's tolerance, relative
COMPONENTS = ("xx", "yy", "xy")
PAIRS = [(0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1)]  # of a covariance
POINTS = {"relocalize_points": "2.6e-3,0.3e-3,1.3e-3,3.3e-3"}
# Stiff and soft columns that end at the contact.
COLUMNS = {**LAYERS, "block_width": SIDE, "block_height": SIDE, "layer_period": SIDE / 2, "fraction": 0.5, "angle": 90,
           "size": SIDE / 16, "output_folder": "drawn"}


def apply(tensors, rows):
    """[cells, 3, 3] and [cells, 3]"""
    return np.einsum("cij,cj->ci", tensors, rows)


def relative_error(values, reference, area):
    """Of each component; both [..., cells, 3]."""
    def size(rows):
        return np.sqrt(np.einsum("...c,...ci->...i", area, rows**2).reshape(-1, 3).sum(axis=0))
    with np.errstate(invalid="ignore", divide="ignore"):
        return size(values - reference) / size(reference)


def numbers_of(entry, path=""):
    """All numbers of a nested dict by path; the names of everything else."""
    if isinstance(entry, dict):
        return {name: value for key, inner in entry.items() for name, value in numbers_of(inner, f"{path}/{key}").items()}
    return {path: np.atleast_1d(entry)}


class Checks(Relocalising):
    def assert_close(self, found, expected, tolerance, name=""):
        """To a part of the largest value; nan where nan is expected."""
        found, expected = np.asarray(found), np.asarray(expected)
        scale = np.nanmax(np.abs(expected), initial=0)
        np.testing.assert_allclose(found, np.broadcast_to(expected, found.shape), rtol=0, atol=tolerance * scale,
                                   err_msg=name)


class MadeUpRuns(Checks):
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


class Memory(Checks):
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


class OneMaterial(Checks):
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


class Compared(Checks):
    """A heterogeneous block of layers and its homogenised twin, on the same mesh."""

    made = None  # the runs, made once

    def setUp(self):
        super().setUp()
        if self.made is None:
            self.make()
            temporary = tempfile.TemporaryDirectory()
            self.addClassCleanup(temporary.cleanup)
            type(self).made = Path(temporary.name)
            shutil.copytree(self.folder, self.made, dirs_exist_ok=True)
        else:
            shutil.copytree(self.made, self.folder, dirs_exist_ok=True)
        self.found, self.facts = self.local(), self.comparison()
        self.reference = self.local("heterogeneous", "fields.h5")
        self.area, self.x = areas_of(self.reference), centres_of(self.reference)

    def make(self):
        block(self.folder / "block.msh", regions=("matrix", "inclusion", "other"), divisions=9)
        other = {name.replace("inclusion", "other"): value for name, value in MATERIALS.items() if "inclusion" in name}
        self.run_cell({**CELL, **other, "material_other_young": 120e9})
        self.run_scene({**HETEROGENEOUS, **other, "material_other_young": 120e9})
        self.run_scene(HOMOGENEOUS)
        said = self.run_relocalize(**COMPARED, **POINTS, relocalize_recovery="element")
        self.assertIn("relative L2 error against heterogeneous", said)

    def fields(self, name="stress"):
        """Stress of all frames: the heterogeneous run's, the relocalised, the homogeneous run's."""
        return [frames_of(*source) for source in ((self.reference, name), (self.found, name),
                                                  (self.found, "homogeneous_stress"))]

    def parts(self):
        """Cells of each part with its place in comparison.yaml."""
        edge = np.minimum(self.x, SIDE - self.x).min(axis=1)
        parts = {("all",): np.ones(len(self.x), bool), ("layer",): self.x[:, 1] < COMPARED["relocalize_layer"],
                 ("bulk",): edge > COMPARED["relocalize_bulk"]}
        for k, region in enumerate(("matrix", "inclusion", "other")):
            parts["phases", region] = self.reference["mesh/region"] == k
        return parts

    def entry(self, kind, part, component):
        entry = self.facts[kind]
        for key in part:
            entry = entry[key]
        return entry[COMPONENTS[component]]

    def test_errors_means_and_quantiles(self):
        reference, relocalised, homogeneous = self.fields()
        np.testing.assert_array_equal(self.facts["frames"]["time"], self.reference["time"])
        for part, inside in self.parts().items():
            self.assertTrue(inside.any())
            area = self.area[inside]
            errors = {name: relative_error(values[:, inside], reference[:, inside], np.tile(area, (len(values), 1)))
                      for name, values in (("relocalised", relocalised), ("homogeneous", homogeneous))}
            for i in range(3):
                for name, error in errors.items():
                    self.assert_close(self.entry("error", part, i)[name], error[i], PRINTED, f"{part} {name}")
                for name, values in (("reference", reference), ("relocalised", relocalised),
                                     ("homogeneous", homogeneous)):
                    mean = np.average(values[:, inside, i].mean(axis=0), weights=area)
                    scale = np.abs(values).max()
                    self.assertAlmostEqual(self.entry("mean", part, i)[name] / scale, mean / scale, places=5)
                    # All cells have the same area.
                    ascending, n = np.sort(values[-1, inside, i]), inside.sum()
                    ranks = [int(np.ceil(level * n - 1e-9)) - 1 for level in self.facts["quantiles"]["levels"]]
                    self.assert_close(self.entry("quantiles", part, i)[name], ascending[ranks], PRINTED)

    def test_each_frame(self):
        reference, relocalised, _ = self.fields()
        for i, name in enumerate(COMPONENTS):
            listed = self.facts["frames"]["all"][name]["relocalised"]
            self.assertEqual(len(listed), len(reference))
            self.assertTrue(np.isnan(listed[0]), "nothing is stressed at the start")
            expected = [relative_error(a, b, self.area)[i] for a, b in zip(relocalised[1:], reference[1:])]
            self.assert_close(listed[1:], expected, PRINTED)

    def test_extremes_of_the_frames(self):
        quantiles = {"lowest of frames": 0, "1 % quantile of frames": 0.01, "99 % quantile of frames": 0.99,
                     "highest of frames": 1}
        for name, level in quantiles.items():
            reference, relocalised, homogeneous = (np.quantile(values, level, axis=0) for values in self.fields())
            for source, values in (("relocalised", relocalised), ("homogeneous", homogeneous)):
                for i, component in enumerate(COMPONENTS):
                    found = self.facts["statistics"][name]["all"][component][source]
                    if np.abs(reference[:, i]).max() == 0:  # the highest of a compression that starts at 0
                        self.assertTrue(np.isnan(found))
                        continue
                    error = relative_error(values, reference, self.area)[i]
                    self.assertAlmostEqual(found / error, 1, delta=PRINTED, msg=name)

    def test_probes(self):
        given = np.array([float(x) for x in POINTS["relocalize_points"].split(",")]).reshape(-1, 2)
        reference, relocalised, homogeneous = self.fields()
        for k, x in enumerate(given):
            cell = np.linalg.norm(self.x - x, axis=1).argmin()
            point = {name.split("/")[-1]: rows for name, rows in self.found.items() if name.startswith(f"points/{k}/")}
            np.testing.assert_array_equal(point["x"], x)
            np.testing.assert_array_equal(point["time"], self.found["time"])
            self.assertEqual(point["region"][0], self.found["mesh/region"][cell])
            for name in ("stress", "strain", "homogeneous_stress"):
                np.testing.assert_array_equal(point[name], frames_of(self.found, name)[:, cell])
            told = self.facts["probes"][str(k) if str(k) in self.facts["probes"] else k]
            self.assertEqual(told["x"], list(x))
            for i, component in enumerate(COMPONENTS):
                a = reference[:, cell, i]
                for name, b in (("relocalised", relocalised[:, cell, i]), ("homogeneous", homogeneous[:, cell, i])):
                    expected = [np.corrcoef(a, b)[0, 1], np.polyfit(a, b, 1)[0],
                                np.linalg.norm(b - a) / np.linalg.norm(a)]
                    found = [told[component][name][key] for key in ("correlation", "slope", "error")]
                    self.assert_close(found, expected, PRINTED, f"{k} {component} {name}")

    def test_statistics(self):
        run = self.local("homogeneous", "statistics.h5")
        expected = self.local("heterogeneous", "statistics.h5")
        found = self.local("out", "relocalized_statistics.h5")
        tensors = self.local("cell", "localization.h5")
        macro = run["statistics/strain/covariance"]
        full = np.empty((len(macro), 3, 3))
        for k, (i, j) in enumerate(PAIRS):
            full[:, i, j] = full[:, j, i] = macro[:, k]
        effective = np.broadcast_to(tensors["effective/stiffness"], full.shape)
        deviations = {}
        for name, operator in (("stress", concentration_of(tensors)), ("strain", tensors["cell/localisation"]),
                               ("homogeneous", effective)):
            covariance = operator @ full @ operator.transpose(0, 2, 1)
            deviations[name] = np.sqrt(covariance[:, range(3), range(3)])
            mean = apply(operator, run["statistics/strain/mean"])
            if name == "homogeneous":
                continue
            self.assert_close(found[f"statistics/{name}/mean"], mean, 1e-12)
            rows = np.stack([covariance[:, i, j] for i, j in PAIRS], axis=1)
            self.assert_close(found[f"statistics/{name}/covariance"], rows, 1e-12)
            self.assert_close(found[f"statistics/{name}/deviation"], deviations[name], 1e-12)
            self.assertGreater(deviations[name].max(), 0.05 * np.abs(mean).max())
        for statistic, before, after in (
                ("mean", apply(effective, run["statistics/strain/mean"]), found["statistics/stress/mean"]),
                ("deviation", deviations["homogeneous"], found["statistics/stress/deviation"])):
            reference = expected[f"statistics/stress/{statistic}"]
            listed = self.facts["statistics"][statistic]["all"]
            for i, component in enumerate(COMPONENTS):
                for source, rows in (("homogeneous", before), ("relocalised", after)):
                    error = relative_error(rows, reference, self.area)[i]
                    self.assertAlmostEqual(listed[component][source] / error, 1, delta=PRINTED)

    def test_same_on_any_ranks(self):
        strip = {"relocalize_correction": "strip", "relocalize_strip": 3e-3}
        for correction, tolerance in (({}, 1e-12), (strip, 1e-9)):
            self.run_relocalize(**COMPARED, **POINTS, **correction, output_folder="one")
            for ranks in (2, 3):
                with self.subTest(ranks=ranks, **correction):
                    self.run_relocalize(**COMPARED, **POINTS, **correction, ranks=ranks, output_folder="many")
                    self.assertEqual({file.name for file in (self.folder / "many").iterdir()}, FILES)
                    for file in ("relocalized.h5", "relocalized_statistics.h5"):
                        one, many = self.local("one", file), self.local("many", file)
                        self.assertEqual(one.keys(), many.keys())
                        for name in one:
                            self.assert_close(many[name], one[name], tolerance, name)
                    one, many = (numbers_of(self.comparison(folder)) for folder in ("one", "many"))
                    self.assertEqual(one.keys(), many.keys())
                    for name, values in one.items():
                        if values.dtype.kind in "fi":
                            self.assert_close(many[name], values, PRINTED, name)

    def test_opens_as_xdmf(self):
        found = meshio.xdmf.TimeSeriesReader(self.folder / "out" / "relocalized.xdmf")
        with found:
            points, cells = found.read_points_cells()
            self.assertEqual(sum(len(part.data) for part in cells), len(self.area))
            self.assertEqual(found.num_steps, len(self.found["time"]))
            time, _, data = found.read_data(found.num_steps - 1)
            self.assertEqual(time, self.found["time"][-1])
            np.testing.assert_array_equal(data["stress"][0], frames_of(self.found, "stress")[-1])
        statistics = meshio.read(self.folder / "out" / "relocalized_statistics.xdmf")
        mean = self.local("out", "relocalized_statistics.h5")["statistics/stress/mean"]
        np.testing.assert_array_equal(statistics.cell_data["stress_mean"][0], mean)
        self.assertLessEqual({"stress_deviation", "strain_mean", "strain_deviation", "region"},
                             statistics.cell_data.keys())

    def test_picture(self):
        runs = Path(__file__).parents[2] / "runs"
        for choice in ([], ["--statistic", "mean", "--component", "xx"]):
            done = subprocess.run([sys.executable, "-B", "-m", "analysis.relocalized_picture", "heterogeneous", "out",
                                   "homogeneous", "picture.png", *choice], cwd=self.folder, capture_output=True,
                                  text=True, env=self.environment(PYTHONPATH=str(runs)), timeout=60)
            self.assertEqual((done.returncode, done.stderr), (0, ""), done.stdout)
            self.assertEqual((self.folder / "picture.png").read_bytes()[:4], b"\x89PNG")
            (self.folder / "picture.png").unlink()

    def test_beside_the_files_of_the_run(self):
        """The folder of the homogeneous run takes them as well; nothing of the run is touched."""
        before = snapshot(self.folder / "homogeneous")
        self.run_relocalize(**COMPARED, output_folder="homogeneous", ranks=2)
        after = snapshot(self.folder / "homogeneous")
        self.assertEqual({str(name) for name in after.keys() - before.keys()}, FILES)
        self.assertEqual({name: after[name] for name in before}, before)
        self.run_relocalize(output_folder="homogeneous")
        left = {file.name for file in (self.folder / "homogeneous").iterdir()}
        self.assertNotIn("comparison.yaml", left, "of the older comparison")
        self.assertLessEqual(FRAMES, left)


class Contact(Checks):
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


class OfAPart(Checks):
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
