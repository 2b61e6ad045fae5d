"""The state at the start from a file: frames of a run on another mesh, and tables. Expected values are those of the fields
that were written: linear ones are met exactly by any cells, bilinear ones by squares."""

import shutil
import unittest

import numpy as np
from running import InScratch, arguments_of, datasets
from scenes import SIDE, block

YOUNG, DENSITY = 45e9, 1800
BODY = {"mesh_file": "block.msh", "material_all_young": YOUNG, "material_all_poisson": 0, "material_all_density": DENSITY,
        "time_step": 2e-8, "time_end": 4e-7, "fields_every": 10, "history_every": 1}
LINEAR = {"initial_displacement": "1e-7*x/L + 2e-7*y/H, 3e-7*x/L - 4e-7*y/H", "initial_velocity": "0.1*y/H, 0.2*x/L - 0.1"}


def linear(x, y):
    x, y = x / SIDE, y / SIDE
    return np.stack([1e-7 * x + 2e-7 * y, 3e-7 * x - 4e-7 * y], 1), np.stack([0.1 * y, 0.2 * x - 0.1], 1)


class InitialFile(InScratch):
    def setUp(self):
        super().setUp()
        block(self.folder / "block.msh")

    def frame(self, folder="out", number=0):
        seen = datasets(self.folder / folder / "fields.h5")
        return [seen["mesh/coordinates"], *(seen[f"frames/{number:05}/{name}"][:, :2] for name in "uv")]

    def table(self, x, y, name="state.csv", head="x,y,ux,uy,vx,vy", values=linear):
        x, y = (each.ravel() for each in np.meshgrid(x, y))
        u, v = values(x, y)
        order = np.random.default_rng(1).permutation(len(x))
        rows = [",".join(repr(float(number)) for number in row) for row in np.column_stack([x, y, u, v])[order]]
        (self.folder / name).write_text("\n".join([head, *rows]) + "\n")

    def test_a_run_on_another_mesh(self):
        self.run_scene({**BODY, **LINEAR, "output_folder": "before"})
        for cells, divisions in (("quadrilaterals", 8), ("triangles", 11), ("mixed", 6)):
            regions = ("block",) if cells != "mixed" else ("lower", "upper")
            block(self.folder / "other.msh", regions=regions, cells=cells, divisions=divisions)
            for ranks in (1, 2, 3):
                outcome = self.run_scene({**BODY, "mesh_file": "other.msh", "initial_file": "before", "initial_time": 0,
                                          "output_folder": f"out{ranks}"}, ranks=ranks)
                self.assertIn("initial state: frame of t = 0 s of 'before/fields.h5'", outcome.out)
                x, u, v = self.frame(f"out{ranks}")
                expected = linear(*x.T)
                np.testing.assert_allclose(u, expected[0], atol=1e-20)
                np.testing.assert_allclose(v, expected[1], atol=1e-14)
            for file in ("history.h5", "fields.h5"):
                one, two, three = (datasets(self.folder / f"out{ranks}" / file) for ranks in (1, 2, 3))
                for name in one:
                    self.assertEqual(one[name].tobytes(), two[name].tobytes(), name)
                    self.assertEqual(one[name].tobytes(), three[name].tobytes(), name)

    def test_the_last_frame_without_a_time_and_added_to_the_others(self):
        self.run_scene({**BODY, **LINEAR, "output_folder": "before"})
        self.run_scene({**BODY, "initial_file": "before/fields.h5", "initial_displacement": "1e-6, 0", "initial_velocity": "0, 1"}, ranks=2)
        x, u, v = self.frame()
        _, last_u, last_v = self.frame("before", 2)
        np.testing.assert_allclose(u, last_u + [1e-6, 0], atol=1e-20)
        np.testing.assert_allclose(v, last_v + [0, 1], atol=1e-14)

    def test_a_table(self):
        """Bilinear between its points; lines in any order. Without columns for it nothing moves."""
        def bilinear(x, y):
            u, v = linear(x, y)
            return u + 1e-7 * (x * y / SIDE**2)[:, None], v
        self.table([0, 0.3 * SIDE, SIDE], [0, 0.8 * SIDE, SIDE], values=bilinear)
        for ranks in (1, 2):
            outcome = self.run_scene({**BODY, "initial_file": "state.csv"}, ranks=ranks)
            self.assertIn("initial state: 3 x 3 points of 'state.csv'", outcome.out)
            x, u, v = self.frame()
            np.testing.assert_allclose(u, bilinear(*x.T)[0], atol=1e-20)
            np.testing.assert_allclose(v, bilinear(*x.T)[1], atol=1e-14)
        (self.folder / "state.csv").write_text(f'# metres\n"x", "y", "v"\n0,0,0\n{SIDE},0,0\n0,{SIDE},1e-6\n\n{SIDE},{SIDE},1e-6\n')
        self.run_scene({**BODY, "initial_file": "state.csv"})
        plain = (self.folder / "state.csv").read_text()
        (self.folder / "state.csv").write_text("\ufeff" + plain.split("\n", 1)[1], encoding="utf-8")  # as spreadsheets write it
        self.run_scene({**BODY, "initial_file": "state.csv"})
        x, u, v = self.frame()
        np.testing.assert_allclose(u, np.stack([0 * x[:, 0], 1e-6 * x[:, 1] / SIDE], 1), atol=1e-20)
        self.assertEqual(np.abs(v).max(), 0)

    def test_what_is_out_of_equilibrium_is_said(self):
        """A column under p that stands, and the same with a bit more than p."""
        pressed = {**BODY, "boundary_bottom_y": "fixed", "boundary_top_pressure": YOUNG * 1e-4, "initial_file": "state.csv"}
        squeezed = lambda x, y: (np.stack([0 * x, -1e-4 * y], 1), np.zeros((len(x), 2)))
        self.table([0, SIDE], [0, SIDE], values=squeezed)
        for ranks in (1, 2):
            outcome = self.run_scene(pressed, ranks=ranks)
            self.assertNotIn("equilibrium", outcome.out)
            outcome = self.run_scene({**pressed, "boundary_top_pressure": YOUNG * 1.01e-4}, ranks=ranks)
            # .01 p on the edge of a node beside .p on that of a cell
            self.assertRegex(outcome.out, r"note: the initial state is not in equilibrium: a force of 28\.1 N/m is left on the node at x = "
                                          r".*, 0\.01 of the largest that stress makes on the side of a cell")

    def test_the_tolerance(self):
        for outside, fine in ((0.5e-6, True), (2e-6, False)):
            self.table([0, SIDE], [0, SIDE * (1 - outside)])
            outcome = self.slide(*arguments_of({**BODY, "initial_file": "state.csv"}), ranks=2)
            if fine:
                self.assertEqual(outcome.codes, [0, 0], outcome.err)
            else:
                self.assert_refused("slide", outcome, [f"y = {SIDE} m lies 1e-08 m outside of 'state.csv'", "5e-09 m"], 2)

    def test_a_run_goes_on_with_the_same_file_only(self):
        self.run_scene({**BODY, **LINEAR, "output_folder": "before"})
        scene = {**BODY, "initial_file": "before", "boundary_top_y": -1e-7, "boundary_top_ramp": 2e-7}
        self.run_scene(scene, ranks=2, output_folder="whole")
        for folder in ("halves", "others"):
            self.run_scene({**scene, "time_end": 2e-7}, output_folder=folder)
        outcome = self.slide("-restart", "halves", "-time_end", 4e-7, ranks=2)
        self.assertEqual(outcome.codes, [0, 0], outcome.err)
        for file in ("history.h5", "fields.h5"):
            one, two = (datasets(self.folder / folder / file) for folder in ("whole", "halves"))
            for name in one:
                self.assertEqual(one[name].tobytes(), two[name].tobytes(), name)
        shutil.rmtree(self.folder / "before")
        self.run_scene({**BODY, "initial_velocity": "1,0", "output_folder": "before"})
        outcome = self.slide("-restart", "others", "-time_end", 4e-7, ranks=2)
        self.assert_refused("slide", outcome, ["-initial_file", "put back that file"], 2)

    def test_refused(self):
        self.run_scene({**BODY, "output_folder": "before"})
        self.run_scene({**BODY, "fields_quantities": "u", "output_folder": "still"})
        corners = f"0,0,0,0\n{SIDE},0,0,0\n0,{SIDE},0,0\n{SIDE},{SIDE},0,0\n"
        for content, changes, words in (
                ("", {}, ["holds no points", "columns named x, y"]),
                ("x,y,ux,w\n", {}, ["has a column 'w'"]),
                ("x,ux,uy\n1,2,3\n", {}, ["has no column 'y'"]),
                ("x,y,u,ux\n", {}, ["names column 'ux' twice"]),
                ("x,y,ux,uy\n" + corners + "0.5e-3,1e-3,0,0\n", {}, ["5 points, but 3 different x and 3 different y", "every x with every y"]),
                ("x,y,ux,uy\n" + corners.replace(f"\n0,{SIDE},", f"\n{SIDE},{SIDE},"), {}, ["two points at x = 0.005 m, y = 0.005 m"]),
                ("x,y,ux,uy\n0,0,0,0\n0,1,0,0\n", {}, ["1 different x"]),
                ("x,y,ux,uy\n0,0,0\n", {}, ["line 2: 3 numbers in 4 columns"]),
                ("x,y,ux,uy\n0,0,0,nan\n", {}, ["line 2: 'nan' is no number below 1e100"]),
                ("x,y,ux,uy\n0,0,0,1e300\n", {}, ["line 2: '1e300' is no number below 1e100"]),
                ("x,y\n0,0\n", {}, ["has nothing but places; it needs columns named x, y and any of ux"]),
                ("x,y,ux,uy\n" + corners, {"initial_time": 0}, ["-initial_time has no effect with a table"]),
                ("x,y,ux,uy\n" + corners.replace(str(SIDE), str(SIDE / 2)), {}, ["the node at x = ", "m outside of 'state.csv'"]),
                (None, {"initial_file": "nowhere.csv"}, ["-initial_file", "nowhere.csv"]),
                (None, {"initial_file": "nowhere"}, ["there is no file 'nowhere' (-initial_file)"]),
                (None, {"initial_file": "block.msh"}, ["'block.msh' (-initial_file) is not an HDF5 file"]),
                (None, {"initial_file": "before/history.h5"}, ["-initial_file", "has no /mesh/coordinates"]),
                (None, {"initial_file": "before", "initial_time": 1.2e-7}, ["has no frame at 1.2e-07 s", "the nearest is that of 2e-07 s", "-initial_time"]),
                (None, {"initial_file": "still"}, ["has no v", "-fields_quantities"]),
                (None, {"initial_file": "before", "output_folder": "before"}, ["-initial_file lies in 'before'", "-output_folder"]),
                (None, {"initial_file": None, "initial_time": 1e-7}, ["-initial_time has no effect without -initial_file"])):
            with self.subTest(content=content, changes=changes):
                if content is not None:
                    (self.folder / "state.csv").write_text(content)
                outcome = self.slide(*arguments_of({**BODY, "initial_file": "state.csv", **changes}), ranks=2)
                self.assert_refused("slide", outcome, words, 2)


if __name__ == "__main__":
    unittest.main()
