"""Tractions along interfaces of relocalised stresses: interfaces.h5 and .yaml of `relocalize`."""

import unittest

import numpy as np
import yaml
from relocalizing import RUN, Relocalising, frames_of
from running import datasets
from scenes import SIDE, block

COUNT = 8
FOLLOWED = {**RUN, "interfaces_region": "inclusion"}
STRONG = {"interfaces_normal_strength": 1e6, "interfaces_shear_strength": 2e6}


class OfALaminate(Relocalising):
    """A layer of inclusion on one of matrix; its interface is a straight line of nodes."""

    def setUp(self):
        super().setUp()
        block(self.folder / "block.msh", regions=("matrix", "inclusion"), divisions=COUNT)
        self.make_runs()

    def expected(self, found, local, quantity):
        """By hand: a node has the lower corners of the two inclusion's cells above it; [frames, inner nodes] normal, shear."""
        corners = local["mesh/coordinates"][local["mesh/cells"]]
        centre = corners.mean(axis=1)
        h = SIDE / COUNT
        above = np.flatnonzero(np.abs(centre[:, 1] - (SIDE / 2 + h / 2)) < 1e-6)
        above = above[np.argsort(centre[above, 0])]
        stress = frames_of(local, quantity)[:, above]
        left, right = stress[:, :-1], stress[:, 1:]
        force_x = h / 2 * (left[..., 0] - right[..., 0] - left[..., 2] - right[..., 2])
        force_y = h / 2 * (left[..., 2] - right[..., 2] - left[..., 1] - right[..., 1])
        return -force_y / h, force_x / h  # out of the inclusion is down, counter-clockwise of it +x

    def test_tractions_are_the_nodal_forces_of_the_cells(self):
        self.run_relocalize({**FOLLOWED, **STRONG}, ranks=2)
        found, local = self.local(file="interfaces.h5"), self.local()
        np.testing.assert_array_equal(found["time"], local["time"])
        inner = np.flatnonzero(found["outer"] == 0)
        inner = inner[np.argsort(found["x"][inner])]
        self.assertEqual(len(inner), COUNT - 1)
        np.testing.assert_allclose(found["normal"][inner], np.tile([0, -1], (COUNT - 1, 1)), atol=1e-9)
        for prefix, quantity in (("", "stress"), ("homogeneous/", "homogeneous_stress")):
            normal, shear = self.expected(found, local, quantity)
            scale = np.abs(normal).max()
            np.testing.assert_allclose(found[prefix + "normal_traction"][:, inner], normal, rtol=0, atol=1e-9 * scale)
            np.testing.assert_allclose(found[prefix + "shear_traction"][:, inner], shear, rtol=0, atol=1e-9 * scale)
        report = yaml.safe_load((self.folder / "out" / "interfaces.yaml").read_text())
        self.assertEqual(sorted(name for name in report if name.startswith("peaks")), ["peaks", "peaks_homogeneous"])
        # Up to rounding in the yaml.
        self.assertAlmostEqual(report["peaks"]["inclusion_0"]["shear"][0] /
                               np.abs(found["shear_traction"][:, inner]).max(), 1, delta=1e-5)

    def test_the_same_bits_on_any_number_of_ranks(self):
        self.run_relocalize({**FOLLOWED, **STRONG})
        alone = datasets(self.folder / "out" / "interfaces.h5")
        for ranks in (2, 3):
            self.run_relocalize({**FOLLOWED, **STRONG}, ranks=ranks)
            cut = datasets(self.folder / "out" / "interfaces.h5")
            for name in alone:
                self.assertEqual(alone[name].tobytes(), cut[name].tobytes(), f"{name}, {ranks} ranks")


if __name__ == "__main__":
    unittest.main()
