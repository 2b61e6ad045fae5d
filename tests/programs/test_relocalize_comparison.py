"""`relocalize` beside the heterogeneous run: what comparison.yaml and the files hold, against numpy; on any number of
ranks, as XDMF, as a picture."""

import os
import shutil
import subprocess
import tempfile
import unittest
from pathlib import Path

import meshio
import numpy as np
from relocalizing import (CELL, COMPARED, COMPONENTS, FILES, FRAMES, HETEROGENEOUS, HOMOGENEOUS, MATERIALS, POINTS,
                          Relocalising, apply, areas_of, centres_of, concentration_of, frames_of)
from running import snapshot
from scenes import SIDE, block

PRINTED = 1e-5  # six digits
PAIRS = [(0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1)]  # of a covariance


def relative_error(values, reference, area):
    """Of each component; both [..., cells, 3]."""
    def size(rows):
        return np.sqrt(np.einsum("...c,...ci->...i", area, rows**2).reshape(-1, 3).sum(axis=0))
    with np.errstate(invalid="ignore", divide="ignore"):
        return size(values - reference) / size(reference)


def numbers_of(entry, path=""):
    """All numbers of a nested dict by path; the names of everything else."""
    if isinstance(entry, dict):
        inner = [numbers_of(value, f"{path}/{key}") for key, value in entry.items()]
        return {name: values for each in inner for name, values in each.items()}
    return {path: np.atleast_1d(entry)}


class Compared(Relocalising):
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
            told = self.facts["probes"][k]
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
            for k, component in enumerate(("xx", "yy", "xy")):
                np.testing.assert_array_equal(data["stress_" + component][0], frames_of(self.found, "stress")[-1][:, k])
        statistics = meshio.read(self.folder / "out" / "relocalized_statistics.xdmf")
        mean = self.local("out", "relocalized_statistics.h5")["statistics/stress/mean"]
        for k, component in enumerate(("xx", "yy", "xy")):
            np.testing.assert_array_equal(statistics.cell_data["stress_mean_" + component][0], mean[:, k])
        self.assertLessEqual({"stress_deviation_yy", "strain_mean_xy", "strain_deviation_xx", "region"},
                             statistics.cell_data.keys())

    def test_picture(self):
        for choice in ([], ["--statistic", "mean", "--component", "xx"]):
            done = subprocess.run([os.environ["SLIPSCALE_COMMAND"], "relocalized-picture", "heterogeneous", "out",
                                   "homogeneous", "picture.png", *choice], cwd=self.folder, capture_output=True,
                                  text=True, env=self.environment(), timeout=120)
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


if __name__ == "__main__":
    unittest.main()
