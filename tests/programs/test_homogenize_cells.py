"""What `homogenize` makes of cells on which codes go wrong without a word: far from the origin, of nearly equal and of
very unequal phases, nearly incompressible, with holes; and what it says of solvers and doubtful results."""

import subprocess
import unittest

import numpy as np
from finding import report
from holes_exact import SquareArrayOfHoles
from homogenising import RUN, SIDE, Homogenising, voigt
from running import arguments_of
from scenes import block

SOLVER = 1e-9  # ten times its tolerance, relative
ROWS = ("xx", "yy", "xy")
EQUAL = {"material_inclusion_young": 30e9, "material_inclusion_poisson": 0.3}
ALONE = {"material_all_young": 30e9, "material_all_poisson": 0.3, "material_all_density": 2000,
         **{name: None for name in RUN if name.startswith("material_")}}
QUICK = {"cell_estimate_error": "false"}

# A square array of circles, the unit cell drawn with one in its middle or with four quarters in its corners.
ARRAY = """
SetFactory("OpenCASCADE");
L = {side}; r = {radius}; e = 1e-7;
Rectangle(1) = {{0, 0, 0, L, L}};
{circles}
{cut}
b() = Curve In BoundingBox{{-e, -e, -e, L + e, e, e}}; t() = Curve In BoundingBox{{-e, L - e, -e, L + e, L + e, e}};
l() = Curve In BoundingBox{{-e, -e, -e, e, L + e, e}}; k() = Curve In BoundingBox{{L - e, -e, -e, L + e, L + e, e}};
{pairs}
Mesh.MeshSizeMin = {size}; Mesh.MeshSizeMax = {size}; Mesh.MeshSizeExtendFromBoundary = 0;
{cells}
"""
PAIRS = "Periodic Curve{k()} = {l()} Translate{L, 0, 0}; Periodic Curve{t()} = {b()} Translate{0, L, 0};"
MIDDLE = ("0.5*L, 0.5*L",)
CORNERS = ("0, 0", "L, 0", "0, L", "L, L")


def array(path, fraction, elements, centres=MIDDLE, filled=False, periodic=True, quadrilaterals=False):
    """Writes the unit cell as a mesh; `filled`: the circles are a region `inclusion`, else they are holes."""
    tools = ", ".join(str(k + 2) for k in range(len(centres)))
    circles = " ".join(f"Disk({k + 2}) = {{{centre}, 0, r}};" for k, centre in enumerate(centres))
    if filled:
        cut = (f"BooleanFragments{{Surface{{1}}; Delete;}}{{Surface{{{tools}}}; Delete;}}\n"
               'Physical Surface("inclusion") = {2}; Physical Surface("matrix") = {3};')
    else:
        cut = (f"BooleanDifference(9) = {{Surface{{1}}; Delete;}}{{Surface{{{tools}}}; Delete;}};\n"
               'Physical Surface("matrix") = {9};')
    cells = "Mesh.RecombineAll = 1; Mesh.RecombinationAlgorithm = 3;" if quadrilaterals else ""
    geometry = path.with_suffix(".geo")
    geometry.write_text(ARRAY.format(side=SIDE, radius=SIDE * np.sqrt(fraction / np.pi), size=SIDE / elements,
                                     circles=circles, cut=cut, pairs=PAIRS if periodic else "", cells=cells))
    subprocess.run(["gmsh", "-v", "1", "-2", "-format", "msh41", geometry, "-o", path], check=True,
                   stdin=subprocess.DEVNULL)


def moved(source, path, by):
    """The mesh at another place, `by` m along x and y."""
    lines = source.read_text().split("\n")
    for k in range(lines.index("$Nodes"), lines.index("$EndNodes")):
        words = lines[k].split()
        if len(words) == 3:
            lines[k] = f"{float(words[0]) + by:.17g} {float(words[1]) + by:.17g} {words[2]}"
    path.write_text("\n".join(lines))


class Cells(Homogenising):
    def stiffness(self, boundary, folder="out"):
        entry = self.effective(folder)["homogenize"][boundary]
        return np.array([entry[f"stiffness_{row}"] for row in ROWS])

    def assert_equal(self, found, expected, tolerance, what=None):
        np.testing.assert_allclose(found, expected, rtol=0, atol=tolerance * np.abs(expected).max(), err_msg=what)


class Places(Cells):
    def test_far_from_the_origin(self):
        """The same numbers, as far as the coordinates still have the cell's digits: at N widths they are off by N
        rounding units of the width, a step of which is a twentieth."""
        self.draw_cell(self.folder / "cell.msh")
        for widths in (20, 5000):
            moved(self.folder / "cell.msh", self.folder / f"far{widths}.msh", widths * SIDE)
        for name, phases in (("equal", EQUAL), ("weak", {**EQUAL, "material_inclusion_young": 30e9 * (1 + 1e-9)}),
                             ("strong", {})):
            self.run_cell(**phases, **QUICK, cell_boundary="all", output_folder="here")
            for widths, ranks in ((20, 1), (5000, 1), (5000, 2)):
                with self.subTest(phases=name, widths=widths, ranks=ranks):
                    self.run_cell(**phases, **QUICK, mesh_file=f"far{widths}.msh", cell_boundary="all", ranks=ranks)
                    for boundary in ("periodic", "kubc", "subc"):
                        self.assert_equal(self.stiffness(boundary), self.stiffness(boundary, "here"), SOLVER, boundary)

    def test_equal_phases_are_one(self):
        """Whatever the condition: C is that of the material, to rounding."""
        self.draw_cell(self.folder / "cell.msh")
        lame, shear = 30e9 * 0.3 / (1.3 * 0.4), 30e9 / 2.6
        exact = np.array([[lame + 2 * shear, lame, 0], [lame, lame + 2 * shear, 0], [0, 0, shear]])
        for ranks in (1, 2):
            self.run_cell(**EQUAL, **QUICK, cell_boundary="all", ranks=ranks)
            for boundary in ("periodic", "kubc", "subc"):
                self.assert_equal(self.stiffness(boundary), exact, 1e-11, boundary)


class Contrasts(Cells):
    def test_given_stress_on_a_strong_contrast(self):
        """Discs of a millionth of the stiffness under all conditions, by factorisation and by multigrid: a bound on
        the difference is what the residual, rounded at the contrast, may leave."""
        array(self.folder / "cell.msh", 0.3, 20, filled=True)
        soft = {"material_inclusion_young": 30e3}
        self.run_cell(**soft, **QUICK, cell_boundary="all", output_folder="direct")
        self.run_cell(**soft, **QUICK, cell_boundary="all", cell_ksp_type="cg", cell_pc_type="gamg")
        self.run_cell(**soft, **QUICK, cell_boundary="all", ranks=2, output_folder="two")
        for boundary in ("periodic", "kubc", "subc"):
            for folder in ("out", "two"):
                self.assert_equal(self.stiffness(boundary, folder), self.stiffness(boundary, "direct"), 1e-7, boundary)
        stiff = {"material_inclusion_young": 30e15}
        said = self.run_cell(**stiff, **QUICK, cell_boundary="subc")
        self.assertNotIn("VIOLATED", said)

    def test_options_of_a_solver_that_does_not_run(self):
        self.draw_cell(self.folder / "cell.msh")
        said = self.run_cell(**QUICK, cell_ksp_rtol=1e-8, cell_ksp_max_it=5000)
        for option in ("-cell_ksp_rtol", "-cell_ksp_max_it"):
            self.assertIn(f"note: {option} is idle: the cell is solved directly (preonly + cholesky)", said)
        said = self.run_cell(**QUICK, cell_ksp_type="cg", cell_ksp_rtol=1e-8, cell_ksp_max_it=5000)
        self.assertNotIn("idle", said)

    def test_too_small_a_workspace(self):
        """MUMPS without any to spare: it is given more until it can factorise, with the same result."""
        array(self.folder / "cell.msh", 0.3, 40, filled=True)
        direct = {**QUICK, "cell_ksp_type": "preonly", "cell_pc_type": "cholesky"}
        self.run_cell(**direct, output_folder="ample")
        self.run_cell(**direct, cell_mat_mumps_icntl_14=-60)
        self.assert_equal(self.stiffness("periodic"), self.stiffness("periodic", "ample"), SOLVER)

    def test_advice_fits_the_solver(self):
        self.draw_cell(self.folder / "cell.msh")
        outcome = self.homogenize(*arguments_of({**RUN, **QUICK, "cell_snes_max_it": 0}))
        self.assertEqual(outcome.codes, [2])
        self.assertNotIn("-cell_pc_type cholesky", outcome.err)
        outcome = self.homogenize(*arguments_of({**RUN, **QUICK, "cell_ksp_type": "cg", "cell_pc_type": "none",
                                                 "cell_ksp_max_it": 2}))
        self.assertIn("-cell_pc_type cholesky", outcome.err)


class Incompressible(Cells):
    """A matrix of ν = .4999999 around discs. Hill, J. Mech. Phys. Solids 12 (1964) 199: where the shear moduli are
    equal, 1/(k + G) is the mean of 1/(k_i + G), whatever the geometry, and G is that of the phases."""

    SHEAR = 10e9
    POISSON = 0.4999999
    MATRIX = {"material_matrix_young": 2 * SHEAR * (1 + POISSON), "material_matrix_poisson": POISSON}
    DISCS = {"material_inclusion_young": 2 * SHEAR * 1.2, "material_inclusion_poisson": 0.2}

    def exact_bulk(self):
        phases = self.effective()["homogenize"]["phases"]
        return 1 / sum(phase["fraction"] / (voigt(phase["stiffness"])[0, 0]) for phase in phases.values()) - self.SHEAR

    def test_quadrilaterals_do_not_lock(self):
        errors = []
        for elements in (12, 24):
            array(self.folder / "cell.msh", 0.3, elements, filled=True, quadrilaterals=True)
            said = self.run_cell(**self.MATRIX, **self.DISCS, ranks=elements // 12)
            constants = self.effective()["homogenize"]["engineering_constants"]
            errors.append(abs(constants["bulk"] / self.exact_bulk() - 1))
            self.assertLess(abs(constants["shear_least"] / self.SHEAR - 1), 2e-2)
            self.assertNotIn("VIOLATED", said)
            self.assertNotIn("doubt", self.effective())
        self.assertLess(errors[0], 5e-3)
        self.assertLess(errors[1], 0.4 * errors[0])
        report("Nearly incompressible matrix, nu = .4999999, around discs of equal shear modulus, f .3, Q1 (B-bar)",
               "k relative to Hill's, 24 elements per cell", "1 +- .2 %",
               f"{1 + errors[1]:.5f}" if constants["bulk"] > self.exact_bulk() else f"{1 - errors[1]:.5f}", "Hill 1964",
               f"{np.log2(errors[0] / errors[1]):.1f}")

    def test_triangles_lock_and_say_so(self):
        self.draw_cell(self.folder / "cell.msh")
        said = self.run_cell(**self.MATRIX, **QUICK)
        self.assertIn("warning: region 'matrix' is nearly incompressible and meshed in triangles, which lock", said)
        self.assertIn("region 'matrix' is nearly incompressible", self.effective()["doubt"])
        if "VIOLATED" in said:
            self.assertIn("violates its Hashin-Shtrikman bounds", self.effective()["doubt"])
        block(self.folder / "block.msh")
        outcome = self.slide("-mesh_file", "block.msh", "-material_file", "out/effective.yaml", "-boundary_top_y",
                             "fixed", "-time_end", "1e-9", "-output_folder", "slid")
        self.assertEqual(outcome.codes, [0], outcome.err)
        self.assertIn("DOUBTFUL: region 'matrix' is nearly incompressible", outcome.out)

    def test_sound_cells_are_not_doubted(self):
        self.draw_cell(self.folder / "cell.msh")
        self.run_cell(**QUICK)
        self.assertNotIn("doubt", self.effective())


class Holes(Cells):
    def moduli(self, folder="out", boundary="periodic"):
        c = self.stiffness(boundary, folder)
        return np.array([(c[0, 0] + c[1, 1]) / 2, (c[0, 1] + c[1, 0]) / 2, c[2, 2]])

    def test_converge_to_the_exact_moduli(self):
        """Second order, as polygons and linear elements are; the meshes are not nested."""
        for fraction in (0.2, 0.4):
            exact = SquareArrayOfHoles(fraction, 30e9, 0.3).stiffness()
            for quadrilaterals in (False, True):
                errors = []
                for elements in (16, 32, 64):
                    array(self.folder / "cell.msh", fraction, elements, quadrilaterals=quadrilaterals)
                    self.run_cell(**ALONE, **QUICK, ranks=2 if elements == 32 else 1)
                    errors.append(np.max(np.abs(self.moduli() / exact - 1)))
                with self.subTest(fraction=fraction, quadrilaterals=quadrilaterals, errors=errors):
                    order = np.log2(errors[0] / errors[2]) / 2
                    self.assertLess(errors[2], 5e-3)
                    self.assertGreater(order, 1.7)
                    report(f"Square array of holes, f {fraction}, 30 GPa, nu .3", "C11; C12; C66, GPa, 64 "
                           f"{'Q1' if quadrilaterals else 'P1'} elements per cell",
                           "; ".join(f"{1e-9 * c:.6g}" for c in exact) + " +- .5 %",
                           "; ".join(f"{1e-9 * c:.6g}" for c in self.moduli()), "complex potentials, holes_exact.py",
                           f"{order:.2f}")

    def test_are_the_limit_of_soft_phases(self):
        array(self.folder / "hollow.msh", 0.3, 24)
        array(self.folder / "filled.msh", 0.3, 24, filled=True)
        for boundary in ("periodic", "kubc", "subc"):
            self.run_cell(**ALONE, **QUICK, mesh_file="hollow.msh", cell_boundary=boundary)
            self.run_cell(**{**QUICK, "material_inclusion_young": 30e3, "material_inclusion_poisson": 0.3},
                          mesh_file="filled.msh", cell_boundary=boundary, output_folder="soft")
            self.assert_equal(self.stiffness(boundary), self.stiffness(boundary, "soft"), 1e-3, boundary)

    def test_across_the_seam(self):
        """The same array with its holes cut by all sides; on 1 and 2 ranks, with the same numbers."""
        exact = SquareArrayOfHoles(0.3, 30e9, 0.3).stiffness()
        array(self.folder / "cell.msh", 0.3, 40, centres=CORNERS)
        self.run_cell(**ALONE, **QUICK, output_folder="one")
        self.run_cell(**ALONE, **QUICK, ranks=2)
        self.assertLess(np.max(np.abs(self.moduli() / exact - 1)), 1e-2)
        self.assert_equal(self.stiffness("periodic"), self.stiffness("periodic", "one"), SOLVER)
        facts = self.effective()["homogenize"]
        self.assertAlmostEqual(facts["area"], SIDE ** 2, delta=1e-9 * SIDE ** 2)
        self.assertAlmostEqual(facts["phases"]["holes"]["fraction"], 0.3, delta=2e-3)

    def test_identities(self):
        """⟨A⟩ = I with the holes, Hill and Mandel, and the order of the conditions."""
        array(self.folder / "cell.msh", 0.3, 20)
        said = self.run_cell(**ALONE, **QUICK, cell_boundary="all")
        facts = self.effective()["homogenize"]
        for boundary in ("periodic", "kubc", "subc"):
            self.assertLess(facts[boundary]["mean_localisation_defect"], 1e-10)
            self.assertLess(facts[boundary]["hill_mandel_residual"], SOLVER)
        self.assertLess(facts["two_phase_identity"], 1e-8)
        self.assertNotIn("VIOLATED", said)
        self.assertRegex(said, r"subc <= periodic +ok")
        self.assertRegex(said, r"periodic <= kubc +ok")
        np.testing.assert_allclose(self.effective()["density"], 0.7 * 2000, rtol=5e-3)

    def test_a_pore_from_side_to_side_is_refused(self):
        (self.folder / "pore.geo").write_text(
            'SetFactory("OpenCASCADE"); L = 1e-3;\n'
            "Rectangle(1) = {0, 0, 0, L, 0.6*L}; Periodic Curve{2} = {4} Translate{L, 0, 0};\n"
            'Physical Surface("matrix") = {1}; Mesh.MeshSizeMax = 1e-4;\n')
        subprocess.run(["gmsh", "-v", "1", "-2", "-format", "msh41", "pore.geo", "-o", "cell.msh"], check=True,
                       cwd=self.folder, stdin=subprocess.DEVNULL)
        outcome = self.homogenize(*arguments_of({**RUN, **ALONE, **QUICK}))
        self.assert_refused("homogenize", outcome, ["periodic along one axis only"], 1)


if __name__ == "__main__":
    unittest.main()
