"""Meshes of gmsh, MSH 4.1 in text or binary, as far as a picture of a scene needs them.

Format: gmsh's reference manual, section 9 (MSH file format). Parts belong to the physical groups that gmsh's $Entities
give them.
"""

import struct
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from slipscale.mistakes import Mistake
from slipscale.reading.mesh import interfaces

NODES_OF = {1: 2, 2: 3, 3: 4, 15: 1}  # of a line, a triangle, a quadrilateral, a point
# Second order: the corner nodes' kind, and how many nodes there are.
CORNERS = {8: (1, 3), 9: (2, 6), 16: (3, 8), 10: (3, 9)}


@dataclass
class GmshMesh:
    """coordinates [np, 2] m; triangles [nt, 3] (a quadrilateral gives two); region [nt], index into region_names;
    curves, a dict of edges [ne, 2] by name of the physical curve."""

    coordinates: np.ndarray
    triangles: np.ndarray
    region: np.ndarray
    region_names: list
    curves: dict

    def outlines(self):
        """Segments [ns, 2, 2] m between the regions."""
        return interfaces(self.coordinates, self.triangles, self.region)


class _Words:
    """The numbers of a file in order, text or binary."""

    def __init__(self, data, binary):
        self.data, self.binary, self.place = data, binary, 0

    def line(self):
        end = self.data.find(b"\n", self.place)
        end = len(self.data) if end < 0 else end
        found, self.place = self.data[self.place:end], end + 1
        return found.decode(errors="replace").strip()

    def _text(self, count, kind):
        found = []
        while len(found) < count:
            words = self.line().split()
            if not words and self.place >= len(self.data):
                raise ValueError("it ends in the middle")
            found += words
        if len(found) != count:
            raise ValueError("a line has too many numbers")
        return np.array(found, dtype=kind)

    def _binary(self, count, letter):
        size = np.dtype(letter).itemsize * count
        if count < 0 or self.place + size > len(self.data):
            raise ValueError("it ends in the middle")
        found = np.frombuffer(self.data, letter, count, self.place)
        self.place += size
        return found

    def sizes(self, count):
        return self._binary(count, "<u8") if self.binary else self._text(count, np.int64)

    def ints(self, count):
        return self._binary(count, "<i4") if self.binary else self._text(count, np.int64)

    def floats(self, count):
        return self._binary(count, "<f8") if self.binary else self._text(count, float)


def _sections(data):
    """The place behind the line `$Name` of each section."""
    places, start = {}, 0
    while (start := data.find(b"$", start)) >= 0:
        end = data.find(b"\n", start)
        name = data[start + 1:end].strip()
        at_line = start == 0 or data[start - 1:start] == b"\n"
        if at_line and name.isalpha() and not name.startswith(b"End") and end > 0:
            places.setdefault(name.decode(), end + 1)
        start += 1
    return places


def _physical_names(words):
    names = {}
    for _ in range(int(words.line())):
        dimension, tag, name = words.line().split(None, 2)
        names[int(dimension), abs(int(tag))] = name.strip().strip('"')
    return names


def _entities(words):
    """Physical tags by dimension and tag of the entity."""
    groups = {}
    for dimension, count in enumerate(words.sizes(4)):
        for _ in range(int(count)):
            if words.binary:
                tag = int(words.ints(1)[0])
                words.floats(3 if dimension == 0 else 6)
                groups[dimension, tag] = [abs(int(k)) for k in words.ints(int(words.sizes(1)[0]))]
                if dimension:
                    words.ints(int(words.sizes(1)[0]))
            else:
                line = words.line().split()
                skip = 4 if dimension == 0 else 7
                groups[dimension, int(line[0])] = [abs(int(k)) for k in line[skip + 1:skip + 1 + int(line[skip])]]
    return groups


def _nodes_binary(words):
    blocks, count, _, _ = map(int, words.sizes(4))
    tags, points = [], []
    for _ in range(blocks):
        dimension, _, parametric = map(int, words.ints(3))
        number = int(words.sizes(1)[0])
        tags.append(words.sizes(number))
        width = 3 + (dimension if parametric else 0)
        points.append(words.floats(width * number).reshape(number, width)[:, :3])
    return _joined(tags, points, count)


def _nodes_text(words):
    blocks, count, _, _ = map(int, words.line().split())
    tags, points = [], []
    for _ in range(blocks):
        _, _, _, number = map(int, words.line().split())
        tags.append(np.array([int(words.line()) for _ in range(number)], dtype=np.int64))
        found = [[float(word) for word in words.line().split()[:3]] for _ in range(number)]
        points.append(np.array(found).reshape(-1, 3))
    return _joined(tags, points, count)


def _joined(tags, points, count):
    tags, points = np.concatenate(tags).astype(np.int64), np.concatenate(points)
    if len(tags) != count:
        raise ValueError("it has fewer nodes than it says")
    return tags, points


def _elements(words):
    """Blocks of dimension, tag of the entity, and corner nodes [n, k]."""
    found = []
    blocks = int(words.sizes(4)[0]) if words.binary else int(words.line().split()[0])
    for _ in range(blocks):
        if words.binary:
            dimension, entity, kind = map(int, words.ints(3))
            number = int(words.sizes(1)[0])
        else:
            dimension, entity, kind, number = map(int, words.line().split())
        corners, width = CORNERS.get(kind, (kind, NODES_OF.get(kind)))
        if width is None:
            raise ValueError(f"it has elements of gmsh's kind {kind}: give a mesh of triangles and quadrilaterals")
        if words.binary:
            rows = words.sizes((width + 1) * number).reshape(number, width + 1)
        else:
            rows = np.array([[int(word) for word in words.line().split()] for _ in range(number)], dtype=np.int64)
            rows = rows.reshape(number, width + 1)
        found.append((dimension, entity, rows[:, 1:1 + NODES_OF[corners]].astype(np.int64)))
    return found


def read_gmsh_mesh(path):
    """The GmshMesh of a file. Raises Mistake."""
    try:
        data = Path(path).read_bytes()
    except OSError as error:
        raise Mistake(f"{path} cannot be read ({error.strerror})") from error
    places = _sections(data)
    try:
        start = _Words(data, False)
        start.place = places["MeshFormat"]
        version, kind, _ = start.line().split()
        if version != "4.1":
            raise Mistake(f"{path} has version {version} of gmsh's format: gmsh {path} -save -format msh41 -o new.msh")
        return _built(data, places, kind == "1")
    except (KeyError, ValueError, IndexError, struct.error) as error:
        raise Mistake(f"{path} is no mesh of gmsh, MSH 4.1, that can be read ({error}): write it again with "
                      "gmsh") from error


def _section(data, places, name, binary):
    words = _Words(data, binary)
    words.place = places[name]
    return words


def _built(data, places, binary):
    names = _physical_names(_section(data, places, "PhysicalNames", False)) if "PhysicalNames" in places else {}
    groups = _entities(_section(data, places, "Entities", binary))
    nodes = _section(data, places, "Nodes", binary)
    tags, points = _nodes_binary(nodes) if binary else _nodes_text(nodes)
    order = np.argsort(tags)
    blocks = _elements(_section(data, places, "Elements", binary))

    def numbers(cells):
        return order[np.searchsorted(tags, cells, sorter=order)]

    curves, triangles, region, region_names = {}, [], [], []
    for dimension, entity, cells in blocks:
        for tag in groups.get((dimension, entity), []):
            if dimension == 1:
                curves.setdefault(names.get((1, tag), f"curve_{tag}"), []).append(numbers(cells))
        if dimension == 2:
            tag = next(iter(groups.get((2, entity), [])), None)
            name = "no region" if tag is None else names.get((2, tag), f"surface_{tag}")
            if name not in region_names:
                region_names.append(name)
            cells = numbers(cells)
            split = cells if cells.shape[1] == 3 else np.concatenate([cells[:, [0, 1, 2]], cells[:, [0, 2, 3]]])
            triangles.append(split)
            region.append(np.full(len(split), region_names.index(name)))
    if not triangles:
        raise ValueError("it has no cells")
    return GmshMesh(points[:, :2], np.concatenate(triangles), np.concatenate(region), region_names,
                    {name: np.concatenate(edges) for name, edges in curves.items()})
