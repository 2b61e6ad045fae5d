"""Tractions along interfaces of relocalised stresses: interfaces.h5 and .yaml of `relocalize`."""

import shutil
import sys
import unittest
from pathlib import Path

import numpy as np
import yaml
sys.path.insert(0, str(Path(__file__).parents[1] / "verification"))
import disc_arrays
from finding import report
from relocalizing import RUN, Relocalising, areas_of, frames_of, macro_grid, write_fields
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


class OfASquareArrayOfDiscs(Relocalising):
    """Against the exact fields of complex potentials (tests/verification/disc_arrays.py), f = .4, 30/80 GPa, nu = .3."""

    EXACT = 70.27563e9  # sigma_xx at 0 degrees under E_xx = 1, Pa
    PERIOD = 1e-3

    def traction(self, elements, cell):
        """At 0 degrees of a whole disc, between the two nodes beside it, and the mean stress xx of its outline."""
        self.draw({"block_width": self.PERIOD, "block_height": self.PERIOD, "periodic": "xy", "shape": "disc",
                   "arrangement": "square", "columns": 1, "rows": 1, "fraction": 0.4, "size": self.PERIOD / elements,
                   "cell": cell, "output_folder": "drawn"})
        materials = {f"material_{region}_{name}": value for region, young in (("matrix", 30e9), ("inclusion", 80e9))
                     for name, value in (("young", young), ("poisson", 0.3), ("density", 1))}
        self.run_cell({"mesh_file": "drawn/mesh.msh", **materials, "cell_estimate_error": "false", "output_folder": "cell"})
        points, cells = macro_grid(self.PERIOD, self.PERIOD, 2, 2)
        shutil.rmtree(self.folder / "homogeneous", ignore_errors=True)
        write_fields(self.folder / "homogeneous", points, cells, [0.0], [np.tile([1.0, 0, 0], (len(cells), 1))])
        self.run_relocalize(FOLLOWED, ranks=2)
        found = self.local(file="interfaces.h5")
        self.assertEqual(len(found["inclusions/area"]), 1)
        angle = np.remainder(found["angle"] + np.pi, 2 * np.pi) - np.pi
        order = np.argsort(angle)
        normal, shear, n = found["normal_traction"][0], found["shear_traction"][0], found["normal"]
        # Without body forces the integral of x t over the outline is that of the stress over the disc.
        t_x = normal * n[:, 0] - shear * n[:, 1]
        mean = np.sum((found["x"] - found["inclusions/centre"][0, 0]) * t_x * found["length"]) / found["inclusions/area"][0]
        if cell == "triangle":  # quadrilaterals are in equilibrium with all of their Gauss points, not with the centre alone
            local = self.local()
            area, inside = areas_of(local), local["mesh/region"] == 1
            stress = np.sum(area[inside] * local["frames/00000/stress"][inside, 0]) / area[inside].sum()
            self.assertAlmostEqual(mean / stress, 1, delta=1e-9)
        return np.interp(0, angle[order], normal[order]), self.distance(found["angle"], normal, shear)

    @staticmethod
    def distance(angle, normal, shear):
        """Relative L2 distance to the exact tractions along the whole outline."""
        field = disc_arrays.solve(disc_arrays.SQUARE, 0.4, disc_arrays.Solid(30e9), disc_arrays.Solid(80e9), (1, 0, 0))
        s = field.strain_and_stress(field.radius * np.exp(1j * angle))[1].T
        c, d = np.cos(angle), np.sin(angle)
        exact = np.array([s[0] * c**2 + s[1] * d**2 + 2 * s[2] * c * d, (s[1] - s[0]) * c * d + s[2] * (c**2 - d**2)])
        return np.linalg.norm(exact - [normal, shear]) / np.linalg.norm(exact)

    def test_has_the_exact_traction(self):
        for cell, name in (("triangle", "P1"), ("quadrilateral", "Q1")):
            found = [self.traction(elements, cell) for elements in (32, 64, 128)]
            at_zero, distance = np.array(found).T
            order = 0.5 * np.log2(distance[0] / distance[2])
            topic = "Traction along the interface of a square array of discs, f .4, 30/80 GPa, E_xx = 1"
            for quantity, expected, said, shown in (
                    (f"normal at 0 degrees, GPa, 128 {name} elements per cell", "70.2756 +- 0.02", f"{at_zero[2] * 1e-9:.4f}", "-"),
                    (f"normal and shear along the outline, relative L2 error, 128 {name} elements", "<= 2e-3" + ("; order >= 0.95" if name == "P1" else ""),
                     f"{distance[2]:.1e}", f"{order:.2f}")):
                report(topic, quantity, expected, said, "complex potentials, disc_arrays.py", shown)
            self.assertLess(abs(at_zero[2] - self.EXACT), 0.02e9)
            self.assertLess(distance[2], 2e-3)
            if name == "P1":  # of quadrilaterals only the stress at the centre is known, not what varies within
                self.assertGreater(order, 0.95)


class AcrossASeam(Relocalising):
    """Discs of a periodic cell, set so that the sides of a run cut two of three."""

    PERIOD = 1e-3

    def test_an_inclusion_is_whole_where_the_run_is_periodic(self):
        self.draw({"block_width": self.PERIOD, "block_height": self.PERIOD, "periodic": "xy", "shape": "disc",
                   "arrangement": "square", "columns": 1, "rows": 1, "fraction": 0.4, "size": self.PERIOD / 16,
                   "cell": "triangle", "output_folder": "drawn"})
        materials = {f"material_{region}_{name}": value for region, young in (("matrix", 30e9), ("inclusion", 80e9))
                     for name, value in (("young", young), ("poisson", 0.3), ("density", 1))}
        self.run_cell({"mesh_file": "drawn/mesh.msh", **materials, "cell_estimate_error": "false", "output_folder": "cell"})
        points, cells = macro_grid(2 * self.PERIOD, self.PERIOD, 4, 2)
        write_fields(self.folder / "homogeneous", points, cells, [0.0], [np.tile([1e-3, 2e-4, 5e-4], (len(cells), 1))])
        run = {**FOLLOWED, "relocalize_origin": f"{self.PERIOD / 2},0"}
        self.assertIn("interfaces of 3 inclusions", self.run_relocalize(run))
        self.assertTrue(self.local(file="interfaces.h5")["outer"].any())
        (self.folder / "homogeneous" / "run.yaml").write_text("run:\n  periodic: x\n")
        for ranks in (1, 2):
            self.run_relocalize(run, ranks=ranks)
            found = self.local(file="interfaces.h5")
            self.assertFalse(found["outer"].any())
            area = found["inclusions/area"]
            self.assertEqual(len(area), 2)
            self.assertAlmostEqual(area[0] / area[1], 1, delta=1e-9)
            self.assertAlmostEqual(area[0] / (0.4 * self.PERIOD**2), 1, delta=2e-2)
            from_seam = np.remainder(found["inclusions/centre"][:, 0] + 1e-6, 2 * self.PERIOD)
            np.testing.assert_allclose(np.sort(from_seam), [1e-6, self.PERIOD + 1e-6], rtol=0, atol=1e-9)
            tractions = []
            for k in (0, 1):
                own = np.flatnonzero(found["inclusion"] == k)
                own = own[np.argsort(np.remainder(found["angle"][own] + 0.01, 2 * np.pi))]
                away = np.hypot(found["x"][own] - found["inclusions/centre"][k, 0], found["y"][own] - found["inclusions/centre"][k, 1])
                self.assertLess(np.ptp(away), 1e-2 * self.PERIOD, "torn at the seam")
                tractions.append(np.stack([found["normal_traction"][0, own], found["shear_traction"][0, own]]))
            np.testing.assert_allclose(*tractions, rtol=0, atol=1e-7 * np.abs(tractions[0]).max())
        self.run_relocalize({**run, "interfaces_region": "matrix"})


if __name__ == "__main__":
    unittest.main()
