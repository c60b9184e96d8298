# SPDX-License-Identifier: GPL-2.0-or-later
"""Surfaces made of triangles: of grains, and of walls as STL files have them."""
from functools import lru_cache
import re

import numpy as np

from grainscope.errors import InputError

DEEPEST = 5  # 20,480 triangles


@lru_cache
def unit_sphere(level):
    """Points (N,3) on the unit sphere and triangles (M,3), seen anticlockwise from outside: an icosahedron whose
    triangles are split in four `level` times. N = 10 4^level + 2, M = 20 4^level."""
    golden = 0.5 * (1.0 + np.sqrt(5.0))
    points = np.array([(0, s, t * golden) for s in (-1, 1) for t in (-1, 1)], dtype=float)
    points = np.vstack([np.roll(points, k, axis=1) for k in range(3)])
    near = np.linalg.norm(points[:, None] - points[None], axis=2) < 2.1  # edges are 2 long
    triangles = np.array(
        [(i, j, k) for i, j, k in np.ndindex(12, 12, 12) if i < j < k and near[i, j] and near[j, k] and near[i, k]]
    )
    inward = np.linalg.det(points[triangles]) < 0
    triangles[inward] = triangles[inward][:, ::-1]
    points /= np.linalg.norm(points[0])
    for _ in range(level):
        sides = np.sort(triangles[:, [[0, 1], [1, 2], [2, 0]]], axis=2)
        pairs, which = np.unique(sides.reshape(-1, 2), axis=0, return_inverse=True)
        middles = points[pairs].mean(axis=1)
        middle = len(points) + which.reshape(-1, 3)
        points = np.vstack([points, middles / np.linalg.norm(middles, axis=1, keepdims=True)])
        (a, b, c), (ab, bc, ca) = triangles.T, middle.T
        triangles = np.vstack([np.stack(t, axis=1) for t in ((a, ab, ca), (b, bc, ab), (c, ca, bc), (ab, bc, ca))])
    return points, triangles


def grain_surfaces(level, positions, rotations, semi_axes, blockiness):
    """Points (N,P,3), unit normals (N,P,3) and triangles (N M,3) of the surfaces of N superquadrics,
    (|x/a|^n2 + |y/b|^n2)^(n1/n2) + |z/c|^n1 = 1, which are ellipsoids for n1 = n2 = 2."""
    sphere, triangles = unit_sphere(level)
    n1, n2 = blockiness[:, :1], blockiness[:, 1:]
    x, y, z = np.abs(sphere).T
    flat = x**n2 + y**n2
    local = sphere / (flat ** (n1 / n2) + z**n1)[..., None] ** (1.0 / n1[..., None])
    x, y, z = np.abs(local).transpose(2, 0, 1)
    flat = x**n2 + y**n2
    around = np.divide(1.0, flat, out=np.zeros_like(flat), where=flat > 0) * flat ** (n1 / n2)
    slope = np.stack([around * x ** (n2 - 1), around * y ** (n2 - 1), z ** (n1 - 1)], axis=2) * np.sign(local)
    slope /= semi_axes[:, None]
    slope /= np.linalg.norm(slope, axis=2, keepdims=True)
    turn = rotations.transpose(0, 2, 1)
    points = positions[:, None] + (local * semi_axes[:, None]) @ turn
    first = len(sphere) * np.arange(len(positions))
    return points, slope @ turn, (triangles + first[:, None, None]).reshape(-1, 3)


def read_stl(path):
    """The triangles of an STL file, ASCII or binary: their corners (M,3,3)."""
    try:
        with open(path, "rb") as file:
            content = file.read()
    except OSError as error:
        raise InputError(f"{path}: {error.strerror}") from None
    count = int.from_bytes(content[80:84], "little")
    if len(content) == 84 + 50 * count and count:
        layout = np.dtype([("normal", "<f4", 3), ("corners", "<f4", (3, 3)), ("attributes", "<u2")])
        return np.frombuffer(content, layout, count, 84)["corners"].astype(float)
    text = content.decode(errors="replace")
    corners = re.findall(r"^\s*vertex\s+(\S+)\s+(\S+)\s+(\S+)\s*$", text, re.M | re.I)
    if not corners or len(corners) % 3 or not re.search(r"^\s*endsolid", text, re.M | re.I):
        raise InputError(
            f"{path}: neither a whole ASCII STL file (3 lines 'vertex x y z' for each triangle, at its end 'endsolid') "
            "nor a binary one (84 bytes and 50 for each triangle)"
        )
    try:
        return np.array(corners, dtype=float).reshape(-1, 3, 3)
    except ValueError as error:
        raise InputError(f"{path}: {error}") from None
