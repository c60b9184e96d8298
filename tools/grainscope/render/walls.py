# SPDX-License-Identifier: GPL-2.0-or-later
"""Walls to be drawn: meshes of STL files, and LIGGGHTS's primitive walls, as triangles."""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from grainscope.convert import Walls
from grainscope.errors import InputError
from grainscope.render.camera import AXES
from grainscope.surfaces import read_stl

SIDES = 96  # of a cylinder
STYLES = ("transparent", "solid", "wire")


@dataclass
class Primitive:
    """A plane or a cylinder by the words of a deck, `zplane 0.0` or `zcylinder 0.024 0 0`; where a cylinder begins and
    ends along its axis may follow."""

    axis: int
    numbers: tuple

    @classmethod
    def of(cls, words):
        given = " ".join(words)
        kind = words[0][1:] if words[0][:1] in tuple(AXES) else ""
        allowed = {"plane": (1,), "cylinder": (3, 5)}.get(kind, ())
        if len(words) - 1 not in allowed:
            raise InputError(
                "--primitive must be xplane, yplane or zplane with a coordinate, or xcylinder, ycylinder or zcylinder "
                f"with a radius, two coordinates of its axis and, if wanted, both ends along it; got '{given}'"
            )
        try:
            numbers = tuple(map(float, words[1:]))
        except ValueError:
            raise InputError(f"--primitive: numbers must follow {words[0]}, got '{given}'") from None
        if kind == "cylinder" and not numbers[0] > 0:
            raise InputError(f"--primitive: the radius must be above 0, got '{given}'")
        if len(numbers) == 5 and not numbers[3] < numbers[4]:
            raise InputError(f"--primitive: the first end must be below the second, got '{given}'")
        return cls(AXES.index(words[0][0]), numbers)

    def triangles(self, low, high):
        """Of the part in the box from `low` to `high`."""
        others = [k for k in range(3) if k != self.axis]
        if len(self.numbers) == 1:
            corners = np.empty((4, 3))
            corners[:, self.axis] = self.numbers[0]
            for k, ends in zip(others, ((0, 1, 1, 0), (0, 0, 1, 1))):
                corners[:, k] = np.where(ends, high[k], low[k])
            return corners[[[0, 1, 2], [0, 2, 3]]]
        radius, *centre = self.numbers[:3]
        ends = self.numbers[3:] or (low[self.axis], high[self.axis])
        angles = 2.0 * np.pi * np.arange(SIDES + 1) / SIDES
        lower = np.empty((SIDES + 1, 3))
        for k, middle, part in zip(others, centre, (np.cos(angles), np.sin(angles))):
            lower[:, k] = middle + radius * part
        upper = lower.copy()
        lower[:, self.axis], upper[:, self.axis] = ends
        one = np.stack([lower[:-1], lower[1:], upper[1:]], axis=1)
        other = np.stack([lower[:-1], upper[1:], upper[:-1]], axis=1)
        return np.concatenate([one, other])


class AllWalls:
    """All walls of a picture: STL files, which may change with the step, and primitive walls."""

    def __init__(self, files, primitives, cuts):
        self._files = Walls(files)
        self._primitives = [Primitive.of(words) for words in primitives]
        self._cuts = cuts
        self._read = lru_cache(read_stl)

    def triangles(self, step, box):
        """At a step, (triangles, corners, x y z), between the ends of the cuts (axis, low, high); of primitive walls
        what is in the box."""
        corners = box.corners()
        low, high = corners.min(axis=0), corners.max(axis=0)
        found = [self._read(name) for name in self._files.files(step)]
        found += [primitive.triangles(low, high) for primitive in self._primitives]
        triangles = np.concatenate(found) if found else np.empty((0, 3, 3))
        for axis, low, high in self._cuts:
            place = AXES.index(axis)
            triangles = below(below(triangles, place, high, 1.0), place, low, -1.0)
        return triangles


def below(triangles, axis, limit, sign):
    """The parts of triangles where sign*x <= sign*limit, x along an axis. A triangle with one corner beyond becomes
    two, with two corners beyond a smaller one."""
    beyond = sign * (triangles[..., axis] - limit) > 0.0
    number = beyond.sum(axis=1)
    whole, crossing = triangles[number == 0], (number == 1) | (number == 2)
    triangles, beyond, number = triangles[crossing], beyond[crossing], number[crossing]
    single = np.where(number == 1, np.argmax(beyond, axis=1), np.argmin(beyond, axis=1))  # alone on its side
    order = (single[:, None] + np.arange(3)) % 3
    alone, left, right = np.take_along_axis(triangles, order[..., None], axis=1).transpose(1, 0, 2)

    def at_limit(end):
        """Where the edges from the corner that is alone meet the limit."""
        share = (limit - alone[:, axis]) / (end[:, axis] - alone[:, axis])
        return alone + share[:, None] * (end - alone)

    one, other = at_limit(left), at_limit(right)
    parts = ((number == 2, (alone, one, other)), (number == 1, (one, left, right)), (number == 1, (one, right, other)))
    return np.concatenate([whole, *(np.stack(corners, axis=1)[chosen] for chosen, corners in parts)])


def edges_of(triangles, least_bend):
    """Edges (edges, ends, x y z) at the rim of a surface, and those where it bends by so many degrees or more."""
    corners = triangles.reshape(-1, 3)
    scale = np.ptp(corners, axis=0).max()
    nodes = np.unique(np.round(corners / scale, 6), axis=0, return_inverse=True)[1].reshape(-1, 3)
    sides = np.sort(np.stack([nodes, np.roll(nodes, -1, axis=1)], axis=2).reshape(-1, 2), axis=1)
    ends = np.stack([triangles, np.roll(triangles, -1, axis=1)], axis=2).reshape(-1, 2, 3)
    normals = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
    normals = np.repeat(normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300), 3, axis=0)
    order = np.lexsort(sides.T)
    sides, ends, normals = sides[order], ends[order], normals[order]
    first = np.flatnonzero(np.concatenate([[True], np.any(sides[1:] != sides[:-1], axis=1)]))
    in_two = np.diff(np.append(first, len(sides))) == 2
    second = np.where(in_two, first + 1, first)
    bend = np.abs(np.sum(normals[first] * normals[second], axis=1)) <= np.cos(np.radians(least_bend))
    kept = (bend | ~in_two) & (sides[first, 0] != sides[first, 1])
    return ends[first[kept]]
