"""Triangles, outlines, areas and places of a mesh, for plotting."""

import numpy as np

XDMF_CORNERS = {4: 3, 5: 4}  # cell types of XDMF's Mixed topology: triangle, quadrilateral


def triangles_of(cells):
    """Triangles [nt, 3] and the cell each comes from [nt]; a quadrilateral gives two.

    `cells` is [nc, 3], [nc, 4], or XDMF's flat Mixed stream (type, corners, type, corners, ...).
    """
    if cells.ndim == 1:
        cells = split_mixed(cells)
    owner = np.arange(len(cells))
    if cells.shape[1] == 3:
        return cells, owner
    halved = cells[:, 3] >= 0
    return np.vstack([cells[:, :3], cells[halved][:, [0, 2, 3]]]), np.concatenate([owner, owner[halved]])


def split_mixed(stream):
    """The cells [nc, 4] of XDMF's flat Mixed stream; the fourth corner of a triangle is -1."""
    cells, at = [], 0
    while at < len(stream):
        corners = XDMF_CORNERS[int(stream[at])]
        cells.append([*stream[at + 1:at + 1 + corners], -1][:4])
        at += 1 + corners
    return np.array(cells)


def interfaces(coordinates, triangles, region):
    """Segments [ns, 2, 2] between triangles of different region; `region` [nt] belongs to the triangles."""
    edges = np.sort(triangles[:, [0, 1, 1, 2, 2, 0]].reshape(-1, 2), axis=1)
    side = np.repeat(region, 3)
    order = np.lexsort((edges[:, 1], edges[:, 0]))
    edges, side = edges[order], side[order]
    shared = np.all(edges[1:] == edges[:-1], axis=1) & (side[1:] != side[:-1])
    return coordinates[edges[:-1][shared]]


def centroids_and_areas(coordinates, triangles, cell_of_triangle):
    """Centroids [nc, 2] and areas [nc] of the cells."""
    a, b, c = (coordinates[triangles[:, k]] for k in range(3))
    area = 0.5 * np.abs((b - a)[:, 0] * (c - a)[:, 1] - (b - a)[:, 1] * (c - a)[:, 0])
    of_cell = np.bincount(cell_of_triangle, area)
    moment = [np.bincount(cell_of_triangle, area * x) for x in ((a + b + c) / 3).T]
    return np.column_stack(moment) / of_cell[:, None], of_cell


def cells_at(coordinates, triangles, cell_of_triangle, points):
    """The cell [n] that holds each of the points [n, 2]; -1 outside the mesh.

    Points of the mesh at the same place count as one: a seam that is written twice is none. Raises RuntimeError when
    triangles overlap.
    """
    from matplotlib.tri import Triangulation  # its search for the triangle; nothing is drawn

    size = np.ptp(coordinates, axis=0).max()
    _, first, merged = np.unique(np.round(coordinates / (1e-9 * size)), axis=0, return_index=True, return_inverse=True)
    corners = merged.ravel()[triangles]
    finder = Triangulation(*coordinates[first].T, corners).get_trifinder()
    found = finder(*np.asarray(points, dtype=float).T)
    return np.where(found >= 0, cell_of_triangle[found], -1)


if __name__ == "__main__":
    raise SystemExit("slipscale.reading.mesh is a library, no command: slipscale -h lists the commands.")
