# SPDX-License-Identifier: GPL-2.0-or-later
"""Decks with walls: meshes as files, and what grains must do at them."""
import os
from pathlib import Path
import tempfile

import numpy as np

from deck import Deck
from packing import Grain, Packing
from run import run


def stl(triangles):
    lines = ["solid mesh"]
    for corners in triangles:
        lines += ["facet normal 0 0 0", "outer loop"]
        lines += ["vertex " + " ".join(repr(float(x)) for x in corner) for corner in corners]
        lines += ["endloop", "endfacet"]
    return "\n".join([*lines, "endsolid mesh"]) + "\n"


def flat(low, high, squares, height=0.0, aside=0.0):
    """A square in two triangles for each of squares x squares, moved along y by `aside`. Of grains above the diagonals
    of squares the host decides by the order of its lists which triangle they touch."""
    at = np.linspace(low, high, squares + 1)
    found = []
    for x0, x1 in zip(at, at[1:]):
        for y0, y1 in zip(at, at[1:]):
            a, b, c, d = ((x, y + aside, height) for x, y in ((x0, y0), (x1, y0), (x1, y1), (x0, y1)))
            found += [(a, b, c), (a, c, d)]
    return found


def drum(radius, half_length, facets):
    """About y, open at its ends."""
    angle = np.linspace(0.0, 2.0 * np.pi, facets, endpoint=False)
    ring = radius * np.stack([np.cos(angle), 0.0 * angle, np.sin(angle)], axis=1)
    near, far = ring - [0.0, half_length, 0.0], ring + [0.0, half_length, 0.0]
    found = []
    for k in range(facets):
        n = (k + 1) % facets
        found += [(near[k], near[n], far[n]), (near[k], far[n], far[k])]
    return found


def area_of(triangles):
    a, b, c = (np.array([t[k] for t in triangles], dtype=float) for k in range(3))
    return 0.5 * np.linalg.norm(np.cross(b - a, c - a), axis=1)


def run_with_meshes(deck, ranks, **meshes):
    folder = Path(tempfile.mkdtemp(prefix="walled-", dir=os.environ.get("GRAINSCOPE_SCRATCH")))
    for name, triangles in meshes.items():
        (folder / f"{name}.stl").write_text(stl(triangles))
    return run(deck, ranks, folder=folder)


def cube(shape=(1.0, 1.0, 1.0), style="sphere", speed=0.5, seed=3):
    """27 grains, which touch each other and the walls of a box from 0 to 5.88, in a larger one."""
    random = np.random.default_rng(seed)
    step = 1.96
    grains = [
        Grain(
            tuple((np.array([i, j, k]) + 0.5) * step),
            shape,
            velocity=tuple(speed * random.normal(size=3)),
            omega=tuple(speed * random.normal(size=3)),
        )
        for i in range(3)
        for j in range(3)
        for k in range(3)
    ]
    return Packing((10.0,) * 3, grains, origin=(-2.0,) * 3, atom_style=style, triclinic=False)


def boxed(packing, meshes=("floor",), **choices):
    """A deck whose grains are between meshes, of files of their names, and planes at the sides."""
    deck = Deck(packing, boundary="f f f", **choices)
    wall = f"all wall/gran {deck.model()}"
    deck.body = [
        *(f"fix {m} all mesh/surface/stress file {m}.stl type 1 reference_point 0 0 0" for m in meshes),
        f"fix meshes {wall} mesh n_meshes {len(meshes)} meshes {' '.join(meshes)}",
        *(
            f"fix {axis}{k} {wall} primitive type 1 {axis}plane {at}"
            for axis in "xy"
            for k, at in enumerate((0.0, 5.88))
        ),
    ]
    return deck


FLOOR = flat(-1.0, 7.0, 4, aside=-0.3)
WALLS = ("floor", "x0", "x1", "y0", "y1")
