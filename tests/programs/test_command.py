"""The command `slipscale` from outside, as it lies in the build tree, started in another folder whose name has a blank:
each subcommand makes what it promises there and nothing elsewhere, and mistakes are one sentence and exit code 2."""

import os
import subprocess
import tempfile
import unittest
from pathlib import Path

COMMAND = os.environ["SLIPSCALE_COMMAND"]
SCENE = """
mesh: {file: mesh/mesh.msh}
material: {matrix: {young: 30e9, poisson: 0.25, density: 1800}, inclusion: {young: 80e9, poisson: 0.25, density: 1800}}
surface: {boundary: bottom, height: 0, speed: 2}
friction: {law: regularized, coefficient: 0.5, length: 1.2e-6, threshold: regularized}
boundary: {top: {x: fixed, y: -0.8e-6, ramp: 20e-6}}
damping: {stiffness: 2e-9}
time: {end: 60e-6}
history: {every: 2, points: [2.5e-3, 0]}
contact: {every: 4}
fields: {times: [30e-6, 60e-6]}
"""


def run(program, *words, folder):
    done = subprocess.run([os.environ[f"SLIPSCALE_{program.upper()}"], *map(str, words)], cwd=folder,
                          stdin=subprocess.DEVNULL, capture_output=True, text=True, timeout=300)
    if done.returncode:
        raise AssertionError(done.stdout + done.stderr)


class Command(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(temporary.cleanup)
        cls.folder = Path(temporary.name) / "my place"
        cls.folder.mkdir()
        run("morphology", "-block_width", 5e-3, "-block_height", 2.5e-3, "-shape", "disc", "-diameter", 1e-3,
            "-fraction", 0.3, "-size", 0.25e-3, "-output_folder", "mesh", folder=cls.folder)
        (cls.folder / "scene.yaml").write_text(SCENE)
        phases = ("-material_matrix_young", 30e9, "-material_matrix_poisson", 0.25, "-material_matrix_density", 1800,
                  "-material_inclusion_young", 80e9, "-material_inclusion_poisson", 0.25,
                  "-material_inclusion_density", 1800)
        run("homogenize", "-mesh_file", "mesh/mesh.msh", "-cell_boundary", "kubc", *phases, "-output_folder", "cell",
            folder=cls.folder)
        run("slide", "-options_file_yaml", "scene.yaml", "-output_folder", "first run", folder=cls.folder)
        homogeneous = SCENE.replace(SCENE.splitlines()[2], "material: {file: cell/effective.yaml}")
        homogeneous = homogeneous.replace("30e-6, 60e-6]}", "30e-6, 60e-6], quantities: [stress, strain]}")
        (cls.folder / "homogeneous.yaml").write_text(homogeneous)
        run("slide", "-options_file_yaml", "homogeneous.yaml", "-output_folder", "second run", folder=cls.folder)
        run("relocalize", "-relocalize_run", "second run", "-relocalize_tensors", "cell", "-relocalize_points",
            "2.5e-3,0.3e-3", "-output_folder", "local", folder=cls.folder)

    def slipscale(self, *words, code=0):
        """What was said on stdout, or on stderr where it fails."""
        before = {path.name for path in self.folder.iterdir()}
        done = subprocess.run([COMMAND, *map(str, words)], cwd=self.folder, stdin=subprocess.DEVNULL,
                              capture_output=True, text=True, timeout=300)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        if code == 2:
            self.assertEqual((done.stdout, done.stderr.count("\n")), ("", 1), done.stderr)
            self.assertEqual({path.name for path in self.folder.iterdir()}, before)
        return done.stderr if code else done.stdout

    def made(self, name, least=20000):
        path = self.folder / name
        self.assertGreater(path.stat().st_size, least)
        self.assertEqual(path.read_bytes()[:4], b"\x89PNG")

    def test_the_manual_and_the_version(self):
        manual = self.slipscale("-h")
        for name in ("picture", "cell-picture", "relocalized-picture", "maps", "plan", "adapt", "sweep", "table", "compare",
                     "scene", "wear"):
            self.assertIn(f"\n  {name} ", manual)
            self.assertIn(f"slipscale {name}", self.slipscale(name, "-h"))
        self.assertRegex(self.slipscale("--version"), r"^slipscale \d+\.\d+\.\d+\nPython 3")
        self.assertTrue((Path(self.slipscale("--python-path").strip()) / "slipscale" / "__init__.py").is_file())

    def test_pictures(self):
        for name, words in (("picture", ["first run"]), ("scene", ["scene.yaml"]), ("cell-picture", ["cell"]),
                            ("relocalized-picture", ["first run", "local", "second run"])):
            self.slipscale(name, *words, f"{name} of mine.png")
            self.made(f"{name} of mine.png")
        self.assertIn("should end in one of", self.slipscale("picture", "first run", "a.foo", code=2))
        self.assertIn("There is no history.h5", self.slipscale("picture", "cell", "a.png", code=2))
        self.assertIn("There is no localization.h5", self.slipscale("cell-picture", "first run", "a.png", code=2))
        self.assertIn("names no mesh", self.slipscale("scene", "cell/effective.yaml", "a.png", code=2))

    def test_wear(self):
        said = self.slipscale("wear", "first run", "worn off", "--archard", "1e-4", "--hardness", "1e9")
        self.assertIn("depth, Archard", said)
        self.made("worn off/wear.png")
        self.assertIn("There is no contact.h5", self.slipscale("wear", "cell", "a", "--energy", "1", code=2))
        self.assertIn("nothing is asked for", self.slipscale("wear", "first run", "a", code=2))

    def test_compare(self):
        said = self.slipscale("compare", "first run", "second run", "--picture", "both.png")
        self.made("both.png")
        for words in ("second run less first run", "settled", "material_file"):
            self.assertIn(words, said)
        same = self.slipscale("compare", "first run", "first run")
        self.assertNotIn("differs\n", same)
        self.assertIn("no option differs", same)
        self.assertIn("two folders", self.slipscale("compare", "first run", code=2))

    def test_a_sweep_its_table_and_maps(self):
        self.assertIn("4 runs", self.slipscale("sweep", "scene.yaml", "-friction_coefficient", "0.3,0.5",
                                               "-surface_speed", "2,4", "--output", "never", "--dry-run"))
        self.assertFalse((self.folder / "never").exists())
        self.slipscale("sweep", "scene.yaml", "-friction_coefficient", "0.3,0.5", "-surface_speed", "2,4", "--output",
                       "my sweep", "--", "-c2")
        self.assertEqual([path.name for path in self.folder.glob(".snakemake")], [])
        said = self.slipscale("table", "my sweep", "--where", "surface_speed=2", "--columns", "friction_coefficient",
                              "surface_speed", "status")
        self.assertEqual([line.split() for line in said.splitlines()[1:]], [["0.3", "2", "ok"], ["0.5", "2", "ok"]])
        self.slipscale("maps", "my sweep/table.csv", "map.png", "--value", "friction")
        self.made("map.png", 10000)
        self.assertIn("no column nothing", self.slipscale("table", "my sweep", "--columns", "nothing", code=2))
        self.assertIn("no column nothing", self.slipscale("maps", "my sweep/table.csv", "a.png", "--value", "nothing",
                                                          code=2))
        self.assertIn("is -friction_coefficient meant?", self.slipscale("sweep", "scene.yaml", "-friction_coeficient",
                                                                        "0.1,0.2", code=2))

    def test_adapt(self):
        words = ("adapt", "first run", "second run", "--output", "adapted", "--level", "search", "--points", "3",
                 "--most", "1")
        self.assertIn("there is no program nowhere/slide", self.slipscale(*words, "--program", "nowhere/slide", code=2))
        done = subprocess.run([COMMAND, *words], cwd=self.folder, capture_output=True, text=True, timeout=300)
        self.assertIn(done.returncode, (0, 1), done.stderr)  # whether one time is enough, the study of contrast says
        self.assertTrue((self.folder / "adapted" / "adapt.yaml").is_file())
        self.assertEqual(len(list((self.folder / "adapted" / "trials").glob("*/summary.yaml"))) > 1, True)


if __name__ == "__main__":
    unittest.main()
