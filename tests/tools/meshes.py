# SPDX-License-Identifier: GPL-2.0-or-later
"""Meshes for walls, as STL files: a triangle is three corners."""
import math
import os
from pathlib import Path
import tempfile

import numpy as np


def two(a, b, c, d):
    """The triangles of a four-cornered face."""
    return [(a, b, c), (a, c, d)]


def rectangle(corner, one, other):
    """The face that two edges span from a corner."""
    corner, one, other = (np.array(v, dtype=float) for v in (corner, one, other))
    return two(corner, corner + one, corner + one + other, corner + other)


def box(low, high):
    """The six faces of a box, from inside."""
    low, high = np.array(low, dtype=float), np.array(high, dtype=float)
    edges = np.diag(high - low)
    faces = []
    for k in range(3):
        others = edges[(k + 1) % 3], edges[(k + 2) % 3]
        faces += [*rectangle(low, *others), *rectangle(low + edges[k], *others)]
    return faces


def drum(radius, low, high, sides=24):
    """A closed cylinder about y."""
    angles = 2.0 * math.pi * np.arange(sides + 1) / sides
    ring = radius * np.stack([np.cos(angles), np.zeros(sides + 1), np.sin(angles)], axis=1)
    near, far = ring + [0.0, low, 0.0], ring + [0.0, high, 0.0]
    triangles = []
    for k in range(sides):
        triangles += two(near[k], near[k + 1], far[k + 1], far[k])
        triangles += [((0.0, low, 0.0), near[k], near[k + 1]), ((0.0, high, 0.0), far[k], far[k + 1])]
    return triangles


def hopper(half, mouth, height, top):
    """Four inclined faces from a closed square mouth at z = 0 up to a square of half width `half` at `height`, and
    upright ones from there to `top`."""

    def square(size, z):
        return [(size * x, size * y, z) for x, y in ((-1, -1), (1, -1), (1, 1), (-1, 1))]

    levels = [square(mouth, 0.0), square(half, height), square(half, top)]
    triangles = two(*levels[0])
    for low, high in zip(levels, levels[1:]):
        for k in range(4):
            triangles += two(low[k], low[(k + 1) % 4], high[(k + 1) % 4], high[k])
    return triangles


def stl(name, triangles):
    lines = [f"solid {name}"]
    for corners in triangles:
        a, b, c = (np.array(corner, dtype=float) for corner in corners)
        normal = np.cross(b - a, c - a)
        lines.append("facet normal " + " ".join(repr(float(x)) for x in normal / np.linalg.norm(normal)))
        lines.append("outer loop")
        lines += ["vertex " + " ".join(repr(float(x)) for x in corner) for corner in (a, b, c)]
        lines += ["endloop", "endfacet"]
    return "\n".join([*lines, f"endsolid {name}"]) + "\n"


def folder_with(**meshes):
    """A new folder with <name>.stl for each mesh."""
    folder = Path(tempfile.mkdtemp(prefix="walls-", dir=os.environ.get("GRAINSCOPE_SCRATCH")))
    for name, triangles in meshes.items():
        (folder / f"{name}.stl").write_text(stl(name, triangles))
    return folder
