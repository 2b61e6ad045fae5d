"""What `homogenize` finds and leaves behind: on any number of ranks, under each boundary condition, as files, and as
the material that `slide` takes."""

import re
import unittest

import h5py
import meshio
import numpy as np
import yaml
from drawing import GRID
from homogenising import FILES, LAYERS, RUN, SIDE, Homogenising, voigt
from running import datasets

SOLVER = 1e-9  # ten times its tolerance, relative
PRINTED = 1e-5  # six digits
MULTIGRID = {"cell_ksp_type": "cg", "cell_pc_type": "gamg"}
ROWS = ("xx", "yy", "xy")
# A homogeneous block, for one step.
SLIDE = {"mesh_file": "block.msh", "boundary_top_y": "fixed", "time_end": 1e-9, "output_folder": "slid"}
MANDEL = np.sqrt([1, 1, 2])


def rows(entry, name):
    """A matrix that is written as one list for each row."""
    return np.array([entry[f"{name}_{row}"] for row in ROWS])


def excess(stiffer, softer):
    """Smallest eigenvalue of the difference, over the largest of the stiffer; in Mandel's scaling."""
    left, right = (np.outer(MANDEL, MANDEL) * (c + c.T) / 2 for c in (stiffer, softer))
    return np.linalg.eigvalsh(left - right)[0] / np.linalg.eigvalsh(left)[-1]


def wave_speeds(c, density, axis):
    """Of plane waves along an axis, the faster first: Christoffel's equation."""
    k = [(0, 2), (2, 1)][axis]
    return np.sqrt(np.linalg.eigvalsh(c[np.ix_(k, k)])[::-1] / density)


class Results(Homogenising):
    def setUp(self):
        super().setUp()
        self.draw_cell(self.folder / "cell.msh")

    def stiffness(self, boundary, folder="out"):
        return rows(self.effective(folder)["homogenize"][boundary], "stiffness")

    def test_same_on_any_ranks(self):
        for solver, tolerance in (({}, SOLVER), (MULTIGRID, 10 * SOLVER)):
            self.run_cell(**solver, cell_boundary="all", output_folder="one")
            local = datasets(self.folder / "one" / "localization.h5")
            for ranks in (2, 3):
                with self.subTest(ranks=ranks, **solver):
                    self.run_cell(**solver, cell_boundary="all", ranks=ranks)
                    for boundary in ("periodic", "kubc", "subc"):
                        one, many = self.stiffness(boundary, "one"), self.stiffness(boundary)
                        np.testing.assert_allclose(many, one, rtol=0, atol=tolerance * one.max())
                    found = datasets(self.folder / "out" / "localization.h5")
                    self.assertEqual(found.keys(), local.keys())
                    for name, values in local.items():
                        # A strain is off by up to the contrast (2.7) times the error of the residual.
                        atol = 10 * tolerance * np.abs(values).max()
                        np.testing.assert_allclose(found[name], values, rtol=0, atol=atol, err_msg=name)

    def test_order_of_the_conditions(self):
        said = self.run_cell(cell_boundary="all")
        periodic, kubc, subc = (self.stiffness(boundary) for boundary in ("periodic", "kubc", "subc"))
        for stiffer, softer in ((kubc, periodic), (periodic, subc)):
            # The sides cut inclusions, which feel the condition: more than rounding.
            self.assertGreater(excess(stiffer, softer), 1e-4)
        self.assertRegex(said, r"subc <= periodic +ok")
        self.assertRegex(said, r"periodic <= kubc +ok")
        np.testing.assert_allclose(voigt(self.effective()["stiffness"]), (periodic + periodic.T) / 2, rtol=SOLVER)
        for boundary, among_all in (("periodic", periodic), ("kubc", kubc), ("subc", subc)):
            self.run_cell(cell_boundary=boundary)
            np.testing.assert_allclose(self.stiffness(boundary), among_all, rtol=0, atol=SOLVER * among_all.max())

    def test_a_block_that_is_not_periodic(self):
        self.draw_cell(self.folder / "plain.msh", periodic="none")
        for boundary in ("kubc", "subc"):
            self.run_cell(mesh_file="plain.msh", cell_boundary=boundary, output_folder=boundary)
            effective = self.effective(boundary)["homogenize"]
            self.assertEqual(effective["boundary"], boundary)
            for bound in ("voigt_excess", "reuss_excess"):
                self.assertGreater(effective[boundary][bound], 0)
        self.assertGreater(excess(self.stiffness("kubc", "kubc"), self.stiffness("subc", "subc")), 1e-4)

    def test_error_bar(self):
        """Richardson's estimate for order 2: one uniform refinement takes three quarters of the error away."""
        self.run_cell()
        coarse = self.effective()["homogenize"]["periodic"]
        self.run_cell(mesh_refine=1)
        fine = self.effective()["homogenize"]["periodic"]
        change = rows(coarse, "stiffness") - rows(fine, "stiffness")
        np.testing.assert_allclose(0.75 * rows(coarse, "discretisation_error"), change, rtol=0,
                                   atol=SOLVER * np.abs(rows(coarse, "stiffness")).max())

    def test_notes(self):
        """What the command line makes idle in a file is set aside, and said so."""
        (self.folder / "run.yaml").write_text("".join(f"{name}: {value}\n" for name, value in RUN.items()))
        self.run_cell()
        six = ",".join(str(c) for c in self.effective()["stiffness"])
        said = self.run_cell({"options_file_yaml": "run.yaml", "material_matrix_stiffness": six}, ranks=2)
        for key in ("young", "poisson"):
            self.assertIn(f"note: -material_matrix_{key} of run.yaml gives way to -material_matrix_stiffness", said)


class Files(Homogenising):
    def setUp(self):
        super().setUp()
        self.draw_cell(self.folder / "cell.msh", cell="quadrilateral")  # with some triangles
        self.said = self.run_cell(ranks=2)
        self.local = datasets(self.folder / "out" / "localization.h5")

    def test_complete(self):
        self.assertEqual({file.name for file in (self.folder / "out").iterdir()}, FILES)
        effective = self.effective()
        facts = effective["homogenize"]
        self.assertEqual((len(effective["stiffness"]), facts["boundary"], facts["ranks"]), (6, "periodic", 2))
        self.assertEqual(facts["options"]["material_inclusion_young"], 80e9)
        fractions = [phase["fraction"] for phase in facts["phases"].values()]
        self.assertAlmostEqual(sum(fractions), 1, places=12)
        mixed = sum(f * phase["density"] for f, phase in zip(fractions, facts["phases"].values()))
        self.assertAlmostEqual(effective["density"] / mixed, 1, places=12)
        for words in ("C [GPa], periodic", "Hashin-Shtrikman", "Hill-Mandel", "in all", "on 2 ranks"):
            self.assertIn(words, self.said)

    def test_means_of_the_tensors(self):
        """<A> = I and <C:A> = C_eff, summed over the file's cells."""
        share = self.local["cell/area"] / self.local["cell/area"].sum()
        self.assertAlmostEqual(self.local["cell/area"].sum() / SIDE**2, 1, places=12)
        a = self.local["cell/localisation"]
        np.testing.assert_allclose(np.tensordot(share, a, 1), np.eye(3), rtol=0, atol=SOLVER)
        effective = self.local["effective/stiffness"]
        by_region = self.local["region/stiffness"][self.local["cell/region"]]
        for k, load in enumerate(ROWS):
            stress = self.local[f"cell/stress_{load}"]
            np.testing.assert_allclose(stress, np.einsum("cij,cj->ci", by_region, a[:, :, k]), rtol=0,
                                       atol=1e-12 * np.abs(stress).max())
            np.testing.assert_allclose(share @ stress, effective[:, k], rtol=0, atol=SOLVER * effective.max())
        np.testing.assert_allclose(rows(self.effective()["homogenize"]["periodic"], "stiffness"), effective, rtol=0,
                                   atol=1e-12 * effective.max())

    def test_described(self):
        with h5py.File(self.folder / "out" / "localization.h5") as file:
            for name in self.local:
                self.assertTrue(file[name].attrs["units"] and file[name].attrs["description"], name)
            self.assertEqual(set(file["mesh/region"].attrs["names"]), {b"matrix", b"inclusion"})
            self.assertEqual(file["effective/stiffness"].attrs["boundary"], b"periodic")

    def test_opens_as_xdmf(self):
        mesh = meshio.read(self.folder / "out" / "localization.xdmf")
        self.assertEqual({block.type for block in mesh.cells}, {"triangle", "quad"})
        self.assertEqual(sum(len(block.data) for block in mesh.cells), self.effective()["homogenize"]["cells"])
        # Seam nodes are written twice: no cell is drawn across the block.
        widths = np.concatenate([np.ptp(mesh.points[block.data], axis=1).max(axis=1) for block in mesh.cells])
        self.assertLess(widths.max(), 0.3 * SIDE)
        components = ("xx", "yy", "xy")
        pairs = {f"{name}_{one}_{other}" for name in ("localisation", "stress") for one in components
                 for other in components}
        self.assertLessEqual(pairs | {"region", "area"}, mesh.cell_data.keys())
        tensors = datasets(self.folder / "out" / "localization.h5")
        for i, local in enumerate(components):
            for j, macroscopic in enumerate(components):
                np.testing.assert_array_equal(np.concatenate(mesh.cell_data[f"localisation_{local}_{macroscopic}"]),
                                              tensors["cell/localisation"][:, i, j])
                np.testing.assert_array_equal(np.concatenate(mesh.cell_data[f"stress_{macroscopic}_{local}"]),
                                              tensors["cell/stress_" + macroscopic][:, i])

    def test_help(self):
        outcome = self.homogenize("-help", ranks=2)
        self.assertEqual((outcome.codes, outcome.err), ([0, 0], ""))
        for option in self.effective()["homogenize"]["options"]:
            general = re.sub("^material_(matrix|inclusion)_", "material_<region>_", option)
            self.assertIn(f"\n  -{general}  ", outcome.out)


class InSlide(Homogenising):
    """effective.yaml as the material of a homogeneous block."""

    def setUp(self):
        super().setUp()
        self.draw({**LAYERS, **GRID, "periodic": "none", "layer_period": None})
        (self.folder / "drawn" / "mesh.msh").rename(self.folder / "block.msh")

    def speeds_along_y(self):
        """As slide prints them, and as it writes them."""
        said = self.run_scene({**SLIDE, "material_file": "out/effective.yaml"}, ranks=2).out
        printed = re.search(r"waves along y in matrix: (\S+) and (\S+) m/s", said)
        facts = yaml.safe_load((self.folder / "slid" / "run.yaml").read_text())["run"]
        return np.array([float(speed) for speed in printed.groups()]), np.array(facts["wave_speeds_matrix"])

    def check_speeds(self, said):
        """By Christoffel's equation from C; what homogenize prints and writes; what slide makes of it."""
        effective = self.effective()
        c, density = voigt(effective["stiffness"]), effective["density"]
        x, y = (wave_speeds(c, density, axis) for axis in (0, 1))
        number = r"([0-9.]+) and ([0-9.]+) m/s"
        printed = [float(speed) for speed in re.search(f"waves along x {number}, along y {number}", said).groups()]
        np.testing.assert_allclose(printed, [*x, *y], rtol=PRINTED)
        np.testing.assert_allclose(effective["homogenize"]["wave_speeds_x"], x, rtol=PRINTED)
        np.testing.assert_allclose(effective["homogenize"]["wave_speeds_y"], y, rtol=PRINTED)
        shown, written = self.speeds_along_y()
        np.testing.assert_allclose(shown, y, rtol=1e-4)  # five digits
        np.testing.assert_allclose(written, y, rtol=PRINTED)
        return c, density

    def test_layers(self):
        """Exact: C22 = 1/<1/M> and C66 = 1/<1/G> across the layers, M = λ + 2G (Backus, J. Geophys. Res. 67 (1962)
        4427), and C11 = <M - λ²/M> + <λ/M>²/<1/M>."""
        self.draw_cell(self.folder / "cell.msh", **LAYERS)
        c, density = self.check_speeds(self.run_cell())
        phases = self.effective()["homogenize"]["phases"]
        f = np.array([phases[name]["fraction"] for name in ("matrix", "inclusion")])
        young, poisson = np.array([30e9, 80e9]), np.array([0.3, 0.2])
        shear = young / (2 * (1 + poisson))
        lame = young * poisson / ((1 + poisson) * (1 - 2 * poisson))
        m = lame + 2 * shear
        across, slide = 1 / (f @ (1 / m)), 1 / (f @ (1 / shear))
        along = f @ (m - lame**2 / m) + (f @ (lame / m))**2 * across
        expected = voigt([along, across, f @ (lame / m) * across, slide, 0, 0])
        np.testing.assert_allclose(c, expected, rtol=0, atol=SOLVER * across)
        self.assertGreater(along, 1.05 * across)  # orthotropic
        for axis, modulus in enumerate((along, across)):
            np.testing.assert_allclose(wave_speeds(c, density, axis), np.sqrt(np.array([modulus, slide]) / density),
                                       rtol=SOLVER)

    def test_discs(self):
        self.draw_cell(self.folder / "cell.msh")
        self.check_speeds(self.run_cell())

    def test_homogenised_again(self):
        """A homogeneous cell of the effective material has its stiffness and density; so has slide's material."""
        self.draw_cell(self.folder / "cell.msh")
        self.run_cell()
        once = self.effective()
        self.run_cell({"mesh_file": "block.msh", "cell_boundary": "kubc", "material_file": "out/effective.yaml",
                       "output_folder": "again"})
        twice = self.effective("again")
        np.testing.assert_allclose(twice["stiffness"], once["stiffness"], rtol=0, atol=SOLVER * max(once["stiffness"]))
        self.assertAlmostEqual(twice["density"] / once["density"], 1, places=14)


if __name__ == "__main__":
    unittest.main()
