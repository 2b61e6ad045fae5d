"""The same bits on any number of ranks, however the mesh is cut, while the block sticks, slips and separates."""

import unittest

import numpy as np
from running import InScratch, datasets
from scenes import SIDE, SQUEAL, block

SCENE = {**SQUEAL, "contact_every": 20, "fields_every": 200}
CUTS = [("metis", 2), ("metis", 3), ("simple", 2), ("simple", 3)]
FILES = ("history.h5", "contact.h5", "fields.h5")


class SameBits(InScratch):
    def compare(self, scene):
        """Runs the scene on one rank, then in every cut, and returns the history on one rank."""
        self.run_scene(scene, output_folder="alone")
        alone = {file: datasets(self.folder / "alone" / file) for file in FILES}
        for partitioner, ranks in CUTS:
            with self.subTest(partitioner=partitioner, ranks=ranks):
                self.run_scene(scene, ranks=ranks, output_folder="cut", mesh_partitioner=partitioner)
                for file in FILES:
                    self.same(file, alone[file], datasets(self.folder / "cut" / file))
        return alone["history.h5"]

    def same(self, file, left, right):
        self.assertEqual(left.keys(), right.keys(), file)
        for name in left:
            self.assertEqual(left[name].tobytes(), right[name].tobytes(), f"{file}: {name} differs")

    def assert_regime(self, history):
        for state in ("stick", "slip", "open"):
            self.assertTrue(np.any(history["contact/" + state] > 0), f"nothing is ever in the state {state}")

    def test_quadrilaterals(self):
        block(self.folder / "block.msh", divisions=12)
        self.assert_regime(self.compare(SCENE))

    def test_triangles(self):
        block(self.folder / "block.msh", divisions=12, cells="triangles")
        self.assert_regime(self.compare(SCENE))

    def test_composite_of_both_periodic_in_x(self):
        block(self.folder / "block.msh", regions=("matrix", "inclusion"), divisions=12, cells="mixed", periodic=True)
        history = self.compare({**SCENE, "material_inclusion_young": 80e9, "material_inclusion_poisson": 0.25,
                                "material_inclusion_density": 1800, "initial_sine_amplitude": 0.5,
                                "initial_sine_wavelength": SIDE})
        self.assertGreater(history["points/1/v"][:, 0].max(), 0.1)


if __name__ == "__main__":
    unittest.main()
