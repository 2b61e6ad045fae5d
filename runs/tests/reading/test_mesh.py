"""Triangles and outlines of small meshes drawn by hand."""

import unittest

import numpy as np

from slipscale.reading.mesh import cells_at, centroids_and_areas, interfaces, split_mixed, triangles_of


class Triangles(unittest.TestCase):
    def test_quadrilaterals_are_halved(self):
        triangles, owner = triangles_of(np.array([[0, 1, 4, 3], [1, 2, 5, 4]]))
        self.assertEqual(triangles.tolist(), [[0, 1, 4], [1, 2, 5], [0, 4, 3], [1, 5, 4]])
        self.assertEqual(owner.tolist(), [0, 1, 0, 1])

    def test_mixed_stream(self):
        stream = np.array([4, 0, 1, 3, 5, 1, 2, 5, 4, 4, 1, 4, 3])
        self.assertEqual(split_mixed(stream).tolist(), [[0, 1, 3, -1], [1, 2, 5, 4], [1, 4, 3, -1]])
        triangles, owner = triangles_of(stream)
        self.assertEqual(triangles.tolist(), [[0, 1, 3], [1, 2, 5], [1, 4, 3], [1, 5, 4]])
        self.assertEqual(owner.tolist(), [0, 1, 2, 1])


class Interfaces(unittest.TestCase):
    def test_segments_between_two_regions_only(self):
        coordinates = np.array([[0.0, 0], [1, 0], [2, 0], [0, 1], [1, 1], [2, 1]])
        triangles, owner = triangles_of(np.array([[0, 1, 4, 3], [1, 2, 5, 4]]))
        segments = interfaces(coordinates, triangles, np.array([7, 8])[owner])
        self.assertEqual(segments.tolist(), [[[1, 0], [1, 1]]])
        self.assertEqual(len(interfaces(coordinates, triangles, owner * 0)), 0)


class Places(unittest.TestCase):
    # Two boxes of 1 x 1 and 2 x 1 beside each other; the seam's points are written twice.
    coordinates = np.array([[0.0, 0], [1, 0], [1, 1], [0, 1], [1, 0], [3, 0], [3, 1], [1, 1]])
    triangles, owner = triangles_of(np.array([[0, 1, 2, 3], [4, 5, 6, 7]]))

    def test_centroids_and_areas(self):
        centroid, area = centroids_and_areas(self.coordinates, self.triangles, self.owner)
        np.testing.assert_allclose(centroid, [[0.5, 0.5], [2, 0.5]], rtol=1e-15)
        np.testing.assert_allclose(area, [1, 2], rtol=1e-15)

    def test_cell_of_a_point(self):
        points = [[0.2, 0.7], [0.7, 0.2], [2.9, 0.95], [1.2, 0.05], [3.5, 0.5], [0.5, -0.1]]
        found = cells_at(self.coordinates, self.triangles, self.owner, points)
        self.assertEqual(found.tolist(), [0, 0, 1, 1, -1, -1])


if __name__ == "__main__":
    unittest.main()
