"""What `modes` says and writes: the same on any number of ranks, and of a sweep the same as one by one."""

import math
import unittest

import h5py
import meshio
from running import arguments_of, datasets
from scenes import block
from squealing import FILES, RUN, Squealing
from test_phases import striped


CELL, SHEAR_SPEED = 5e-3 / 8, math.sqrt(45e9 / 2.5 / 1800)  # m, m/s


class Modes(Squealing):
    def setUp(self):
        super().setUp()
        block(self.folder / "block.msh")

    def assert_same(self, one, other, tolerance):
        for a, b in zip(one, other, strict=True):
            size = math.hypot(2 * math.pi * a["frequency"], a["growth_rate"])
            for quantity, unit in (("frequency", 2 * math.pi), ("growth_rate", 1)):
                self.assertLess(abs(a[quantity] - b[quantity]) * unit, tolerance * size, (a, b))

    def test_is_the_same_on_any_number_of_ranks(self):
        _, one = self.run_modes(modes_scheme="true")
        for ranks in (2, 3):
            _, more = self.run_modes(modes_scheme="true", ranks=ranks, output_folder=f"out{ranks}")
            self.assert_same(one["modes"], more["modes"], 1e-10)
            self.assert_same([mode["scheme"] for mode in one["modes"]], [mode["scheme"] for mode in more["modes"]],
                             1e-10)
            self.assertEqual(one["state"]["nodes_in_contact"], more["state"]["nodes_in_contact"])

    def test_names_what_has_no_meaning(self):
        said, _ = self.run_modes()
        (note,) = [line for line in said.splitlines() if line.startswith("note: no meaning in modes")]
        for option in ("history_every", "history_points", "time_end", "boundary_top_ramp"):
            self.assertIn("-" + option, note)
        self.assertNotIn("-friction", note)

    def test_growth_is_the_work_of_friction_less_that_of_damping(self):
        """Over a period: 2 Re p of the energy, and damping takes b ω² of the strain energy's mean, half of it all."""
        _, found = self.run_modes()
        for mode in found["modes"]:
            omega = 2 * math.pi * mode["frequency"]
            balance = sum(mode["friction_work"].values()) - 2 * math.pi * RUN["damping_stiffness"] * omega / 2 * 2
            self.assertAlmostEqual(balance, 4 * math.pi * mode["growth_rate"] / omega, delta=0.02)

    def test_friction_of_each_phase(self):
        """Equal coefficients are one; others act each where it touches, as does a formula of the place."""
        self.assertEqual(self.launch("gmsh", *striped(self.folder)).codes, [0])
        _, one = self.run_modes()
        _, equal = self.run_modes(friction_matrix_coefficient=0.5, friction_inclusion_coefficient="0.5 + 0*x", ranks=2)
        self.assert_same(one["modes"], equal["modes"], 1e-10)
        own = {"friction_coefficient": None, "friction_matrix_coefficient": 0.2, "friction_inclusion_coefficient": 0.8}
        _, apart = self.run_modes(**own)
        _, ranks = self.run_modes(**own, ranks=2)
        self.assert_same(apart["modes"], ranks["modes"], 1e-10)
        stripes = "0.5 - 0.3*(x < L/4) - 0.3*(x > L/2)*(x < 3*L/4) + 0.3*(x > L/4)*(x < L/2) + 0.3*(x > 3*L/4)"
        _, formula = self.run_modes(friction_coefficient=stripes)
        self.assert_same(apart["modes"], formula["modes"], 1e-9)
        with self.assertRaises(AssertionError):
            self.assert_same(one["modes"], apart["modes"], 1e-3)
        outcome = self.modes(*arguments_of({**RUN, "friction_inclusion_time": 1e-7}), ranks=2)
        self.assert_refused("modes", outcome, ["does not remember as long in region 'inclusion' as in 'matrix'", "-friction_time"], 2)

    def test_a_coefficient_that_falls(self):
        """Level it is that of the surface's speed; falling it feeds every mode, by what friction works more."""
        level = {"friction_law": "exponential", "friction_threshold": None, "friction_kinetic": 0.5, "friction_slip_rate": 1}
        _, one = self.run_modes()
        _, same = self.run_modes(**level)
        self.assert_same(one["modes"], same["modes"], 1e-10)
        falls = {**level, "friction_kinetic": 0.3}
        _, found = self.run_modes(**falls)
        _, ranks = self.run_modes(**falls, modes_scheme="true", ranks=2)
        self.assert_same(found["modes"], ranks["modes"], 1e-10)
        _, level = self.run_modes(friction_coefficient=0.3 + 0.2 * math.exp(-2))
        self.assertGreater(found["modes"][0]["growth_rate"], level["modes"][0]["growth_rate"])
        for mode in found["modes"]:
            omega = 2 * math.pi * mode["frequency"]
            balance = sum(mode["friction_work"].values()) - 2 * math.pi * RUN["damping_stiffness"] * omega / 2 * 2
            self.assertAlmostEqual(balance, 4 * math.pi * mode["growth_rate"] / omega, delta=0.02)

    def test_without_friction_damping_is_all(self):
        """Of a real mode: p = −bω²/2 ± iω√(1 − (bω/2)²)."""
        _, found = self.run_modes(friction_coefficient=0)
        for mode in found["modes"]:
            omega = math.hypot(2 * math.pi * mode["frequency"], mode["growth_rate"])
            self.assertAlmostEqual(mode["growth_rate"] / (-RUN["damping_stiffness"] * omega**2 / 2), 1, delta=1e-8)

    def test_each_point_of_a_path_is_a_mode_of_its_value(self):
        """With as many nodes in contact: a sweep keeps those of the scene's own values."""
        said, swept = self.run_modes(friction_coefficient=0.1, modes_coefficient="0:0.025:0.2")
        self.assertIn("sweep of coefficient", said)
        sweep = swept["sweeps"]["coefficient"]
        self.assertEqual(len(sweep["values"]), 9)
        compared = 0
        for at in (0, 3, 5, 8):
            _, alone = self.run_modes(friction_coefficient=sweep["values"][at], modes_count=40, output_folder="alone")
            self.assertEqual(alone["state"]["nodes_in_contact"], swept["state"]["nodes_in_contact"])
            exponents = [complex(mode["growth_rate"], 2 * math.pi * mode["frequency"]) for mode in alone["modes"]]
            highest = max(p.imag for p in exponents)
            for path in sweep["paths"]:
                p = complex(path["growth_rate"][at], 2 * math.pi * path["frequency"][at])
                if p.imag <= highest:  # also false where a path is lost
                    compared += 1
                    self.assertLess(min(abs(p - other) for other in exponents), 1e-6 * abs(p), (at, p))
        self.assertGreater(compared, 12)
        for limit in sweep["becomes_unstable"]:
            self.assertLessEqual(limit["value"], 0.2)

    def grid_notes(self, said, found):
        """Notes on waves at grid scale: what was said, and what modes.yaml keeps; they must be the same."""
        notes = [line.removeprefix("note: ") for line in said.splitlines() if line.startswith("note: ") and "grid" in line]
        kept = [text for name, text in found["search"].items() if name.startswith("note_") and "grid" in text]
        self.assertEqual(notes, kept)
        return notes

    def test_tells_of_waves_at_grid_scale(self):
        """Of Coulomb's law, and of a memory shorter than the passage of a cell; of none that reaches over two. Cells of
        0.625 mm, c_s = 3.16 km/s."""
        coulomb = {"friction_law": "coulomb", "friction_time": None, "friction_threshold": None}
        (note,) = self.grid_notes(*self.run_modes(**coulomb))
        self.assertIn("no memory (Coulomb's law)", note)
        (note,) = self.grid_notes(*self.run_modes(friction_time=0.9 * CELL / SHEAR_SPEED))
        self.assertIn("short beside the mesh", note)
        self.assertEqual(self.grid_notes(*self.run_modes(friction_time=2.01 * CELL / SHEAR_SPEED)), [])
        self.assertEqual(self.grid_notes(*self.run_modes(friction_coefficient=0, **coulomb)), [])

    def test_tells_where_a_sweep_would_open_nodes(self):
        """The values at which the nodes touch that touch at the scene's own, and no others: each run on its own."""
        values = [0.05, 0.15, 0.25, 0.35, 0.45]
        alone = []
        for value in values:
            _, found = self.run_modes(friction_coefficient=value, output_folder="alone")
            alone.append(found["state"]["nodes_in_contact"])
        self.assertGreater(len(set(alone)), 1)
        own = 2
        said, swept = self.run_modes(friction_coefficient=values[own], modes_coefficient="0.05:0.1:0.45", ranks=2)
        same = [value for value, count in zip(values, alone) if count == alone[own]]
        self.assertEqual([round(value, 9) for value in swept["sweeps"]["coefficient"]["same_contact"]], [same[0], same[-1]])
        (note,) = [line for line in said.splitlines() if "the nodes that touch are those of 0.25" in line]
        self.assertIn(note.removeprefix("note: "), swept["search"].values())
        said, _ = self.run_modes(friction_coefficient=values[own], modes_time="2e-7:2e-7:1e-6")
        self.assertNotIn("the nodes that touch are those", said)

    def test_files(self):
        self.run_modes(modes_time="2e-7:2e-7:1e-6", modes_shapes=2, modes_frames=4)
        self.assertEqual({path.name for path in (self.folder / "out").iterdir()}, FILES)
        found = datasets(self.folder / "out" / "modes.h5")
        self.assertEqual(found["spectrum/frequency"].shape, (5,))
        self.assertEqual(found["sweep/time/growth_rate"].shape[1], 5)
        self.assertEqual(found["contact/normal_real"].shape, (5, len(found["contact/x"])))
        real, imaginary = found["shape/mode_1/real"], found["shape/mode_1/imaginary"]
        rounding = 1e-15 * abs(real).max()
        self.assertLessEqual(abs(found["frames/00001/mode_1"] + imaginary).max(), rounding)  # a quarter of a period on
        self.assertLessEqual(abs(found["frames/00000/mode_1"] - real).max(), rounding)
        with h5py.File(self.folder / "out" / "modes.h5") as file:
            file.visititems(lambda name, item: self.assertTrue(
                isinstance(item, h5py.Group) or {"units", "description"} <= set(item.attrs), name))
        with meshio.xdmf.TimeSeriesReader(self.folder / "out" / "modes.xdmf") as reader:
            reader.read_points_cells()
            self.assertEqual(reader.num_steps, 4)
            self.assertIn("mode_2", reader.read_data(3)[1])


if __name__ == "__main__":
    unittest.main()
