"""Triangles and outlines of a mesh, for plotting."""

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
