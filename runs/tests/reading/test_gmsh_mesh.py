"""Meshes of gmsh: a square of two regions with named curves, in text; what is no such mesh."""

import tempfile
import unittest
from pathlib import Path

import numpy as np

from slipscale.mistakes import Mistake
from slipscale.reading.gmsh_mesh import read_gmsh_mesh

SQUARE = """$MeshFormat
4.1 0 8
$EndMeshFormat
$PhysicalNames
3
1 5 "bottom"
2 7 "matrix"
2 8 "inclusion"
$EndPhysicalNames
$Entities
0 2 2 0
1 0 0 0 2 0 0 1 5 0
7 0 0 0 2 0 0 0 0
1 0 0 0 1 1 0 1 7 0
2 1 0 0 2 1 0 1 8 0
$EndEntities
$Nodes
1 6 10 15
2 1 0 6
10
11
12
13
14
15
0 0 0
1 0 0
2 0 0
0 1 0
1 1 0
2 1 0
$EndNodes
$Elements
4 5 1 5
1 1 1 2
1 10 11
2 11 12
1 7 1 1
3 13 14
2 1 3 1
4 10 11 14 13
2 2 2 2
5 11 12 15
6 11 15 14
$EndElements
"""


class Mesh(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.file = Path(temporary.name) / "a b.msh"

    def read(self, text=SQUARE):
        self.file.write_text(text)
        return read_gmsh_mesh(self.file)

    def test_regions_and_curves_by_their_physical_names(self):
        mesh = self.read()
        self.assertEqual(mesh.region_names, ["matrix", "inclusion"])
        self.assertEqual(mesh.region.tolist(), [0, 0, 1, 1])
        # The curve of tag 7 is no part of the group 7, which is one of surfaces.
        self.assertEqual({name: edges.tolist() for name, edges in mesh.curves.items()}, {"bottom": [[0, 1], [1, 2]]})
        a, b, c = (mesh.coordinates[mesh.triangles[:, k]] for k in range(3))
        np.testing.assert_allclose(0.5 * ((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0]), 0.5)
        np.testing.assert_allclose(np.sort(mesh.outlines()[0], axis=0), [[1, 0], [1, 1]])

    def test_what_is_no_such_mesh(self):
        for change, words in ((("4.1 0 8", "2.2 0 8"), "-format msh41"), (("$Entities", "$Nothing"), "'Entities'"),
                              (("5 11 12 15\n6 11 15 14\n$EndElements\n", ""), "MSH 4.1")):
            with self.assertRaisesRegex(Mistake, words):
                self.read(SQUARE.replace(*change))
        self.file.unlink()
        with self.assertRaisesRegex(Mistake, "cannot be read"):
            read_gmsh_mesh(self.file)


if __name__ == "__main__":
    unittest.main()
