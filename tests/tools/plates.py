# SPDX-License-Identifier: GPL-2.0-or-later
"""Beds of grains on a floor, under a plate that fix press/wall moves along z: the decks of its tests."""
import numpy as np

from deck import Deck
import meshes
from packing import Grain, Packing

SPACING = 1.96
ROOM = 3.0  # between the plate and the end of the box


def bed(across=4, layers=4, style="sphere", shape=(0.95, 1.0, 1.0), speed=0.3, seed=5):
    """Layers of grains of sizes from shape[0] to 1 on a square lattice, periodic sideways, from z = 0 up. Spheres when
    the style is: then of these sizes; superquadrics have semi-axes size, size, shape[2] size."""
    random = np.random.default_rng(seed)
    long = 1.0 if style == "sphere" else shape[2]
    steps, grains = SPACING * np.array([1.0, 1.0, long]), []
    for cell in np.ndindex(across, across, layers):
        size = float(random.uniform(shape[0], 1.0))
        x, y, z = steps * (np.array(cell) + 0.5)
        x += 0.3 * SPACING * (cell[2] % 2)  # so that columns do not stand on each other
        grains.append(
            Grain(
                (float(x), float(y), float(z)),
                (size, size, size * long),
                velocity=tuple(float(v) for v in speed * random.normal(size=3)),
                omega=tuple(float(v) for v in speed * random.normal(size=3)),
            )
        )
    edge = across * SPACING
    return Packing(
        (edge, edge, layers * steps[2] + ROOM + 1.0), grains, origin=(0.0, 0.0, -1.0), atom_style=style, triclinic=False
    )


def top_of(packing):
    """Where a plate is put that touches no grain yet."""
    return packing.origin[2] + packing.edges[2] - ROOM + 0.05


def plate_of(packing, parts=2):
    """A file with a plate across the box, in parts x parts squares, inside its faces."""
    low, edge, z = packing.origin[:2], packing.edges[:2], top_of(packing)
    corners = [np.linspace(low[k], low[k] + edge[k], parts + 1) for k in (0, 1)]
    triangles = []
    for x0, x1 in zip(corners[0], corners[0][1:]):
        for y0, y1 in zip(corners[1], corners[1][1:]):
            triangles += meshes.two((x0, y0, z), (x1, y0, z), (x1, y1, z), (x0, y1, z))
    return meshes.folder_with(plate=triangles) / "plate.stl"


def plated(packing, mesh="mesh/surface", boundary="p p f", **choices):
    """A deck whose body begins with a floor at z = 0 and the mesh `plate`, both walls."""
    deck = Deck(packing, boundary=boundary, **choices)
    model = deck.model()
    for words in ("ledger on", "setup neutral"):  # the pair style's alone
        model = model.replace(" " + words, "")
    words, _, extra = model.partition(" tangential_damping")
    extra = f" tangential_damping{extra}" if extra else ""
    deck.body = [
        f"fix floor all wall/gran {words} primitive type 1 zplane 0.0 allow_special_domain_periodic yes{extra}",
        f"fix plate all {mesh} file {plate_of(packing)} type 1",
        f"fix lid all wall/gran {words} mesh n_meshes 1 meshes plate{extra}",
    ]
    return deck


def press(target, rest="every/step 5", area="box"):
    return f"fix press all press/wall mesh plate axis z target {target} area {area} {rest}"
