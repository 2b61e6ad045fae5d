"""Rows from what `relocalize` wrote, and averages and quantiles of phases that are known."""

import tempfile
import unittest
from pathlib import Path

import h5py
import numpy as np

from relocalisation.comparison import compare_phases, phase_values, read_comparison, weighted_quantile
from slipscale.reading import Fields, UnreadableRun
from tests import fake_run

ERRORS = "{xx: {relocalised: 0.1, homogeneous: .nan}, yy: {relocalised: 1e-05, homogeneous: 0.2}, " \
         "xy: {relocalised: 0.3, homogeneous: 0.4}}"
VALUES = "{reference: -3, relocalised: -2e+06, homogeneous: -1.5}"
LISTS = "{reference: [1, 2], relocalised: [3, 4], homogeneous: [5, 6]}"
AGREEMENT = "{relocalised: {correlation: 0.9, slope: 1.1, error: 0.1}, " \
            "homogeneous: {correlation: 0.8, slope: 0.7, error: 0.3}}"
REPORT = f"""
reference: run-het
area: {{all: {{share: 1}}, phases: {{matrix: {{share: 0.7}}}}}}
error: {{all: {ERRORS}, phases: {{matrix: {ERRORS}}}}}
mean: {{all: {{xx: {VALUES}, yy: {VALUES}, xy: {VALUES}}}}}
quantiles:
  levels: [0.01, 0.5]
  layer: {{xx: {LISTS}, yy: {LISTS}, xy: {LISTS}}}
statistics: {{1 % quantile of frames: {{bulk: {ERRORS}}}}}
frames: {{time: [1e-06, 2e-06], all: {{xx: {LISTS}, yy: {LISTS}, xy: {LISTS}}}}}
probes:
  0: {{x: [0.0042, 0.0002], region: inclusion, xx: {AGREEMENT}, yy: {AGREEMENT}, xy: {AGREEMENT}}}
"""


class InFolder(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = Path(temporary.name)


class Rows(InFolder):
    def test_every_number_is_found_under_its_name(self):
        (self.folder / "comparison.yaml").write_text(REPORT)
        found = {(row["measure"], row["part"], row["component"], row["time"]):
                 (row["reference"], row["relocalised"], row["homogeneous"]) for row in read_comparison(self.folder)}
        self.assertEqual(len(found), 3 * (2 + 1 + 1 + 2 + 2 + 3))
        self.assertEqual(found["error", "matrix", "yy", None], (None, 1e-5, 0.2))
        self.assertTrue(np.isnan(found["error", "all", "xx", None][2]))
        self.assertEqual(found["error_1_%_quantile_of_frames", "bulk", "xy", None], (None, 0.3, 0.4))
        self.assertEqual(found["average", "all", "yy", None], (-3, -2e6, -1.5))
        self.assertEqual(found["quantile_0.5", "layer", "xx", None], (2, 4, 6))
        self.assertEqual(found["frame_error", "all", "xy", 2e-6], (None, 4, 6))
        self.assertEqual(found["probe_slope", "inclusion at 4.2, 0.2 mm", "yy", None], (None, 1.1, 0.7))

    def test_refuses_what_is_not_there_or_not_complete(self):
        with self.assertRaisesRegex(UnreadableRun, "There is no comparison.yaml in .*-relocalize_reference"):
            read_comparison(self.folder)
        (self.folder / "comparison.yaml").write_text("error: {all: {xx: {relocalised: 0.1, homogeneous: 0.2}}}\n")
        with self.assertRaisesRegex(UnreadableRun, r"not what this version .*KeyError\('yy'\)"):
            read_comparison(self.folder)


class Phases(InFolder):
    def test_quantile_by_weight(self):
        values, weights = np.array([3.0, 1.0, 2.0]), np.array([1.0, 6.0, 3.0])
        for level, expected in ((0.01, 1), (0.59, 1), (0.61, 2), (0.89, 2), (0.91, 3), (1.0, 3)):
            self.assertEqual(weighted_quantile(values, weights, level), expected)

    def write(self, folder, name, scale):
        """Stress of frame k in the phase r, component i: scale (1 + k) (1 + r) (1 + i)."""
        fake_run.write_fields(self.folder / folder, [1e-5, 2e-5], "triangles")
        with h5py.File(self.folder / folder / "fields.h5", "r+") as file:
            region = file["mesh/region"][:].ravel()
            for k, frame in enumerate(sorted(file["frames"])):
                for part in ("stress", "homogeneous_stress"):
                    if part in file["frames"][frame]:
                        del file["frames"][frame][part]
                    factor = scale if part == "stress" else 0.5 * scale
                    file["frames"][frame][part] = factor * (1.0 + k) * np.outer(1 + region, [1, 2, 3])
        (self.folder / folder / "fields.h5").rename(self.folder / folder / name)

    def test_of_two_composites(self):
        for folder, name, scale in (("het", "fields.h5", 1.0), ("tiled", "relocalized.h5", 1.1)):
            (self.folder / folder).mkdir()
            self.write(folder, name, scale)
        with Fields(self.folder / "het") as file:
            phases = file.region_names
            self.assertEqual(set(phase_values(file, "stress")),
                             {(measure, phase, component) for phase in phases for component in ("xx", "yy", "xy")
                              for measure in ("average", "quantile_0.01", "quantile_0.5", "quantile_0.99")})
        rows = compare_phases(self.folder / "tiled", self.folder / "het")
        self.assertEqual(len(rows), 4 * 3 * len(phases))
        for row in rows:
            exact = (1.5 if row["measure"] == "average" else 2.0) * (1 + phases.index(row["part"])) * \
                (1 + ("xx", "yy", "xy").index(row["component"]))
            np.testing.assert_allclose([row["reference"], row["relocalised"], row["homogeneous"]],
                                       [exact, 1.1 * exact, 0.55 * exact], rtol=1e-13)


if __name__ == "__main__":
    unittest.main()
