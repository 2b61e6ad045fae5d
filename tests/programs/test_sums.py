"""Where the work goes: sums over every step in contact.h5, the work of bulk damping by cell, and what `slipscale wear`
makes of them. The sums of the program alone: tests/dynamics/sums.cpp; formulas of wear: runs/tests/wearing."""

import os
import unittest

import numpy as np
from finding import report
from running import InScratch, arguments_of, datasets, h5py
from scenes import SIDE, SQUEAL, block

COMMAND = os.environ["SLIPSCALE_COMMAND"]
COMPOSITE = {**SQUEAL, **{name: None for name in SQUEAL if name.startswith("material_")},
             **{f"material_{region}_{name}": value for region, young in (("matrix", 30e9), ("inclusion", 80e9))
                for name, value in (("young", young), ("poisson", 0.25), ("density", 1800))}}
DAMPED = {"fields_interval": 5e-6, "fields_quantities": "u,damping_work", "statistics_from": 5e-6, "statistics_to": 35e-6,
          "statistics_damping": "true"}


def areas(fields):
    corners = fields["mesh/coordinates"][fields["mesh/cells"]]
    after = np.roll(corners, -1, axis=1)
    return 0.5 * np.abs((corners[..., 0] * after[..., 1] - after[..., 0] * corners[..., 1]).sum(axis=1))


class Sums(InScratch):
    def read(self, name, folder="out"):
        return datasets(self.folder / folder / name)

    def test_add_up_to_the_ledger_at_every_row(self):
        block(self.folder / "block.msh", divisions=12)
        self.run_scene(SQUEAL, ranks=2, contact_every=5)
        contact, history = self.read("contact.h5"), self.read("history.h5")
        np.testing.assert_array_equal(contact["time"], history["time"])
        length, scale = contact["tributary_length"], history["energy/flowed"].max()
        for name, term in {"friction_work": "friction_heat", "impact_loss": "impact_loss"}.items():
            total = contact[f"sums/{name}"] @ length
            self.assertLess(np.abs(total - history[f"energy/{term}"]).max(), 1e-14 * scale)
            self.assertGreater(total[-1], 1e-4 * scale)
        # Nodes meet and part: fractions of the rows tell about how long, every step tells exactly.
        closed = contact["sums/time_closed"] @ length / length.sum() / contact["time"][-1]
        self.assertAlmostEqual(closed[-1], 1 - history["contact/open"].mean(), delta=5e-3)
        self.assertGreater(contact["sums/closures"][-1].max(), 3)
        self.assertTrue(np.all(np.diff(contact["sums/closures"], axis=0) >= 0))
        # While it rubs against a surface of speed V nothing slips further than V t.
        self.assertLessEqual(contact["sums/slip_distance"].max(), 3 * 2 * contact["time"][-1])

    def test_of_every_step_whatever_the_rows(self):
        block(self.folder / "block.msh")
        every = {**SQUEAL, "contact_every": 1, "history_every": 1, "time_step": 2e-8}
        self.run_scene(every, output_folder="every")
        self.run_scene(every, output_folder="few", contact_every=500)
        every, few = self.read("contact.h5", "every"), self.read("contact.h5", "few")
        for name in (name for name in every if name.startswith("sums/")):
            self.assertEqual(every[name][::500].tobytes(), few[name][:5].tobytes(), name)
        step = np.diff(every["time"])[:, None]
        closed = every["status"][:-1] > 0
        np.testing.assert_allclose(every["sums/impulse"][-1], (every["normal_traction"][:-1] * step).sum(axis=0), rtol=1e-12)
        np.testing.assert_allclose(every["sums/time_closed"][-1], (closed * step).sum(axis=0), rtol=1e-12)
        slip = np.abs(2 * step - np.diff(every["u"][..., 0], axis=0)) * (every["status"][:-1] == 2)
        np.testing.assert_allclose(every["sums/slip_distance"][-1], slip.sum(axis=0), rtol=1e-9)
        np.testing.assert_allclose(every["sums/pressure_slip"][-1], (slip * every["normal_traction"][:-1]).sum(axis=0),
                                   rtol=1e-9)
        began = closed & ~np.vstack([np.zeros((1, closed.shape[1]), bool), closed[:-1]])
        np.testing.assert_array_equal(every["sums/closures"][-1], began.sum(axis=0))

    def test_of_a_composite_have_the_same_bits_on_any_number_of_ranks(self):
        block(self.folder / "block.msh", regions=("matrix", "inclusion"), cells="mixed", divisions=12, periodic=True)
        scene = {**COMPOSITE, **DAMPED, "damping_mass": 1e4, "contact_every": 20}
        self.run_scene(scene, output_folder="alone")
        alone = {file: self.read(file, "alone") for file in ("contact.h5", "fields.h5", "statistics.h5")}
        self.assertIn("sums/friction_work", alone["contact.h5"])
        for ranks in (2, 3):
            self.run_scene(scene, output_folder="cut", ranks=ranks)
            for file, left in alone.items():
                right = self.read(file, "cut")
                self.assertEqual(left.keys(), right.keys())
                for name in left:
                    self.assertEqual(left[name].tobytes(), right[name].tobytes(), f"{file}: {name}, {ranks} ranks")

    def test_regions_of_the_nodes(self):
        """A strip below that is half of each: the node between has half of its length in either."""
        (self.folder / "halves.geo").write_text(
            f"L = {SIDE}; Point(1) = {{0,0,0}}; Point(2) = {{L/2,0,0}}; Point(3) = {{L,0,0}}; Point(4) = {{L,L/2,0}};"
            "Point(5) = {L/2,L/2,0}; Point(6) = {0,L/2,0};"
            "Line(1) = {1,2}; Line(2) = {2,3}; Line(3) = {3,4}; Line(4) = {4,5}; Line(5) = {5,6}; Line(6) = {6,1};"
            "Line(7) = {2,5}; Curve Loop(1) = {1,7,5,6}; Curve Loop(2) = {2,3,4,-7}; Plane Surface(1) = {1};"
            "Plane Surface(2) = {2}; Transfinite Curve{1:7} = 5; Transfinite Surface{1,2};"
            'Physical Surface("matrix") = {1}; Physical Surface("inclusion") = {2}; Physical Curve("bottom") = {1,2};'
            'Physical Curve("top") = {4,5};\n')
        self.launch("gmsh", "-v", "1", "-2", "-format", "msh41", "halves.geo", "-o", "block.msh")
        for ranks in (1, 2):
            self.run_scene({**COMPOSITE, "history_points": None}, time_end=1e-6, ranks=ranks)
            share = self.read("contact.h5")["region_share"]
            with h5py.File(self.folder / "out" / "contact.h5") as file:
                names = file.attrs["regions"]
            names = (names.decode() if isinstance(names, bytes) else names).split("\n")
            inclusion = share[:, names.index("inclusion")]
            np.testing.assert_allclose(inclusion, [0, 0, 0, 0, 0.5, 1, 1, 1, 1], rtol=0, atol=1e-10)
            np.testing.assert_array_equal(share.sum(axis=1), 1)

    def test_left_out(self):
        block(self.folder / "block.msh")
        self.run_scene(SQUEAL, contact_sums="false", time_end=1e-6)
        self.assertFalse([name for name in self.read("contact.h5") if name.startswith("sums")])
        outcome = self.launch(COMMAND, "wear", "out", "wear", "--energy", "1e-14")
        self.assert_refused("slipscale wear", outcome, ["contact.h5 has no sums/friction_work", "-contact_sums true"], 1)


class DampingOfCells(InScratch):
    def read(self, name):
        return datasets(self.folder / "out" / name)

    def test_adds_up_to_the_ledger_in_every_frame(self):
        for cells, damping in (("quadrilaterals", {"damping_mass": 1e4}), ("triangles", {}),
                               ("triangles", {"damping_mass": 1e4, "damping_stiffness": None, "time_beta2": 0.7})):
            with self.subTest(cells=cells, damping=damping):
                block(self.folder / "block.msh", divisions=12, cells=cells)
                self.run_scene({**SQUEAL, **DAMPED, **damping}, ranks=2, history_every=1)
                fields, history, statistics = (self.read(name) for name in ("fields.h5", "history.h5", "statistics.h5"))
                area, ledger = areas(fields), dict(zip(history["time"], history["energy/damping"], strict=True))
                works = {}
                for k, time in enumerate(fields["time"]):
                    works[time] = fields[f"frames/{k:05d}/damping_work"]
                    if time in ledger and time > 1e-6:
                        self.assertAlmostEqual(works[time] @ area / ledger[time], 1, delta=1e-11)
                self.assertGreater(sum(time in ledger for time in works), 3)
                with h5py.File(self.folder / "out" / "statistics.h5") as file:
                    begin, end = (file["statistics"].attrs[name] for name in ("from", "to"))
                power = statistics["statistics/damping_power"]
                self.assertEqual(power.shape, area.shape)
                if begin in ledger and end in ledger:
                    self.assertAlmostEqual(power @ area * (end - begin) / (ledger[end] - ledger[begin]), 1, delta=1e-10)
                self.assertIn("damping_power", (self.folder / "out" / "statistics.xdmf").read_text())

    def test_is_refused_where_nothing_damps(self):
        block(self.folder / "block.msh")
        for option, words in {"fields_quantities": ("u,damping_work", "-fields_quantities has damping_work"),
                              "statistics_damping": ("true", "-statistics_damping is true")}.items():
            more = {"fields_every": 100} if option == "fields_quantities" else {"statistics_from": 0}
            outcome = self.slide(*arguments_of({**SQUEAL, **more, "damping_stiffness": None, option: words[0]}), ranks=2)
            self.assert_refused("slide", outcome, [words[1], "nothing damps the body", "-damping_stiffness"], 2)


class Wear(InScratch):
    def wear(self, *words):
        outcome = self.launch(COMMAND, "wear", "out", "wear", *words)
        self.assertEqual((outcome.codes, outcome.err), ([0], ""), outcome.out)
        return outcome.out, datasets(self.folder / "wear" / "wear.h5")

    def test_of_uniform_sliding_is_exact(self):
        """A strip that slides from the start as one: p V t, μ p V t, and the half-space under μ p V."""
        block(self.folder / "block.msh", divisions=8, periodic=True)
        pressure, speed, end = 1e6, 2.0, 20e-6
        scene = {**SQUEAL, "initial_pressure": pressure, "initial_shear": pressure / 2, "boundary_top_x": "fixed",
                 "boundary_top_y": "fixed", "boundary_top_ramp": None, "damping_stiffness": None, "time_end": end,
                 "contact_every": 50}
        self.run_scene(scene, ranks=2)
        _, found = self.wear("--archard", "1e-4", "--hardness", "2e9", "--energy", "1e-14", "--conductivity", "30",
                             "--density", "2400", "--heat-capacity", "800", "--share", "0.5")
        time = found["time"][:, None]
        errors = [np.abs(found["depth/archard"][1:] / (1e-4 / 2e9 * pressure * speed * time[1:]) - 1).max(),
                  np.abs(found["depth/energy"][1:] / (1e-14 * 0.5 * pressure * speed * time[1:]) - 1).max()]
        flux = 0.5 * 0.5 * pressure * speed
        exact = 2 * flux * np.sqrt(time / (np.pi * 30 * 2400 * 800))
        errors.append(np.abs(found["temperature"][1:] / exact[1:] - 1).max())
        self.assertLess(max(errors), 1e-9)
        report("Wear and flash temperature of a strip in uniform sliding",
               "depth by Archard k p V t/H; by energy k_E tau V t; temperature 2 q sqrt(t/(pi k rho c)): largest relative error",
               "<= 1e-9", "; ".join("< 1e-9" if error < 1e-9 else f"{error:.1e}" for error in errors), "exact solution")

    def test_of_a_composite_that_squeals(self):
        block(self.folder / "block.msh", regions=("inclusion", "matrix"), divisions=12)
        self.run_scene(COMPOSITE)
        said, found = self.wear("--energy", "1e-14")
        contact = datasets(self.folder / "out" / "contact.h5")
        np.testing.assert_allclose(found["depth/energy"], 1e-14 * contact["sums/friction_work"], rtol=1e-13)
        self.assertRegex(said, r"depth, by energy")
        self.assertTrue((self.folder / "wear" / "wear.png").exists() and (self.folder / "wear" / "wear.csv").exists())


if __name__ == "__main__":
    unittest.main()
