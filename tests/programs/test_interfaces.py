"""Tractions along the interfaces of inclusions: interfaces.h5, .xdmf and .yaml of `slide`. Of `relocalize`:
test_relocalize_interfaces.py; of the recovery itself: tests/record/interfaces.cpp."""

import unittest
import xml.etree.ElementTree

import numpy as np
import yaml
from running import InScratch, arguments_of, datasets
from scenes import SIDE, SQUEAL, block

RADIUS = 0.8e-3
COMPOSITE = {**SQUEAL, **{name: None for name in SQUEAL if name.startswith("material_")},
             **{f"material_{region}_{name}": value for region, young, density in
                (("matrix", 30e9, 1800), ("inclusion", 80e9, 3000))
                for name, value in (("young", young), ("poisson", 0.25), ("density", density))}}
FOLLOWED = {**COMPOSITE, "interfaces_region": "inclusion", "interfaces_every": 20}
STRONG = {"interfaces_normal_strength": 2e6, "interfaces_shear_strength": 3e6}
CENTRES = ((1.5e-3, 1.4e-3), (3.5e-3, 3.3e-3))


def discs(folder, program, size=0.25e-3):
    """A block with two discs away from its sides, of triangles."""
    lines = [f"L = {SIDE}; h = {size}; Point(1) = {{0,0,0,h}}; Point(2) = {{L,0,0,h}}; Point(3) = {{L,L,0,h}};"
             "Point(4) = {0,L,0,h}; Line(1) = {1,2}; Line(2) = {2,3}; Line(3) = {3,4}; Line(4) = {4,1};"
             "Curve Loop(1) = {1,2,3,4};"]
    for k, (x, y) in enumerate(CENTRES):
        p, c = 10 * (k + 1), 100 * (k + 1)
        lines.append(f"Point({p}) = {{{x},{y},0,h}};")
        for q, (dx, dy) in enumerate(((1, 0), (0, 1), (-1, 0), (0, -1))):
            lines.append(f"Point({p + 1 + q}) = {{{x + dx * RADIUS},{y + dy * RADIUS},0,h}};")
        lines += [f"Circle({c + q}) = {{{p + 1 + q},{p},{p + 1 + (q + 1) % 4}}};" for q in range(4)]
        lines.append(f"Curve Loop({c}) = {{{c}:{c + 3}}}; Plane Surface({c}) = {{{c}}};")
    lines.append('Plane Surface(1) = {1, 100, 200}; Physical Surface("matrix") = {1};'
                 'Physical Surface("inclusion") = {100, 200}; Physical Curve("bottom") = {1}; Physical Curve("top") = {3};'
                 'Physical Curve("left") = {4}; Physical Curve("right") = {2};')
    (folder / "discs.geo").write_text("\n".join(lines) + "\n")
    program("gmsh", "-v", "1", "-2", "-format", "msh41", "discs.geo", "-o", "block.msh")


class Interfaces(InScratch):
    def setUp(self):
        super().setUp()
        discs(self.folder, self.launch)

    def read(self, folder="out", file="interfaces.h5"):
        return datasets(self.folder / folder / file)

    def test_balance_the_motion_of_each_inclusion(self):
        """Σ m (v_{n+1} − v_n)/Δt = ½(F_n + F_{n+1}) under central difference, by the frames of every step."""
        self.run_scene({**FOLLOWED, "interfaces_every": 1, "fields_every": 1, "fields_quantities": "v", "time_end": 3e-6},
                       ranks=2)
        found, fields = self.read(), self.read(file="fields.h5")
        cells, x, region = fields["mesh/cells"], fields["mesh/coordinates"], fields["mesh/region"]
        a, b, c = (x[cells[:, k]] for k in range(3))
        area = 0.5 * ((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0])
        step = np.diff(found["time"])[5]
        scale = np.abs(found["normal_traction"] * found["length"]).sum(axis=1).max()
        for k, centre in enumerate(found["inclusions/centre"]):
            own = (np.hypot(*((a + b + c) / 3 - centre).T) < RADIUS) & (region == 1)
            mass = np.zeros(len(x))
            for corner in range(3):
                np.add.at(mass, cells[own, corner], 3000 * area[own] / 3)
            self.assertAlmostEqual(area[own].sum() / found["inclusions/area"][k], 1, delta=1e-12)
            momentum = np.array([mass @ fields[f"frames/{n:05d}/v"][:, :2] for n in range(len(found["time"]))])
            force = found["inclusions/force"][:, k]
            taken, given = np.diff(momentum, axis=0)[3:] / step, 0.5 * (force[1:] + force[:-1])[3:]
            self.assertGreater(np.abs(taken).max(), 1e-3 * scale)
            np.testing.assert_allclose(taken, given, rtol=0, atol=1e-10 * scale)

    def test_have_the_same_bits_on_any_number_of_ranks_and_after_a_restart(self):
        scene = {**FOLLOWED, **STRONG, "damping_mass": 1e4, "time_end": 20e-6, "fields_interval": 5e-6}
        self.run_scene(scene, output_folder="alone")
        for ranks in (2, 3):
            self.run_scene(scene, output_folder=f"cut{ranks}", ranks=ranks)
        self.run_scene(scene, output_folder="halves", ranks=2, time_end=9.9e-6)
        outcome = self.slide("-restart", "halves", "-time_end", scene["time_end"], ranks=3)
        self.assertEqual((outcome.codes, outcome.err), ([0, 0, 0], ""), outcome.out)
        alone = self.read("alone")
        self.assertGreater(np.abs(alone["shear_traction"]).max(), 1e5)
        for folder in ("cut2", "cut3", "halves"):
            other = self.read(folder)
            self.assertEqual(alone.keys(), other.keys())
            for name in alone:
                self.assertEqual(alone[name].tobytes(), other[name].tobytes(), f"{folder}: {name}")
            for file in ("interfaces.yaml", "interfaces.xdmf"):
                self.assertEqual((self.folder / "alone" / file).read_text(), (self.folder / folder / file).read_text())

    def test_debonding(self):
        out = self.run_scene({**FOLLOWED, **STRONG}, ranks=2).out
        self.assertRegex(out, r"of interfaces.h5 every 20 steps \(.*\): interfaces of 2 inclusions of region 'inclusion'")
        found = self.read()
        normal, shear = found["normal_traction"], found["shear_traction"]
        index = (np.maximum(normal, 0) / 2e6) ** 2 + (shear / 3e6) ** 2
        np.testing.assert_allclose(found["index"], index, rtol=1e-13, atol=1e-15)
        report = yaml.safe_load((self.folder / "out" / "interfaces.yaml").read_text())
        summary = yaml.safe_load((self.folder / "out" / "summary.yaml").read_text())
        self.assertEqual(report["inclusions"], 2)
        np.testing.assert_allclose([report["peaks"][f"inclusion_{k}"]["centre"] for k in (0, 1)], CENTRES, rtol=2e-2)
        over = index >= 1
        self.assertTrue(over.any(), "nothing debonds")
        row = int(np.argmax(over.any(axis=1)))
        node = int(np.argmax(index[row]))
        self.assertRegex(report["first"], rf"^inclusion {int(found['inclusion'][node])} debonds first: index ")
        self.assertIn(f"t = {found['time'][row]:.6g} s", report["first"])
        self.assertEqual(summary["interfaces"], report["first"])
        for k in (0, 1):
            own = found["inclusion"] == k
            self.assertAlmostEqual(report["peaks"][f"inclusion_{k}"]["normal"][0] / normal[:, own].max(), 1, delta=1e-5)
            self.assertAlmostEqual(report["peaks"][f"inclusion_{k}"]["shear"][0] / np.abs(shear[:, own]).max(), 1, delta=1e-5)
        weaker = {**STRONG, "interfaces_normal_strength": 1e15, "interfaces_shear_strength": 1e15}
        self.run_scene({**FOLLOWED, **weaker}, time_end=2e-6)
        self.assertRegex((self.folder / "out" / "interfaces.yaml").read_text(), 'first: "no inclusion debonds; inclusion . comes')
        document = xml.etree.ElementTree.parse(self.folder / "out" / "interfaces.xdmf")
        self.assertEqual(len(document.findall(".//Time")), len(self.read()["time"]))

    def test_what_hardly_is_an_answer_is_said_so(self):
        """Rows of start and end alone; the region of the matrix."""
        out = self.run_scene({**FOLLOWED, "interfaces_every": None, "interfaces_interval": 1}, time_end=1e-6, ranks=2).out
        self.assertIn("nothing between start and end is recorded in interfaces.h5 (-interfaces_interval 1 s)", out)
        self.assertRegex((self.folder / "out" / "interfaces.yaml").read_text(), r"first: .*\(2 rows were looked at\)")
        out = self.run_scene({**FOLLOWED, "interfaces_region": "matrix"}, time_end=1e-6, ranks=2).out
        doubt = "-interfaces_region matrix: 1 of the 1 inclusions that it makes lies around other regions"
        self.assertEqual(out.count(f"note: {doubt}"), 1)
        self.assertIn(doubt, (self.folder / "out" / "summary.yaml").read_text())
        self.assertNotIn("lies around", self.run_scene(FOLLOWED, time_end=1e-6).out)

    def test_of_a_uniform_state(self):
        """Equal phases under uniform stress, which the inclusions do not feel: t = σ n."""
        same = {f"material_inclusion_{name}": value for name, value in (("young", 30e9), ("poisson", 0.25), ("density", 1800))}
        pressure = 1e6
        c22, c12 = 30e9 * 0.75 / (1.25 * 0.5), 30e9 * 0.25 / (1.25 * 0.5)
        free = {name: None for name in SQUEAL if name.startswith(("surface_", "friction_"))}
        self.run_scene({**FOLLOWED, **same, **free, "initial_pressure": pressure, "time_end": 1e-8, "boundary_top_y": "fixed",
                        "boundary_top_ramp": None, "boundary_bottom_y": "fixed", "boundary_left_x": "fixed",
                        "boundary_right_x": "fixed", "interfaces_every": 1}, ranks=2)
        found = self.read()
        n = found["normal"]
        sxx, syy = -pressure * c12 / c22, -pressure
        for row in range(len(found["time"])):
            np.testing.assert_allclose(found["normal_traction"][row], sxx * n[:, 0] ** 2 + syy * n[:, 1] ** 2,
                                       rtol=0, atol=1e-6 * pressure)
            np.testing.assert_allclose(found["shear_traction"][row], (syy - sxx) * n[:, 0] * n[:, 1], rtol=0,
                                       atol=1e-6 * pressure)

    def test_refusals(self):
        for changes, words in (
                ({"interfaces_region": "fibre"}, ["-interfaces_region is fibre", "'matrix', 'inclusion'"]),
                ({"interfaces_region": None}, ["-interfaces_every", "without -interfaces_region"]),
                ({"interfaces_normal_strength": 1e6}, ["-interfaces_normal_strength without", "give the other"]),
                ({"interfaces_interval": 1e-7}, ["-interfaces_every contradicts -interfaces_interval"])):
            with self.subTest(changes):
                self.assert_refused("slide", self.slide(*arguments_of({**FOLLOWED, **changes}), ranks=2), words, 2)
        block(self.folder / "block.msh")
        outcome = self.slide(*arguments_of({**SQUEAL, "interfaces_region": "block"}), ranks=2)
        self.assert_refused("slide", outcome, ["the only region of the mesh", "give the mesh of a composite"], 2)


if __name__ == "__main__":
    unittest.main()
