"""A scene as a picture: which curve is held or loaded how, in words; the regions by size; from any folder."""

import contextlib
import io
import tempfile
import unittest
from pathlib import Path

from slipscale import command
from slipscale.pictures import scene
from tests.reading.test_gmsh_mesh import SQUARE

TEXT = """
mesh: {file: square.msh}
material: {all: {young: 30e9, poisson: 0.25, density: 1800}}
surface: {boundary: bottom, height: 0, speed: -2}
friction: {law: coulomb, coefficient: 0.3}
history: {points: [1.0, 0]}
"""


class Scene(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.addCleanup(scene.plt.close, "all")
        self.folder = Path(temporary.name) / "a b"
        self.folder.mkdir()
        (self.folder / "square.msh").write_text(SQUARE)
        (self.folder / "scene.yaml").write_text(TEXT)

    def test_conditions_in_words(self):
        for conditions, words in (({}, ""), ({"x": "free", "y": "free"}, ""), ({"x": "fixed"}, "$u_x$ held"),
                                  ({"x": "fixed", "y": -1.5e-6, "ramp": 4e-5},
                                   "$u_x$ held, $u_y$ = −1.5 µm, within 40 µs"),
                                  ({"pressure": 15e6, "shear": "2e6"}, "p = 15 MPa, τ = 2 MPa"),
                                  ({"y": "rigid", "force": 40000}, "$u_y$ rigid, force 40000")):
            self.assertEqual(scene.condition_words(conditions), words)

    def test_the_longest_name_of_a_curve_counts(self):
        found = scene.Scene(self.folder / "scene.yaml",
                            changes={"boundary_bottom_x": "fixed", "boundary_bottom_left_x": 1})
        found.mesh.curves["bottom_left"] = found.mesh.curves["bottom"]
        self.assertEqual(found.conditions("bottom"), {"x": "fixed"})
        self.assertEqual(found.conditions("bottom_left"), {"x": 1})

    def test_what_is_drawn(self):
        figure = scene.draw(scene.Scene(self.folder / "scene.yaml", changes={"boundary_bottom_x": "fixed"}))
        texts = [text.get_text() for text in figure.axes[0].texts]
        self.assertIn("bottom: $u_x$ held", texts)
        self.assertIn("V = 2 m/s", texts)
        self.assertIn("M", texts)
        self.assertIn("friction: coulomb, µ = 0.3", figure._suptitle.get_text())
        self.assertEqual([text.get_text() for text in figure.legends[0].get_texts()],
                         ["matrix 50 %, E = 30 GPa, ν = 0.25", "inclusion 50 %, E = 30 GPa, ν = 0.25"])

    def said_by(self, *words):
        said = io.StringIO()
        with contextlib.redirect_stderr(said):
            return command.main(["scene", *map(str, words)]), said.getvalue()

    def test_the_command(self):
        picture = self.folder / "scene.png"
        self.assertEqual(self.said_by(self.folder / "scene.yaml", picture), (0, ""))  # the mesh lies beside the scene
        self.assertGreater(picture.stat().st_size, 10000)
        (self.folder / "square.msh").unlink()
        code, said = self.said_by(self.folder / "scene.yaml", picture)
        self.assertEqual((code, said.count("\n")), (2, 1))
        self.assertIn("square.msh cannot be read", said)


if __name__ == "__main__":
    unittest.main()
