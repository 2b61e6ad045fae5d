"""Meshes as gmsh writes them: whatever the format, a mesh that is read has the same named sets, and what is not read is
refused with the command that makes it readable."""

import re
import shlex
import subprocess
import unittest
from concurrent.futures import ThreadPoolExecutor

import numpy as np
from running import InScratch, arguments_of, datasets

SIZE = "h = 0.25e-3;"
# Groups are numbered in another order than the curves, some curves belong to several, some run backwards.
POINTS = SIZE + """
Point(1) = {0, 0, 0, h}; Point(2) = {2e-3, 0, 0, h}; Point(3) = {2e-3, 1e-3, 0, h}; Point(4) = {0, 1e-3, 0, h};
Line(1) = {1, 2}; Line(2) = {2, 3}; Line(3) = {3, 4}; Line(4) = {4, 1};
"""
SQUARE = POINTS + "Curve Loop(1) = {1:4}; Plane Surface(1) = {1};"
CURVES = 'Physical Curve("bottom") = {1}; Physical Curve("top") = {3}; Physical Curve("left") = {4}; '
MATRIX = 'Physical Surface("matrix") = {1};'
LAYERS = POINTS + """
Point(5) = {2e-3, 2e-3, 0, h}; Point(6) = {0, 2e-3, 0, h}; Line(5) = {3, 5}; Line(6) = {5, 6}; Line(7) = {6, 4};
Curve Loop(1) = {1:4}; Plane Surface(1) = {1}; Curve Loop(2) = {-3, 5, 6, 7}; Plane Surface(2) = {2};
Physical Surface("inclusion", 1) = {2}; Physical Surface("matrix", 2) = {1};
"""
HOLE = POINTS + """
Point(9) = {1e-3, .5e-3, 0, h}; Point(10) = {1.3e-3, .5e-3, 0, h}; Point(11) = {.7e-3, .5e-3, 0, h};
Circle(9) = {10, 9, 11}; Circle(10) = {11, 9, 10}; Curve Loop(2) = {9, 10}; Curve Loop(1) = {1:4};
"""
GEOMETRIES = {
    "square": SQUARE + CURVES + MATRIX,
    "tags": SQUARE + 'Physical Curve("bottom", 3) = {1}; Physical Curve("top", 1) = {3}; '
            'Physical Surface("matrix", 2) = {1};',
    "backwards": SQUARE + 'Physical Curve("bottom") = {-1}; Physical Curve("top") = {-3}; '
                 'Physical Surface("matrix") = {-1};',
    "several": SQUARE + CURVES + 'Physical Curve("around") = {1, -2, 3, 4}; '
               'Physical Curve("sides") = {2, -4};' + MATRIX,
    "quadrilaterals": SQUARE + "Transfinite Surface{1}; Recombine Surface{1};" + CURVES + MATRIX,
    "mixed": LAYERS + "Recombine Surface{1};" + CURVES,
    "layers": LAYERS + 'Physical Curve("bottom", 11) = {1}; Physical Curve("interface", 7) = {3}; '
              'Physical Curve("top", 12) = {6};',
    "hole": HOLE + "Plane Surface(1) = {1, 2};" + CURVES + 'Physical Curve("rim") = {9, -10};' + MATRIX,
    "inclusion": HOLE + "Plane Surface(1) = {1, 2}; Plane Surface(2) = {2};" + CURVES + MATRIX +
    'Physical Surface("inclusion") = {2};',
    "clockwise": POINTS + "Curve Loop(1) = {1, 2, 3, 4}; Reverse Curve{1:4}; Plane Surface(1) = {1};" + CURVES + MATRIX,
    "nameless": SQUARE + "Physical Curve(7) = {1}; Physical Curve(3) = {3}; Physical Surface(5) = {1};",
    "numbers": SQUARE + 'Physical Curve("1") = {1}; Physical Curve("2") = {3}; Physical Surface("matrix") = {1};',
    "second": SQUARE + CURVES + MATRIX + "Mesh.ElementOrder = 2;",
    "periodic": SQUARE + CURVES + MATRIX + "Periodic Curve{2} = {-4} Translate{2e-3, 0, 0};",
}
# gmsh writes no binary MSH 4.0, and no periods in MSH 2.2.
FORMATS = {"text": ["msh41"], "binary": ["msh41", "-bin"], "4.0": ["msh40"],
           "2.2": ["msh22"], "2.2 binary": ["msh22", "-bin"]}
EXPECTED = {  # name: edges or cells' sizes, by the drawing
    "square": {"bottom": 2e-3, "top": 2e-3, "left": 1e-3, "matrix": 2e-6},
    "tags": {"bottom": 2e-3, "top": 2e-3, "matrix": 2e-6},
    "backwards": {"bottom": 2e-3, "top": 2e-3, "matrix": 2e-6},
    "several": {"bottom": 2e-3, "top": 2e-3, "left": 1e-3, "around": 6e-3, "sides": 2e-3, "matrix": 2e-6},
    "quadrilaterals": {"bottom": 2e-3, "top": 2e-3, "left": 1e-3, "matrix": 2e-6},
    "mixed": {"bottom": 2e-3, "top": 2e-3, "left": 1e-3, "inclusion": 2e-6, "matrix": 2e-6},
    "layers": {"bottom": 2e-3, "interface": 2e-3, "top": 2e-3, "inclusion": 2e-6, "matrix": 2e-6},
    "clockwise": {"bottom": 2e-3, "top": 2e-3, "left": 1e-3, "matrix": 2e-6},
    "nameless": {"curve_7": 2e-3, "curve_3": 2e-3, "surface_5": 2e-6},
    "second": {"bottom": 2e-3, "top": 2e-3, "left": 1e-3, "matrix": 2e-6},
    "periodic": {"bottom": 2e-3, "top": 2e-3, "left": 1e-3, "matrix": 2e-6},
}
# Rubbed: all that a run computes, of every set of the mesh.
RUBBED = {"square", "quadrilaterals", "layers", "periodic", "nameless"}
OF_ROUNDING = {"gap": "u", "v_y": "slip_rate", "sums/impact_loss": "sums/friction_work"}
MATERIAL = ["-material_all_young", "30e9", "-material_all_poisson", ".25", "-material_all_density", "1800"]


def shifted(text, by=10**6):
    """The text of a mesh whose node tags begin behind `by`."""
    lines = text.split("\n")

    def section(name, change):
        k, end = lines.index(f"${name}") + 2, lines.index(f"$End{name}")
        while k < end:
            k = change(k)

    def nodes(k):
        count = int(lines[k].split()[3])
        for at in range(k + 1, k + 1 + count):
            lines[at] = str(int(lines[at]) + by)
        return k + 1 + 2 * count

    def elements(k):
        count = int(lines[k].split()[3])
        for at in range(k + 1, k + 1 + count):
            tag, *corners = lines[at].split()
            lines[at] = " ".join([tag, *(str(int(corner) + by) for corner in corners)])
        return k + 1 + count

    def links(k):
        count = int(lines[k + 2])
        for at in range(k + 3, k + 3 + count):
            lines[at] = " ".join(str(int(node) + by) for node in lines[at].split())
        return k + 3 + count

    head = lines.index("$Nodes") + 1
    blocks, count, least, largest = map(int, lines[head].split())
    lines[head] = f"{blocks} {count} {least + by} {largest + by}"
    section("Nodes", nodes)
    section("Elements", elements)
    if "$Periodic" in lines:
        section("Periodic", links)
    return "\n".join(lines)


class MeshFormats(InScratch):
    def mesh(self, name, form):
        geometry, mesh = self.folder / f"{name}.geo", self.folder / f"{name}-{form.replace(' ', '-')}.msh"
        geometry.write_text(GEOMETRIES[name] + "\n")  # gmsh passes over a last line without end
        subprocess.run(["gmsh", "-v", "1", "-2", "-format", *FORMATS[form], geometry, "-o", mesh], check=True,
                       stdin=subprocess.DEVNULL)
        return mesh

    def read(self, mesh):
        return self.slide("-mesh_file", mesh, *MATERIAL, "-time_end", "1e-10", "-output_folder", mesh.with_suffix(""))

    def groups(self, mesh):
        """The rows of the table that `slide` prints: name, edges or cells, size; and the count of nodes and cells."""
        outcome = self.read(mesh)
        self.assertEqual((outcome.codes, outcome.err), ([0], ""), mesh)
        rows = dict((name, (int(count), float(size))) for name, count, size in re.findall(
            r"^(\S+) +\d+ +(\d+) +(\S+) m2?\b", outcome.out, re.MULTILINE))
        return rows, re.search(r": (\d+) nodes, (\d+) cells", outcome.out).groups()

    def converted(self, mesh):
        """The file that the command makes of which the refusal speaks."""
        outcome = self.read(mesh)
        self.assert_refused("slide", outcome, [mesh.name, "only MSH 4.1 is read", "convert it with gmsh -0 "], 1)
        command = shlex.split(outcome.err.split("convert it with ")[1])
        subprocess.run([*command, "-v", "1"], check=True, stdin=subprocess.DEVNULL, cwd=self.folder)
        return self.folder / command[-1]

    def check(self, name):
        text = self.mesh(name, "text")
        rows, sizes = self.groups(text)
        for group, size in EXPECTED.get(name, {}).items():
            self.assertAlmostEqual(rows[group][1] / size, 1, 3, (name, group))
        self.assertEqual(set(rows), set(EXPECTED.get(name, rows)), name)
        others = {"binary": self.mesh(name, "binary"), "shifted": self.folder / f"{name}-shifted.msh"}
        others["shifted"].write_text(shifted(text.read_text()))
        for form in FORMATS:
            if form == "4.0" or (form.startswith("2.2") and name != "periodic"):
                others[form] = self.converted(self.mesh(name, form))
        for form, mesh in others.items():
            self.assertEqual(self.groups(mesh), (rows, sizes), (name, form))
        if name in RUBBED:
            self.compare_runs(name, {"text": text, **others})

    def compare_runs(self, name, meshes):
        """One scene on each. gmsh writes 16 digits as text and 17 in binary; where the digits are the same, and the order,
        so are the bits."""
        prefix = {"nameless": "curve_"}.get(name, "")
        bottom, top = (prefix + {"bottom": "7", "top": "3"}[side] if prefix else side for side in ("bottom", "top"))
        scene = {"surface_boundary": bottom, "surface_speed": 2, "friction_law": "coulomb", "friction_coefficient": 0.3,
                 f"boundary_{top}_x": "fixed", f"boundary_{top}_y": -1e-7, f"boundary_{top}_ramp": 2e-7,
                 "time_step": 5e-9, "time_end": 5e-7, "history_every": 5}
        found = {}
        for form, mesh in meshes.items():
            outcome = self.slide("-mesh_file", mesh, *MATERIAL, *arguments_of(scene), "-output_folder",
                                 mesh.with_suffix(".run"))
            self.assertEqual((outcome.codes, outcome.err), ([0], ""), (name, form))
            found[form] = {file: datasets(mesh.with_suffix(".run") / file) for file in ("history.h5", "contact.h5")}
        text = found.pop("text")
        self.assertGreater(np.abs(text["history.h5"]["surface/tangential_force"]).max(), 1)
        for form, other in found.items():
            for file, values in text.items():
                self.assertEqual(set(values), set(other[file]))
                for dataset, expected in values.items():
                    with self.subTest(mesh=name, form=form, file=file, dataset=dataset):
                        if form == "shifted":
                            np.testing.assert_array_equal(other[file][dataset], expected)
                        else:
                            # What is but rounding is compared with what it is the rounding of.
                            whole = values[OF_ROUNDING.get(dataset, "energy/flowed" if dataset.startswith("energy/")
                                                           else dataset)]
                            scale = np.nanmax(np.abs(whole), initial=0)
                            np.testing.assert_allclose(other[file][dataset], expected, rtol=0, atol=1e-9 * scale)

    def test_every_format_has_the_same_groups(self):
        with ThreadPoolExecutor(2) as pool:
            for name, done in [(name, pool.submit(self.check, name)) for name in GEOMETRIES]:
                with self.subTest(name):
                    done.result()


if __name__ == "__main__":
    unittest.main()
